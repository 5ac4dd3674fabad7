#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "emulator/contract/error.h"
#include "emulator/machine/scheduling.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/doctor/findings.h"

namespace echoloop::cli {
namespace {

using State = Finding::State;

Finding processors() {
    const auto count = std::thread::hardware_concurrency();
    double load = 0;
    std::ifstream("/proc/loadavg") >> load;
    const std::string text = counted(count, "processor") + ", load " + plain(load, 1);
    if (load > count)
        return {State::weak, "processors", text,
                "other programs use all of them: pings may be late until they finish"};
    return {State::good, "processors", text, ""};
}

Finding memory() {
    std::ifstream file("/proc/meminfo");
    for (std::string key, rest; file >> key && std::getline(file, rest);) {
        if (key != "MemAvailable:") continue;
        const double megabytes = std::stod(rest) / 1024;
        const bool enough = megabytes > 512;
        return {enough ? State::good : State::weak, "memory", plain(megabytes, 0) + " MB free",
                enough ? "" : "a run takes 100 to 200 MB; end other programs"};
    }
    return {State::weak, "memory", "cannot be read from /proc/meminfo", ""};
}

/// How much later than asked a sleeping thread wakes: what every ping and every paced byte depend on.
Finding timers() {
    using Clock = std::chrono::steady_clock;
    constexpr int times = 100;
    std::vector<double> late;
    for (int i = 0; i < times; ++i) {
        const auto when = Clock::now() + std::chrono::milliseconds(2);
        std::this_thread::sleep_until(when);
        late.push_back(std::chrono::duration<double, std::milli>(Clock::now() - when).count());
    }
    std::sort(late.begin(), late.end());
    const double median = late[times / 2], worst = late[times - 2];
    const std::string text = "ring " + plain(median, 2) + " ms late, 1 of 100 by " + plain(worst, 2) + " ms";
    if (worst > 1)
        return {State::weak, "timers", text,
                "pings that are more than 1 ms late are counted; a less busy machine, or one that is not a "
                "virtual machine with shared processors, is more punctual"};
    return {State::good, "timers", text, ""};
}

/// Asked on a thread that then ends: nothing of it stays.
Finding real_time() {
    std::string text = "allowed: echoloop run --realtime";
    std::thread([&text] {
        try {
            claim_real_time(Priority::rendering);
        } catch (const StartError&) {
            text = "not allowed; only echoloop run --realtime needs it";
        }
    }).join();
    return {State::good, "real time", text, ""};
}

Finding open_files() {
    rlimit limit{};
    ::getrlimit(RLIMIT_NOFILE, &limit);
    const bool enough = limit.rlim_cur >= 256;
    return {enough ? State::good : State::weak, "open files", "at most " + std::to_string(limit.rlim_cur),
            enough ? "" : "each device needs up to twelve: ulimit -n 1024"};
}

/// Of whoever receives big images on this machine.
Finding receive_buffers() {
    std::size_t most = 0;
    std::ifstream("/proc/sys/net/core/rmem_max") >> most;
    const std::string text = "a program may ask for " + std::to_string(most / 1024) + " kB";
    if (most < (1U << 20))
        return {
            State::weak, "UDP buffers", text,
            "a driver that reads slowly loses parts of large images: sysctl -w net.core.rmem_max=4194304"};
    return {State::good, "UDP buffers", text, ""};
}

}  // namespace

Findings look_at_machine() {
    return {processors(), memory(), timers(), real_time(), open_files(), receive_buffers()};
}

}  // namespace echoloop::cli
