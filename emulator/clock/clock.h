// The time that devices live in, and the only way to wait for it. Never goes backwards; knows no device.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "emulator/clock/asio.h"
#include "emulator/contract/device.h"

namespace echoloop {

class Alarm;

/// Time of the run. Everything that waits for it does so with an Alarm, on the thread that runs the clock.
class Clock {
  public:
    /// `unix_start`: s, Unix time at run time 0; empty: the system's own.
    explicit Clock(asio::io_context& io, std::optional<double> unix_start = {})
        : io_(io), unix_start_(unix_start), holds_(std::make_shared<std::size_t>(0)) {}
    virtual ~Clock() = default;
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;

    virtual Time now() const = 0;
    /// Time 0 is now.
    virtual void begin() = 0;
    /// Serves everything on the io_context, alarms as well, until that is stopped.
    virtual void run() = 0;
    asio::io_context& io() const { return io_; }
    /// s since 1970, for time stamps.
    double unix_time() const;
    double unix_start() const { return unix_start_.value_or(unix_time()); }
    /// Of the time that has passed since `due`, how much the thread slept though an alarm should have rung:
    /// other programs, the kernel or the host of a virtual machine had its processor. At least; 0 where
    /// unknown.
    virtual Time overslept(Time) const { return {}; }

    /// While one lives, something is under way whose outcome belongs to this moment (an echogram that is due,
    /// a write that does not fit yet): a stepped clock does not move on. Others take no notice.
    class Hold {
      public:
        explicit Hold(Clock& clock) : count_(clock.holds_) { ++*count_; }
        ~Hold() { --*count_; }
        Hold(const Hold&) = delete;
        Hold& operator=(const Hold&) = delete;

      private:
        std::shared_ptr<std::size_t> count_;  // a coroutine may be destroyed after the clock
    };

  protected:
    bool held() const { return *holds_ > 0; }

  private:
    friend class Alarm;
    std::size_t next_rank() { return ranks_++; }
    /// Arranges for `alarm` to ring at `when`.
    virtual void set(Alarm& alarm, Time when) = 0;
    /// Before it rang.
    virtual void unset(Alarm&) {}
    /// An alarm rang by itself that was set to `when`.
    virtual void rang(Time) {}

    asio::io_context& io_;
    std::optional<double> unix_start_;
    std::size_t ranks_ = 0;
    std::shared_ptr<std::size_t> holds_;
};

/// Wakes one coroutine at a time of the run. Of alarms for the same time those of lower rank ring first; of
/// the same rank, the one set first.
class Alarm {
  public:
    /// Its rank is that of its making: alarms of alike runs are made in the same order.
    explicit Alarm(Clock& clock) : Alarm(clock, clock.next_rank()) {}
    Alarm(Clock& clock, std::size_t rank) : clock_(clock), rank_(rank), timer_(clock.io()) {}
    ~Alarm() { cancel(); }
    Alarm(const Alarm&) = delete;
    Alarm& operator=(const Alarm&) = delete;

    /// Returns at `when`, which may be over already; Time::max() is never. Or after cancel(), so ask the
    /// clock what time it is.
    Task<void> until(Time when);
    /// Wakes the coroutine now. Without one nothing happens.
    void cancel();
    std::size_t rank() const { return rank_; }

  private:
    friend class RealClock;
    friend class SteppedClock;

    Clock& clock_;
    std::size_t rank_;
    asio::steady_timer timer_;
    bool set_ = false;  ///< a clock knows of it that must be told of its end
    Time when_{};       ///< with turn_: where such a clock has it
    std::uint64_t turn_ = 0;
};

/// Run time on the steady clock, optionally faster or slower: `rate` seconds of the run pass in one real
/// second.
class RealClock final : public Clock {
  public:
    using Steady = std::chrono::steady_clock;

    explicit RealClock(asio::io_context& io, double rate = 1.0, std::optional<double> unix_start = {})
        : Clock(io, unix_start), rate_(rate) {
        begin();
    }

    Time now() const override;
    void begin() override { start_ = Steady::now(); }
    void run() override;
    Time overslept(Time due) const override;

  private:
    void set(Alarm& alarm, Time when) override;
    void rang(Time when) override;
    /// Instant of the steady clock at which run time `t` comes.
    Steady::time_point instant(Time t) const;

    Steady::time_point start_;
    double rate_;
    Time worked_until_{};             ///< when the last thing to do was done
    Time slept_from_{}, slept_to_{};  ///< before an alarm rang
};

}  // namespace echoloop
