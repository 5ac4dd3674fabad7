#include "render/workers.h"

#include <algorithm>
#include <utility>

namespace echoloop {
namespace {

thread_local std::size_t own_number = 0;

/// A third of a microsecond or so, in which another thread on the same core may go on.
void look_away() {
    for (int i = 0; i < 16; ++i) {
#if defined(__x86_64__) || defined(__i386__)
        __builtin_ia32_pause();
#elif defined(__aarch64__)
        asm volatile("yield");
#endif
    }
}

/// Whoever has the mutex has it for less than a microsecond, which is no time to sleep for.
std::unique_lock<std::mutex> take(std::mutex& mutex) {
    constexpr int looks = 8;
    std::unique_lock lock(mutex, std::defer_lock);
    for (int i = 0; i < looks; ++i) {
        if (lock.try_lock()) return lock;
        look_away();
    }
    lock.lock();
    return lock;
}

}  // namespace

std::size_t Workers::useful() { return std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 4); }
std::size_t Workers::number() { return own_number; }

Workers::~Workers() = default;  // the jthreads stop and join

/// Where the other thread was not on a processor, looking was in vain, and will be short next time.
template <typename Ready>
bool Workers::Patience::wait(const Ready& ready) {
    for (int i = 0; i < looks_; ++i) {
        if (ready()) {
            looks_ = most;
            return true;
        }
        look_away();
    }
    looks_ = std::max(looks_ / 2, least);
    return false;
}

void Workers::start_threads() {
    while (threads_.size() + 1 < wished_)
        threads_.emplace_back([this, number = threads_.size() + 1](const std::stop_token& stop) {
            own_number = number;
            serve(stop, number);
        });
}

void Workers::run(std::size_t count, const std::function<void(std::size_t)>& work, std::size_t most) {
    if (std::min(wished_, most) < 2 || count < 2) {
        for (std::size_t i = 0; i < count; ++i) work(i);
        return;
    }
    start_threads();
    {
        const auto lock = take(mutex_);
        work_ = &work;
        count_ = count, most_ = most;
        next_ = 0;
        open_ = true;
        ++round_;
    }
    begin_.notify_all();
    take_pieces();
    auto lock = take(mutex_);
    open_ = false;
    if (inside_ > 0 && burst_) {
        lock.unlock();
        patience_.wait([this] { return inside_ == 0; });
        lock = take(mutex_);
    }
    end_.wait(lock, [this] { return inside_ == 0; });
    if (const std::exception_ptr fault = std::exchange(fault_, nullptr)) std::rethrow_exception(fault);
}

void Workers::take_pieces() {
    try {
        for (std::size_t i = next_++; i < count_; i = next_++) (*work_)(i);
    } catch (...) {
        const auto lock = take(mutex_);
        if (!fault_) fault_ = std::current_exception();
    }
}

void Workers::visit(const std::function<void(std::size_t)>& work) {
    auto lock = take(mutex_);
    visit_ = &work;
    to_visit_.assign(threads_.size() + 1, true);
    to_visit_[0] = false;
    ++round_;
    begin_.notify_all();
    end_.wait(lock, [this] { return std::ranges::find(to_visit_, true) == to_visit_.end(); });
    visit_ = nullptr;
}

void Workers::serve(const std::stop_token& stop, std::size_t number) {
    std::size_t seen = 0;
    Patience patience;
    while (true) {
        if (burst_) patience.wait([&] { return round_ != seen || !burst_; });
        auto lock = take(mutex_);
        if (!begin_.wait(lock, stop, [&] { return round_ != seen; })) return;
        seen = round_;
        if (visit_ != nullptr && to_visit_[number]) {
            (*visit_)(number);
            to_visit_[number] = false;
            end_.notify_one();
        }
        if (aside_ != nullptr && aside_->state_ == Aside::State::waiting) do_aside(lock, *aside_);
        if (!open_ || number >= most_) continue;
        ++inside_;
        lock.unlock();
        take_pieces();
        lock = take(mutex_);
        if (--inside_ == 0) end_.notify_one();
    }
}

void Workers::begin_aside() {
    if (wished_ < 2) return;
    start_threads();
    begin_.notify_all();
}

void Workers::do_aside(std::unique_lock<std::mutex>& lock, Aside& aside) {
    aside.state_ = Aside::State::begun;
    lock.unlock();
    std::exception_ptr fault;
    try {
        aside.work_();
    } catch (...) {
        fault = std::current_exception();
    }
    lock = take(mutex_);
    aside.fault_ = fault;
    aside.state_ = Aside::State::done;
    end_.notify_one();
}

Workers::Aside::Aside(Workers& workers, std::function<void()> work)
    : workers_(workers), work_(std::move(work)) {
    {
        const auto lock = take(workers_.mutex_);
        workers_.aside_ = this;
        ++workers_.round_;
    }
    workers_.begin_aside();
}

Workers::Aside::~Aside() {
    if (waited_for_) return;
    auto lock = take(workers_.mutex_);
    workers_.end_.wait(lock, [this] { return state_ != State::begun; });
    workers_.aside_ = nullptr;
}

void Workers::Aside::wait() {
    waited_for_ = true;
    auto lock = take(workers_.mutex_);
    if (state_ == State::waiting) workers_.do_aside(lock, *this);
    if (state_ != State::done && workers_.burst_) {
        lock.unlock();
        workers_.patience_.wait([this] { return state_ == State::done; });
        lock = take(workers_.mutex_);
    }
    workers_.end_.wait(lock, [this] { return state_ == State::done; });
    workers_.aside_ = nullptr;
    if (fault_) std::rethrow_exception(fault_);
}

}  // namespace echoloop
