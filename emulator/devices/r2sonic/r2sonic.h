// An R2Sonic Sonic 20xx multibeam head, with its SIM if it is given one, behind UDP. A pure state machine.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "emulator/contract/last_measured.h"
#include "emulator/contract/model.h"
#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/r2sonic/inputs.h"
#include "emulator/devices/r2sonic/network.h"
#include "emulator/devices/r2sonic/packets.h"
#include "emulator/devices/r2sonic/settings.h"

namespace echoloop::r2sonic_device {

class R2Sonic final : public Device {
  public:
    R2Sonic(const Settings& settings, const Wiring& wiring);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override;
    void line_rate(std::size_t port, double rate) override;
    DeviceCounters counters() const override;

  private:
    void obey(const r2sonic::Packet& packet, const Received& data, Time now);
    void obey_head(const r2sonic::Cmd0& commands);
    void obey_sim(const r2sonic::Cmd0& commands);
    void count_unknown(std::string_view name);
    void switch_head(bool on);
    Controls controls_in_use() const;
    Attitude attitude(Time now) const;
    Health health(Time now) const;
    bool is_input(std::size_t port) const { return port >= first_input_port_; }
    void plan_next_ping(Time now);
    Time next_sync(Time from) const;
    void transmit(Time now);
    void follow_bottom(const std::vector<multibeam::Detection>& detections);
    void send_presence(Time now);
    void send_status(Time now);
    void send_products(const Echogram& echogram, const std::vector<multibeam::Detection>& detections,
                       const std::vector<multibeam::TimeGate>& gates, Time now);
    void send(std::size_t port, const r2sonic::Packet& packet, Product product);
    double true_time(Time now) const { return settings_.unix_start + to_seconds(now); }
    /// As head and SIM take it to be, s.
    double unix_time(Time now) const { return inputs_.clock(now, true_time(now)); }
    Actions take_actions();

    Settings settings_;
    Network network_;
    Inputs inputs_;
    std::size_t first_input_port_;
    Controls controls_;
    std::optional<double> followed_range_;  ///< m, in the place of RNG0 while AUT0 is set
    bool head_on_ = true;                   ///< SPO0
    std::uint32_t sync_edge_;               ///< SYI0: 0 off, 1 rising, 2 falling
    std::uint32_t sim_status_ = 2;          ///< STM0 of the SIM
    PingRecord ping_;                       ///< the ping under way, or the last one
    /// Within 20 pings of a recording the starts are uneven by 130 ns.
    PingPacer pacer_{settings_.sensors, {Time(10), 13}};
    bool ping_asked_ = false;  ///< PNG0 came
    Time transmitted_{};       ///< when ping_ was
    Time products_until_{};    ///< when the datagrams of the last ping are out
    Attitude attitude_;        ///< of the last ping
    LastMeasured probe_;
    Seabed seabed_;  ///< for automatic gates
    std::uint32_t datagrams_received_ = 0, datagrams_sent_ = 0;
    Time next_presence_ = Time::max();
    Time next_status_ = Time::max();
    Actions actions_;
    DeviceCounters counters_;
    std::set<std::string> unknown_names_;  ///< of commands, counted already
};

/// Place of the SIM's first input among the endpoints.
inline constexpr std::size_t first_input = 3;

/// The rows of the table of models: one for each of the series.
std::vector<Model> models();

}  // namespace echoloop::r2sonic_device
