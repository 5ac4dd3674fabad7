#include "emulator/machine/wire_thread.h"

#include <fcntl.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

namespace echoloop {
namespace {

int opened(int descriptor, const char* what) {
    if (descriptor < 0) throw std::system_error(errno, std::generic_category(), what);
    return descriptor;
}

int open_stat(pid_t thread) {
    const std::string file = "/proc/self/task/" + std::to_string(thread) + "/stat";
    return opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC), file.c_str());
}

}  // namespace

WireThread::WireThread(asio::io_context& io)
    : thread_(::gettid()),
      stat_(open_stat(thread_)),
      bell_(io, opened(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd")),
      first_(io) {
    CPU_ZERO(&processors_);
    ::sched_getaffinity(thread_, sizeof processors_, &processors_);
    stay_on(::sched_getcpu());
    listen();
}

WireThread::~WireThread() {
    ::sched_setaffinity(thread_, sizeof processors_, &processors_);
    ::close(stat_);
}

bool WireThread::stay_on(int processor) const {
    cpu_set_t here;
    CPU_ZERO(&here);
    CPU_SET(processor, &here);
    return ::sched_setaffinity(thread_, sizeof here, &here) == 0;
}

/// By proc(5): "PID (NAME) STATE ...", where the processor is field 39, and a name may hold parentheses.
WireThread::State WireThread::state() const {
    std::array<char, 512> text{};
    const auto size = ::pread(stat_, text.data(), text.size(), 0);
    if (size <= 0) return {};
    std::string_view stat(text.data(), static_cast<std::size_t>(size));
    const auto name_end = stat.rfind(") ");
    if (name_end == std::string_view::npos) return {};
    stat.remove_prefix(name_end + 2);
    State state;
    state.asleep = stat.starts_with('S');
    for (int field = 3; field < 39; ++field)
        stat.remove_prefix(std::min(stat.find(' '), stat.size() - 1) + 1);
    std::from_chars(stat.data(), stat.data() + stat.size(), state.processor);
    return state;
}

void WireThread::fetch_to(int processor) {
    if (!stay_on(processor)) return;
    constexpr std::uint64_t ring = 1;
    [[maybe_unused]] const auto rung = ::write(bell_.native_handle(), &ring, sizeof ring);
}

void WireThread::listen() {
    bell_.async_wait(asio::posix::stream_descriptor::wait_read, [this](error_code ec) {
        if (ec) return;  // nobody is there any more
        std::uint64_t rings = 0;
        [[maybe_unused]] const auto read = ::read(bell_.native_handle(), &rings, sizeof rings);
        ring_timers();
        listen();
    });
}

/// asio looks at its timers when the kernel's one timer behind them rings, which waits on the processor where
/// it was set. A new first one sets it again, here.
void WireThread::ring_timers() {
    first_.expires_at(Steady::time_point{});
    first_.async_wait([](error_code) {});
}

}  // namespace echoloop
