// An echosounder that talks NMEA 0183: it pings by itself, finds the bottom and says its depth. A pure state
// machine; it listens to nobody.
#pragma once

#include "emulator/devices/nmea-echosounder/settings.h"
#include "emulator/model.h"

namespace echoloop::nmea_echosounder {

/// Where its sentences go: to the other end of a line, or as datagrams to a host.
struct Wiring {
    Port port;
    Address host;  ///< of datagrams
};

class Echosounder final : public Device {
  public:
    Echosounder(Settings settings, Wiring wiring);

    std::vector<Port> ports() const override { return {wiring_.port}; }
    Actions started(Time now) override { return ping(now); }
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t) override {}
    DeviceCounters counters() const override { return counters_; }

  private:
    Actions ping(Time now);
    std::string say(const std::string& formatter, nmea::Depth depth) const;
    Time line_time(std::size_t bytes) const;

    Settings settings_;
    Wiring wiring_;
    Shot shot_;            ///< of the last ping
    Time next_ping_{};     ///< meaningful while no ping is under way
    bool waiting_ = true;  ///< for next_ping_; false: for echoes
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::nmea_echosounder
