// A measurement in a process of its own, so that neither the memory nor the caches of another count.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <type_traits>

#include "emulator/contract/error.h"

namespace echoloop::bench {

template <std::size_t Size>
void copy_text(char (&to)[Size], const std::string& text) {
    std::snprintf(to, Size, "%s", text.c_str());
}

/// Runs `measure` in a child process and returns its figures, which have a `failure` that says why there are
/// none. Throws StartError when there is no process to be had.
template <typename Figures, typename Measure>
Figures in_child_process(const Measure& measure) {
    static_assert(std::is_trivially_copyable_v<Figures>);  // they cross a pipe
    const auto cannot = [](const char* what) {
        throw StartError(Exit::unavailable, std::string("bench: ") + what + ": " + std::strerror(errno));
    };
    Figures figures{};
    char* const bytes = reinterpret_cast<char*>(&figures);
    int ends[2];
    if (::pipe(ends) != 0) cannot("no pipe to the process of a case");
    const pid_t child = ::fork();
    if (child < 0) cannot("no process for a case");
    if (child == 0) {
        ::close(ends[0]);
        try {
            figures = measure();
        } catch (const std::exception& error) {
            copy_text(figures.failure, error.what());
        }
        for (std::size_t sent = 0; sent < sizeof figures;) {
            const ssize_t n = ::write(ends[1], bytes + sent, sizeof figures - sent);
            if (n < 0 && errno != EINTR) break;
            if (n > 0) sent += static_cast<std::size_t>(n);
        }
        ::_exit(0);
    }
    ::close(ends[1]);
    std::size_t got = 0;
    while (got < sizeof figures) {
        const ssize_t n = ::read(ends[0], bytes + got, sizeof figures - got);
        if (n == 0 || (n < 0 && errno != EINTR)) break;
        if (n > 0) got += static_cast<std::size_t>(n);
    }
    ::close(ends[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (got < sizeof figures) {
        figures = {};
        copy_text(figures.failure, "its process ended without a result (status " + std::to_string(status) +
                                       "); out of memory?");
    }
    return figures;
}

}  // namespace echoloop::bench
