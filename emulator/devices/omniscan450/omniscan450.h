// A Cerulean Omniscan 450, side-scan or forward-looking: one fan, a profile per ping. A pure state machine.
#pragma once

#include "emulator/devices/family/cerulean/sonar.h"
#include "emulator/devices/omniscan450/settings.h"
#include "protocols/cerulean/omniscan_codec.h"

namespace echoloop::omniscan450 {

using cerulean::omniscan::Message;
using cerulean::omniscan::OsMonoProfile;
using ping_device::Peer;

class Omniscan450 final : public cerulean_device::Sonar {
  public:
    Omniscan450(const Settings& settings, std::vector<Endpoint> endpoints);

  private:
    void obey(const ping::Frame& frame, const Peer& peer, Time now) override;
    using Sonar::on;
    void on(const cerulean::SetSpeedOfSound& command, const Peer& peer, Time now);
    void on(const cerulean::GeneralSpeedOfSound& command, const Peer& peer, Time now);
    void on(const OsPingParams& command, const Peer& peer, Time now);
    bool send_own(ping::Id id, const Peer& peer) override;

    Shot next_shot() override;
    double ping_time() const override { return omniscan450::ping_time(pinged_, settings_); }
    Time interval() const override { return from_seconds(1e-3 * state_.params.msec_per_ping); }
    void report(const Echogram& echogram) override;
    OsMonoProfile profile(const Echogram& echogram) const;

    Settings settings_;
    State state_, pinged_;  ///< as set, and as it was when the last ping went out
    OsMonoProfile last_;    ///< of the last ping heard
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::omniscan450
