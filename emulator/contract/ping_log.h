// What a session tells of its pings to whoever makes and labels faults, and asks of them. An interface only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/contract/device.h"

namespace echoloop {

class PingLog {
  public:
    virtual ~PingLog() = default;
    /// The device hears ping `number` now; the first is 1.
    virtual void hears(std::uint64_t number) = 0;
    /// What is sent from now on belongs to ping `number`; 0: to none.
    virtual void sends(std::uint64_t number) = 0;
    /// Kind and number of each fault that is on: "bit_flips 3".
    virtual std::vector<std::string> on(Time now) const = 0;
};

}  // namespace echoloop
