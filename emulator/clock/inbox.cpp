#include "emulator/clock/inbox.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <mutex>
#include <system_error>

namespace echoloop {
namespace {

int make_bell() {
    const int bell = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    if (bell < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
    return bell;
}

}  // namespace

Inbox::Inbox(asio::io_context& io) : bell_(io, make_bell()) { listen(); }

void Inbox::post(std::function<void()> event) {
    std::list<std::function<void()>> one;  // so that no memory is asked for under the lock
    one.push_back(std::move(event));
    bool was_empty = false;
    {
        const std::lock_guard lock(mutex_);
        was_empty = waiting_.empty();
        waiting_.splice(waiting_.end(), one);
    }
    if (!was_empty) return;
    constexpr std::uint64_t ring = 1;
    [[maybe_unused]] const auto rung = ::write(bell_.native_handle(), &ring, sizeof ring);
}

void Inbox::listen() {
    bell_.async_wait(asio::posix::stream_descriptor::wait_read, [this](error_code ec) {
        if (ec) return;  // the box is gone
        std::uint64_t rings = 0;
        [[maybe_unused]] const auto read = ::read(bell_.native_handle(), &rings, sizeof rings);
        listen();
        take_out();
    });
}

void Inbox::take_out() {
    std::list<std::function<void()>> events;
    {
        const std::lock_guard lock(mutex_);
        events.swap(waiting_);
    }
    for (; !events.empty(); events.pop_front()) events.front()();
}

}  // namespace echoloop
