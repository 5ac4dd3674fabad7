// Time that stands still until somebody outside moves it on, for runs in lockstep with a simulator. The same
// events in the same order whatever the machine does meanwhile. Knows no device, and nobody who steps it.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "emulator/clock/clock.h"

namespace echoloop {

class SteppedClock final : public Clock {
  public:
    explicit SteppedClock(asio::io_context& io, double unix_start = 0)
        : Clock(io, unix_start), done_(*this) {}
    ~SteppedClock() override;

    Time now() const override { return now_; }
    void begin() override {}
    /// Between the steps what arrives is served at the time that it is.
    void run() override;

    /// Moves on to `to`, which is not before now(); one caller at a time. What had arrived before is taken in
    /// first. Alarms ring one by one, and after each everything that follows from it has happened before
    /// the next does. When this returns, all that was due by then has been handed to the kernel.
    Task<void> step(Time to);
    /// A step is being made: what comes from outside now belongs behind it, into later().
    bool stepping() const { return stepping_; }
    void later(std::function<void()> event) { later_.push_back(std::move(event)); }

    /// Called before and after each step: the kernel is to hand over what it carries.
    void on_settle(std::function<void()> settle) { settles_.push_back(std::move(settle)); }
    /// Called at the beginning of each step, in the order given, when everything that had arrived is known.
    void on_step(std::function<void(Time to)> begin) { begins_.push_back(std::move(begin)); }

  private:
    using Turn = std::tuple<Time, std::size_t, std::uint64_t>;  ///< when, rank, which of these was set first

    void set(Alarm& alarm, Time when) override;
    void unset(Alarm& alarm) override;
    void ring_first();
    void serve_until(Time last);
    void settle();
    void make_step();

    Time now_{};
    std::optional<Time> asked_;
    Alarm done_;
    bool stepping_ = false, begun_ = false;
    std::uint64_t turns_ = 0;
    std::map<Turn, Alarm*> alarms_;
    std::deque<std::function<void()>> later_;
    std::vector<std::function<void()>> settles_;
    std::vector<std::function<void(Time)>> begins_;
};

}  // namespace echoloop
