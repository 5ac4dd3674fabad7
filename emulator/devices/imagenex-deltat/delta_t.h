// The program of an Imagenex 837 Delta T: 83P over UDP, and external control by EC. A pure state machine.
#pragma once

#include <string>
#include <vector>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/imagenex-deltat/profile.h"

namespace echoloop::delta_t {

/// Where it sends to and from.
struct Wiring {
    Address from;  ///< port 0: the system chooses
    Address host;
};

class DeltaT final : public Device {
  public:
    DeltaT(const Settings& settings, const Wiring& wiring);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t) override {}
    DeviceCounters counters() const override { return counters_; }

  private:
    /// s from one transmission to the next.
    double period() const;
    Actions transmit(Time now);
    /// Adds a ping to those that are averaged; true if they are all there.
    bool add(const Echogram& echogram);

    Settings settings_;
    Wiring wiring_;
    Controls controls_;
    PingRecord record_;  ///< of the ping under way
    PingPacer pacer_{settings_.sensors, jitter::processor};
    Echogram mean_;            ///< of the pings averaged so far
    unsigned averaged_ = 0;    ///< pings in it
    double down_bearing_ = 0;  ///< rad, at the ping before
    std::uint64_t pings_ = 0;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::delta_t
