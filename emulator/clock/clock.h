// The time that devices live in, and the only way to wait for it. Never goes backwards; knows no device.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "emulator/clock/asio.h"
#include "emulator/contract/device.h"
#include "emulator/clock/inbox.h"
#include "emulator/machine/wire_thread.h"

namespace echoloop {

class Alarm;
class Standstills;

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
    /// By which other threads hand something to the one that runs the clock. From the first call on, which
    /// must be on that one, the io_context never runs out of work.
    Inbox& inbox();
    /// s since 1970, for time stamps.
    double unix_time() const;
    double unix_start() const { return unix_start_.value_or(unix_time()); }
    /// Of the time that has passed since `due`, how much the thread slept though an alarm should have rung:
    /// other programs, the kernel or the host of a virtual machine had its processor. At least; 0 where
    /// unknown.
    virtual Time overslept(Time) const { return {}; }
    /// Since then, how long the machine let nothing run; 0 where nobody watches.
    virtual Time stood_still(Time) const { return {}; }
    /// Of that, how long all of its processors stood still at once.
    virtual Time all_stood_still(Time) const { return {}; }
    /// It outlives this, and looks after the thread that runs the clock.
    void watch(Standstills* standstills) { standstills_ = standstills; }

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
    Standstills* standstills_ = nullptr;

  private:
    friend class Alarm;
    std::size_t next_rank() { return ranks_++; }
    /// Arranges for `alarm` to ring at `when`.
    virtual void set(Alarm& alarm, Time when) = 0;
    /// Before it rang.
    virtual void unset(Alarm& alarm) = 0;
    /// It rang by itself, as it was set to `when`; by now it may be set again.
    virtual void rang(Alarm&, Time) {}

    asio::io_context& io_;
    std::optional<double> unix_start_;
    std::size_t ranks_ = 0;
    std::shared_ptr<std::size_t> holds_;
    std::optional<Inbox> inbox_;
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
    ~RealClock() override;

    Time now() const override;
    void begin() override { start_ = Steady::now(); }
    void run() override;
    Time overslept(Time due) const override;
    Time stood_still(Time since) const override;
    Time all_stood_still(Time since) const override;

  private:
    void set(Alarm& alarm, Time when) override;
    void unset(Alarm& alarm) override;
    void rang(Alarm& alarm, Time when) override;
    void serve();
    void tell_what_is_due();
    Time run_time(Steady::duration real) const;
    /// Instant of the steady clock at which run time `t` comes.
    Steady::time_point instant(Time t) const;

    Steady::time_point start_;
    double rate_;
    Time worked_until_{};             ///< when the last thing to do was done
    Time slept_from_{}, slept_to_{};  ///< before an alarm rang
    std::set<std::pair<Time, Alarm*>> alarms_;
    std::optional<WireThread> wire_thread_;  ///< where somebody looks after the thread that runs the clock
};

}  // namespace echoloop
