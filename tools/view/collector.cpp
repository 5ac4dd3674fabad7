#include "tools/view/collector.h"

#include <chrono>
#include <utility>

namespace echoloop::view {
Collector::Collector(Feed& feed, Deliver deliver, std::chrono::milliseconds between)
    : feed_(feed),
      deliver_(std::move(deliver)),
      between_(between),
      thread_([this](const std::stop_token& stop) { collect(stop); }) {}

Collector::~Collector() {
    thread_.request_stop();
    thread_.join();
    feed_.look(0);
}

void Collector::look(std::size_t viewers, Looks looks) {
    const std::scoped_lock lock(mutex_);
    asked_ = Looking{viewers, std::move(looks)};
    changed_.notify_one();
}

void Collector::deliver_next() {
    const std::scoped_lock lock(mutex_);
    dealt_with_ = true;
}

void Collector::collect(const std::stop_token& stop) {
    auto next = std::chrono::steady_clock::now();
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        if (feed_.viewers() == 0)
            changed_.wait(lock, stop, [this] { return asked_.has_value(); });
        else
            changed_.wait_until(lock, stop, next, [this] { return asked_.has_value(); });
        std::optional<Looking> asked = std::exchange(asked_, std::nullopt);
        const bool due = dealt_with_ && feed_.viewers() > 0 && std::chrono::steady_clock::now() >= next;
        if (due) dealt_with_ = false;
        lock.unlock();
        if (asked) feed_.look(asked->viewers, std::move(asked->looks));
        if (due) deliver_(feed_.take(), feed_.lines());
        const auto now = std::chrono::steady_clock::now();
        if (now >= next) next = now + between_;
        lock.lock();
    }
}

}  // namespace echoloop::view
