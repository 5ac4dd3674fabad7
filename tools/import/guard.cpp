#include "tools/import/guard.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>

#include "tools/import/fault.h"

namespace echoloop::worlds {

constexpr std::size_t stage_bytes = 4096;

/// Shared with the child.
struct StageMemory {
    explicit StageMemory(Stage& stage) : of(stage) {
        void* memory =
            ::mmap(nullptr, stage_bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        of.memory_ = memory == MAP_FAILED ? nullptr : static_cast<char*>(memory);
    }
    ~StageMemory() {
        if (of.memory_) ::munmap(of.memory_, stage_bytes);
    }
    StageMemory(const StageMemory&) = delete;
    StageMemory& operator=(const StageMemory&) = delete;
    Stage& of;
};

void Stage::set(const std::string& what) {
    if (!memory_) return;
    const std::size_t size = std::min(what.size(), stage_bytes - 1);
    std::memcpy(memory_, what.data(), size);
    memory_[size] = 0;
}

std::string Stage::text() const {
    return memory_ ? std::string(memory_, ::strnlen(memory_, stage_bytes)) : "";
}

namespace {

volatile std::sig_atomic_t running = 0, asked_to_end = 0;

extern "C" void pass_on(int signal) {
    asked_to_end = signal;
    if (running > 0) ::kill(running, signal);
}

void limit(int what, rlim_t most) {
    const rlimit value{most, most};
    ::setrlimit(static_cast<__rlimit_resource>(what), &value);
}

[[noreturn]] void be_child(const Limits& limits, const std::function<int(Stage&)>& work, Stage& stage) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::signal(SIGINT, SIG_DFL), std::signal(SIGTERM, SIG_DFL);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.seconds);
#ifndef __SANITIZE_ADDRESS__
    limit(RLIMIT_AS, limits.memory);
#endif
    int result = 70;
    try {
        result = work(stage);
    } catch (const std::bad_alloc&) {
        std::raise(SIGXFSZ);  // told as a limit, below
    } catch (const std::exception& error) {
        std::fprintf(stderr, "echoloop: error: internal: %s\n", error.what());
    }
    std::fflush(nullptr);
    ::_exit(result);
}

[[noreturn]] void tell_end(int signal, const Limits& limits, const std::string& stage) {
    if (signal == SIGXCPU || signal == SIGKILL)
        throw Fault(stage, "took more than " + std::to_string(limits.seconds) + " s, or was killed",
                    "simplify it or leave it out");
    if (signal == SIGXFSZ || signal == SIGABRT)
        throw Fault(stage,
                    "took more than " + std::to_string(limits.memory >> 30U) +
                        " GiB of memory, or broke the library that reads it",
                    "simplify it or leave it out");
    throw Fault(stage, std::string("broke the library that reads it (") + ::strsignal(signal) + ")",
                "export it again with another program, or leave it out");
}

}  // namespace

int run_guarded(const Limits& limits, const std::function<int(Stage&)>& work) {
    Stage stage;
    const StageMemory memory(stage);
    struct sigaction old_int {
    }, old_term{}, action{};
    action.sa_handler = pass_on;
    ::sigaction(SIGINT, &action, &old_int);
    ::sigaction(SIGTERM, &action, &old_term);
    std::fflush(nullptr);
    const pid_t pid = ::fork();
    if (pid == 0) be_child(limits, work, stage);
    if (pid < 0) throw Fault("", "no process can be started", "end other programs");
    running = pid;
    int status = 0;
    while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    running = 0;
    ::sigaction(SIGINT, &old_int, nullptr);
    ::sigaction(SIGTERM, &old_term, nullptr);
    if (asked_to_end != 0) return 128 + asked_to_end;
    if (WIFEXITED(status)) return WEXITSTATUS(status);
    tell_end(WTERMSIG(status), limits, stage.text());
}

}  // namespace echoloop::worlds
