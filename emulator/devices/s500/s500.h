// A Cerulean S500 echosounder: depth and profile of a single beam. A pure state machine.
#pragma once

#include "emulator/devices/family/cerulean/sonar.h"
#include "emulator/devices/s500/depth.h"
#include "emulator/devices/s500/settings.h"
#include "protocols/cerulean/s500_codec.h"

namespace echoloop::s500 {

using cerulean::s500::Message;
using ping_device::Peer;

class S500 final : public cerulean_device::Sonar {
  public:
    S500(const Settings& settings, std::vector<Endpoint> endpoints);

  private:
    void obey(const ping::Frame& frame, const Peer& peer, Time now) override;
    using Sonar::on;
    void on(const cerulean::SetSpeedOfSound& command, const Peer& peer, Time now);
    void on(const SetPingParams& command, const Peer& peer, Time now);
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
    State state_, pinged_;  ///< as set, and as it was when the last ping went out
    SmoothDepth smooth_;
    cerulean::s500::Distance2 distance_;  ///< of the last ping heard
    cerulean::s500::Profile6 profile_;    ///< of the last ping heard
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::s500
