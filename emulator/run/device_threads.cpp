#include "emulator/run/device_threads.h"

#include <future>
#include <mutex>
#include <utility>

#include "emulator/machine/punctual.h"

namespace echoloop {

Listeners::Listeners(Punctuality punctuality) {
    constexpr std::size_t threads = 2;
    std::vector<std::future<void>> ready;
    for (std::size_t i = 0; i < threads; ++i) {
        std::packaged_task<void()> begin([punctuality] {
            wake_on_time();
            if (punctuality == Punctuality::real_time) claim_real_time(Turn::listeners);
        });
        ready.push_back(begin.get_future());
        threads_.emplace_back([this, begin = std::move(begin)]() mutable {
            begin();
            serve();
        });
    }
    for (auto& one : ready) one.wait();
    try {
        for (auto& one : ready) one.get();
    } catch (...) {
        join();
        throw;
    }
}

void Listeners::post(std::function<void()> work) {
    std::list<std::function<void()>> one;  // so that no memory is asked for under the lock
    one.push_back(std::move(work));
    {
        const std::lock_guard lock(mutex_);
        waiting_.splice(waiting_.end(), one);
    }
    called_.call();
}

void Listeners::join() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    for (std::size_t i = 0; i < threads_.size(); ++i) called_.call();
    threads_.clear();
}

void Listeners::serve() {
    while (true) {
        called_.sleep();
        std::list<std::function<void()>> mine;
        {
            const std::lock_guard lock(mutex_);
            if (waiting_.empty() && ending_) return;
            mine.splice(mine.end(), waiting_, waiting_.begin());
        }
        mine.front()();
    }
}

}  // namespace echoloop
