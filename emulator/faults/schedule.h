// When the faults of lines and devices begin and end: it tells, and makes none. Those of bytes need no
// telling, since every message asks.
#pragma once

#include "emulator/clock/clock.h"
#include "emulator/faults/faults.h"

namespace echoloop {

class FaultSchedule {
  public:
    /// `begins` is false at the end, and also when a fault that was on has been cleared. What happens at one
    /// moment begins only.
    using Change = std::function<void(const Fault& fault, int id, bool begins)>;

    /// `faults` outlives this.
    FaultSchedule(Clock& clock, DeviceFaults& faults, Change change);

    void start();
    void close();

  private:
    Task<void> keep_going();
    void tell(Time now);
    void tell_of_moments(const AskedFault& asked, Time now);
    void tell_of_cleared();
    Time next(Time now) const;

    Clock& clock_;
    DeviceFaults& faults_;
    Change change_;
    Alarm bell_;
    std::map<int, Fault> on_;      ///< begun and not ended, by number
    std::map<int, Time> told_up_;  ///< moments up to this time have been told
    bool closed_ = false;
};

}  // namespace echoloop
