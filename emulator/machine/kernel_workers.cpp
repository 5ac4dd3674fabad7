#include "emulator/machine/kernel_workers.h"

#include <dirent.h>
#include <sched.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "emulator/machine/punctual.h"

namespace echoloop {
namespace {

constexpr int turn = static_cast<int>(Turn::kernel_workers);
constexpr int ordinary = 0;  ///< the priority of what goes before nobody
constexpr auto between_looks = std::chrono::milliseconds(250);

/// "" if there is none any more.
std::string name_of(pid_t pid) {
    const std::string file = "/proc/" + std::to_string(pid) + "/comm";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> comm(std::fopen(file.c_str(), "re"), &std::fclose);
    std::array<char, 64> text{};
    return comm && std::fgets(text.data(), text.size(), comm.get()) != nullptr ? text.data() : "";
}

/// Of the queue that no processor owns: "kworker/u8:3-events_unbound".
bool is_worker(pid_t pid) { return name_of(pid).starts_with("kworker/u"); }

template <class F>
void for_each_process(F&& see) {
    const std::unique_ptr<DIR, int (*)(DIR*)> processes(::opendir("/proc"), &::closedir);
    if (!processes) return;
    while (const dirent* entry = ::readdir(processes.get())) {
        const std::string_view name = entry->d_name;
        pid_t pid = 0;
        if (std::from_chars(name.data(), name.data() + name.size(), pid).ec == std::errc{}) see(pid);
    }
}

bool schedule(pid_t pid, int policy, int priority) {
    sched_param parameters{};
    parameters.sched_priority = priority;
    return ::sched_setscheduler(pid, policy, &parameters) == 0;
}

}  // namespace

KernelWorkers::KernelWorkers() : count_(raise_all()) {
    if (count_ == 0) return;
    thread_ = std::jthread([this](const std::stop_token& stop) {
        give_turn(::pthread_self(),
                  Turn::kernel_workers);  // else it would wait behind rendering for its turn
        std::unique_lock lock(mutex_);
        while (!ended_.wait_for(lock, stop, between_looks, [] { return false; }) && !stop.stop_requested())
            raise_all();
    });
}

KernelWorkers::~KernelWorkers() {
    thread_ = {};
    for (const auto& [pid, before] : raised_)
        if (is_worker(pid) && ::sched_getscheduler(pid) == SCHED_FIFO)
            schedule(pid, before == ordinary ? SCHED_OTHER : SCHED_FIFO, before);
}

std::size_t KernelWorkers::raise_all() {
    std::size_t first = 0;
    for_each_process([&](pid_t pid) {
        sched_param now{};
        const int policy = ::sched_getscheduler(pid);
        if ((policy != SCHED_OTHER && policy != SCHED_FIFO) || ::sched_getparam(pid, &now) != 0 ||
            !is_worker(pid))
            return;
        const int priority = now.sched_priority;  // 0 for ordinary ones
        if (priority < turn && !schedule(pid, SCHED_FIFO, turn)) return;
        if (priority <= turn) raised_.try_emplace(pid, priority == turn ? ordinary : priority);
        ++first;
    });
    return first;
}

}  // namespace echoloop
