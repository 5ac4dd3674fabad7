// A Kongsberg multibeam that sends KMALL datagrams over UDP. A pure state machine.
#pragma once

#include "emulator/devices/kongsberg-kmall/messages.h"

namespace echoloop::kongsberg_kmall {

/// Where commands arrive, and where datagrams go.
struct Wiring {
    Address own, host;
};

class Kongsberg final : public Device {
  public:
    Kongsberg(const Settings& settings, const Wiring& wiring);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t) override {}
    DeviceCounters counters() const override { return counters_; }

  private:
    void obey(const kmall::Command& command, Time now);
    void plan_next_ping(Time now);
    void transmit(Time now);
    void send(const kmall::Datagram& datagram, Time now);
    Actions take_actions();

    Settings settings_;  ///< commands change the first two
    Wiring wiring_;
    PingRecord ping_;  ///< the ping under way, or the last one
    std::uint64_t pings_begun_ = 0;
    bool ping_under_way_ = false;
    Time transmitted_{};  ///< when the last ping went out
    Time next_ping_ = Time::max();
    Actions actions_;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::kongsberg_kmall
