// A Blue Robotics Ping1D or Ping2 echosounder behind its serial line or its UDP bridge. A pure state machine.
#pragma once

#include <map>
#include <optional>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/family/ping/link.h"
#include "emulator/devices/family/sounder/tracker.h"
#include "emulator/devices/ping1d/bottom.h"
#include "emulator/devices/ping1d/settings.h"

namespace echoloop::ping1d {

using ping_device::Peer;

class Ping1d final : public Device {
  public:
    Ping1d(const Settings& settings, std::vector<Port> ports);

    std::vector<Port> ports() const override { return ports_; }
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override { link_.reset(port); }
    void line_rate(std::size_t port, double rate) override;
    DeviceCounters counters() const override;

  private:
    void power_up(Time now);
    void obey(const ping::Frame& frame, const Peer& peer, Time now);
    void on(const ping::GeneralRequest& request, const Peer& peer);
    void on(const ping::Ping1dSetDeviceId& command, const Peer& peer);
    void on(const ping::SetDeviceId& command, const Peer& peer);
    void on(const ping::SetRange& command, const Peer& peer);
    void on(const ping::SetSpeedOfSound& command, const Peer& peer);
    void on(const ping::SetModeAuto& command, const Peer& peer);
    void on(const ping::SetPingInterval& command, const Peer& peer);
    void on(const ping::SetGainSetting& command, const Peer& peer);
    void on(const ping::SetPingEnable& command, const Peer& peer);
    void on(const ping::SetOssProfileConfiguration& command, const Peer& peer);
    void on(const ping::ContinuousStart& command, const Peer& peer);
    void on(const ping::ContinuousStop& command, const Peer& peer);
    void on(const ping::GotoBootloader& command, const Peer& peer);

    void set_id(std::uint8_t id, ping::Id command, const Peer& peer);
    /// ack(id) if `good`, else nack(id, text); says which.
    bool acknowledge(bool good, ping::Id id, std::string_view text, const Peer& peer);
    /// The message of a get id, nothing if there is none.
    std::optional<ping::Message> message(ping::Id id) const;
    bool send_message(ping::Id id, const Peer& peer);
    /// What a sensor reads at this moment; `stray` in units of the word.
    std::uint16_t read(std::string_view name, std::uint16_t truth, const Stray& stray) const;
    std::uint16_t voltage() const;  ///< mV
    void reply(const ping::Message& message, const Peer& peer);
    void transmit(Time now);
    /// What it says of the bottom that this ping has found.
    Bottom tracked(const Bottom& found, Time now);
    Actions take_actions();

    Settings settings_;
    std::vector<Port> ports_;
    ping_device::Link link_;
    State state_, pinged_;  ///< as set, and as it was when the last ping went out
    ping::Profile last_;    ///< of the last ping heard
    echosounder::Tracker tracker_;
    std::map<ping::Id, Peer> streams_;
    std::uint32_t ping_ = 0;
    PingPacer pacer_{settings_.sensors, jitter::processor};
    Time now_{};               ///< of the call at hand
    bool restarting_ = false;  ///< in the boot loader until the next ping
    Actions actions_;          ///< of the call at hand
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::ping1d
