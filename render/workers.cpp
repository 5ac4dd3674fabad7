#include "render/workers.h"

#include <algorithm>
#include <utility>

namespace echoloop {

std::size_t Workers::useful() { return std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 4); }

Workers::~Workers() = default;  // the jthreads stop and join

void Workers::run(std::size_t count, const std::function<void(std::size_t)>& work) {
    if (wished_ < 2 || count < 2) {
        for (std::size_t i = 0; i < count; ++i) work(i);
        return;
    }
    while (threads_.size() + 1 < wished_)
        threads_.emplace_back([this](const std::stop_token& stop) { serve(stop); });
    {
        const std::lock_guard lock(mutex_);
        work_ = &work;
        count_ = count;
        next_ = 0;
        open_ = true;
        ++round_;
    }
    begin_.notify_all();
    take_pieces();
    std::unique_lock lock(mutex_);
    open_ = false;
    end_.wait(lock, [this] { return inside_ == 0; });
    if (const std::exception_ptr fault = std::exchange(fault_, nullptr)) std::rethrow_exception(fault);
}

void Workers::take_pieces() {
    try {
        for (std::size_t i = next_++; i < count_; i = next_++) (*work_)(i);
    } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!fault_) fault_ = std::current_exception();
    }
}

void Workers::serve(std::stop_token stop) {
    std::size_t seen = 0;
    while (true) {
        {
            std::unique_lock lock(mutex_);
            if (!begin_.wait(lock, stop, [&] { return round_ != seen; })) return;
            seen = round_;
            if (!open_) continue;
            ++inside_;
        }
        take_pieces();
        const std::lock_guard lock(mutex_);
        if (--inside_ == 0) end_.notify_one();
    }
}

}  // namespace echoloop
