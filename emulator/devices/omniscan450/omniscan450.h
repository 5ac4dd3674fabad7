// A Cerulean Omniscan 450, side-scan or forward-looking: one fan, a profile per ping. A pure state machine.
#pragma once

#include "emulator/devices/family/ping_pacer.h"
#include "emulator/devices/omniscan450/settings.h"

namespace echoloop::omniscan450 {

using cerulean::omniscan::Message;
using cerulean::omniscan::OsMonoProfile;
using ping_device::Peer;

class Omniscan450 final : public Device {
  public:
    Omniscan450(const Settings& settings, std::vector<std::string> endpoints);

    std::vector<Port> ports() const override { return ports_; }
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override { link_.reset(port); }
    DeviceCounters counters() const override;

  private:
    void discover(const Received& data);
    void obey(const ping::Frame& frame, const Peer& peer, Time now);
    void on(const ping::GeneralRequest& request, const Peer& peer, Time now);
    void on(const cerulean::SetSpeedOfSound& command, const Peer& peer, Time now);
    void on(const cerulean::GeneralSpeedOfSound& command, const Peer& peer, Time now);
    void on(const OsPingParams& command, const Peer& peer, Time now);

    void set_speed_of_sound(std::uint32_t speed, bool known, cerulean::Id id, const Peer& peer);
    /// False if there is no such message to ask for.
    bool send_message(ping::Id id, const Peer& peer);
    void acknowledge(cerulean::Id id, const Peer& peer);
    void refuse(ping::Id id, std::string_view text, const Peer& peer);
    void reply(const Message& message, const Peer& peer);
    void transmit(Time now);
    OsMonoProfile profile(const Echogram& echogram) const;
    Actions take_actions();

    Settings settings_;
    std::vector<std::string> endpoints_;
    std::vector<Port> ports_;
    std::vector<std::size_t> pieces_;  ///< largest datagram per port; 0: a stream
    ping_device::Link link_;
    State state_, pinged_;  ///< as set, and as it was when the last ping went out
    OsMonoProfile last_;    ///< of the last ping heard
    Peer listener_;         ///< who asked for the pings
    PingPacer pacer_;
    std::uint64_t pings_ = 0;
    Time pinged_at_{};
    Actions actions_;  ///< of the call at hand
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::omniscan450
