// An R2Sonic Sonic 2024 multibeam head, with its SIM if it is given one, behind UDP. A pure state machine.
#pragma once

#include <optional>

#include "emulator/devices/r2sonic/packets.h"
#include "emulator/devices/r2sonic/settings.h"
#include "emulator/model.h"

namespace echoloop::r2sonic_device {

/// Addresses of the parts of a system: base ports as R2Sonic counts them.
struct Wiring {
    Address head;                ///< own address, base port
    Address gui;                 ///< host, base port: where data goes
    std::optional<Address> sim;  ///< own address of the SIM, base port
};

class R2Sonic final : public Device {
  public:
    R2Sonic(const Settings& settings, const Wiring& wiring);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t) override {}
    DeviceCounters counters() const override { return counters_; }

  private:
    void obey(const r2sonic::Packet& packet, const Received& data, Time now);
    void obey_commands(const r2sonic::Cmd0& commands, Time now);
    void answer_discovery(const r2sonic::R2dd& request, Address from);
    void configure(const r2sonic::R2dc& config);
    void plan_next_ping(Time now);
    void transmit(Time now);
    void send_status(Time now);
    void send_image(const Echogram& echogram, Time now);
    void send(std::size_t port, const r2sonic::Packet& packet, Address to, Time not_before = {});
    Address gui(std::uint16_t offset) const;
    double unix_time(Time now) const { return settings_.unix_start + to_seconds(now); }
    Actions take_actions();

    Settings settings_;
    Wiring wiring_;
    Controls controls_;
    PingRecord ping_;  ///< the ping under way, or the last one
    bool ping_under_way_ = false;
    bool ping_asked_ = false;  ///< PNG0 came
    std::optional<Time> last_transmission_;
    double last_depth_ = 0;  ///< m, for automatic gates
    std::uint32_t head_config_ = 0, sim_config_ = 0;
    Time next_ping_ = Time::max();
    Time next_status_ = Time::max();
    Actions actions_;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::r2sonic_device
