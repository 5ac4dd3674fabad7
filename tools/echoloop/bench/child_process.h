// A measurement in a process of its own, so that neither the memory nor the caches of another count.
#pragma once

#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <type_traits>
#include <utility>

#include "emulator/contract/error.h"

namespace echoloop::bench {

template <std::size_t Size>
void copy_text(char (&to)[Size], const std::string& text) {
    std::snprintf(to, Size, "%s", text.c_str());
}

/// A child process that measures whenever it is asked, and sleeps in between. `Figures` have a `failure` that
/// says why there are none.
template <typename Figures>
class ChildProcess {
    static_assert(std::is_trivially_copyable_v<Figures>);  // they cross a socket

  public:
    /// `measure` returns Figures; it is called in the child, once for each question. Throws StartError when
    /// there is no process to be had.
    template <typename Measure>
    explicit ChildProcess(Measure measure) {
        const auto cannot = [](const char* what) {
            throw StartError(Exit::unavailable, std::string("bench: ") + what + ": " + std::strerror(errno));
        };
        int ends[2];
        if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) cannot("no socket to the process of a case");
        pid_ = ::fork();
        if (pid_ < 0) cannot("no process for a case");
        if (pid_ == 0) {
            ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // what others have inherited of the sockets keeps them open
            ::close(ends[0]);
            answer(ends[1], measure);
            ::_exit(0);
        }
        ::close(ends[1]);
        channel_ = ends[0];
    }
    ChildProcess(ChildProcess&& other) noexcept
        : channel_(std::exchange(other.channel_, -1)), pid_(std::exchange(other.pid_, -1)) {}
    ChildProcess& operator=(ChildProcess&&) = delete;
    ~ChildProcess() {
        if (pid_ > 0) ::kill(pid_, SIGKILL);  // it sleeps
        wait();
        if (channel_ >= 0) ::close(channel_);
    }

    /// After a failure there is nothing to ask.
    Figures ask() {
        Figures figures{};
        if (send(channel_, "?", 1) && receive(channel_, &figures, sizeof figures)) return figures;
        figures = {};
        copy_text(figures.failure, "its process ended without a result (status " + std::to_string(wait()) +
                                       "); out of memory?");
        return figures;
    }

  private:
    int channel_ = -1;
    pid_t pid_ = -1;

    template <typename Measure>
    static void answer(int channel, Measure& measure) {
        char question;
        while (receive(channel, &question, 1)) {
            Figures figures{};
            try {
                figures = measure();
            } catch (const std::exception& error) {
                copy_text(figures.failure, error.what());
            }
            if (!send(channel, &figures, sizeof figures) || figures.failure[0] != '\0') return;
        }
    }

    static bool send(int channel, const void* bytes, std::size_t size) {
        for (std::size_t sent = 0; sent < size;) {
            const ssize_t n =
                ::send(channel, static_cast<const char*>(bytes) + sent, size - sent, MSG_NOSIGNAL);
            if (n <= 0 && errno != EINTR) return false;
            if (n > 0) sent += static_cast<std::size_t>(n);
        }
        return true;
    }

    static bool receive(int channel, void* bytes, std::size_t size) {
        for (std::size_t got = 0; got < size;) {
            const ssize_t n = ::read(channel, static_cast<char*>(bytes) + got, size - got);
            if (n == 0 || (n < 0 && errno != EINTR)) return false;
            if (n > 0) got += static_cast<std::size_t>(n);
        }
        return true;
    }

    /// Its status, once.
    int wait() {
        int status = 0;
        if (pid_ <= 0) return status;
        while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
        pid_ = -1;
        return status;
    }
};

/// The figures of one measurement.
template <typename Figures, typename Measure>
Figures in_child_process(const Measure& measure) {
    return ChildProcess<Figures>(measure).ask();
}

}  // namespace echoloop::bench
