// A Cerulean S500 echosounder: depth and profile of a single beam. A pure state machine.
#pragma once

#include "emulator/devices/family/cerulean/sonar.h"
#include "emulator/devices/s500/depth.h"
#include "emulator/devices/s500/settings.h"
#include "protocols/cerulean/s500_codec.h"
#include "protocols/ping/messages.h"

namespace echoloop::s500 {

using cerulean::s500::Message;
using ping_device::Peer;

class S500 final : public cerulean_device::Sonar {
  public:
    S500(const Settings& settings, std::vector<Endpoint> endpoints);

  private:
    void obey(const ping::Frame& frame, const Peer& peer, Time now) override;
    using Sonar::on;
    void on(const SetPingParams& command, const Peer& peer, Time now);
    /// A message that a Ping1D knows, too; false if it is not one of those that this sonar obeys.
    bool obey_as_ping1d(const ping::Frame& frame, const Peer& peer, Time now);
    std::optional<ping::Message> ping1d_message(ping::Id id) const;
    std::uint32_t processor_temperature() const;  ///< 0.01 degC
    /// What a Ping1D's host sets; why not, if it is refused.
    std::optional<std::string_view> take(const ping::Ping1dSetDeviceId&, const Peer& peer, Time now);
    std::optional<std::string_view> take(const ping::SetRange&, const Peer& peer, Time now);
    std::optional<std::string_view> take(const ping::SetSpeedOfSound&, const Peer& peer, Time now);
    std::optional<std::string_view> take(const ping::SetModeAuto&, const Peer& peer, Time now);
    std::optional<std::string_view> take(const ping::SetPingInterval&, const Peer& peer, Time now);
    std::optional<std::string_view> take(const ping::SetGainSetting&, const Peer& peer, Time now);
    std::optional<std::string_view> take(const ping::SetPingEnable&, const Peer& peer, Time now);
    /// The message of a get id, nothing if there is none.
    std::optional<Message> message(ping::Id id) const;
    bool send_own(ping::Id id, const Peer& peer) override;

    Shot next_shot() override;
    double ping_time() const override { return s500::ping_time(pinged_, settings_); }
    Time interval() const override { return std::chrono::milliseconds(state_.interval()); }
    void report(const Echogram& echogram) override;
    void keep(const Echogram& echogram);
    void follow(const Echogram& echogram);

    Settings settings_;
    bool enabled_ = true;   ///< by a Ping1D's set_ping_enable
    State state_, pinged_;  ///< as set, and as it was when the last ping went out
    SmoothDepth smooth_;
    cerulean::s500::Distance2 distance_;  ///< of the last ping heard
    cerulean::s500::Profile6 profile_;    ///< of the last ping heard
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::s500
