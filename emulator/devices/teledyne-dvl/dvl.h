// A Teledyne DVL on its line: a console, and reports in one of five formats while it pings. A pure state
// machine.
#pragma once

#include <optional>
#include <string>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/family/doppler/measurement.h"
#include "emulator/devices/teledyne-dvl/console.h"
#include "emulator/devices/teledyne-dvl/profile.h"

namespace echoloop::teledyne_dvl {

class Dvl final : public Device {
  public:
    explicit Dvl(const Settings& settings);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override;
    DeviceCounters counters() const override { return counters_; }

  private:
    void start_pinging(Time now);
    void stop_pinging();
    void hear_byte(char c, Time now);
    void end_line(Time now);
    void ping_if_due(Time now);
    double period_of(double altitude) const;
    /// The first mode that reaches so many m down.
    const doppler::Mode& mode_to(double depth) const;
    /// s, two-way, along a beam to so many m down.
    double time_to(double depth) const;
    Report report_of(const Echogram& echogram, Time began);
    void hear_layer(Report& report, const WaterPing& ping) const;
    /// Sums up the way in the water.
    void follow_water(Report& report, const Setup& in_earth, double seconds, Time began);
    void say(const std::string& text);
    std::int64_t clock(Time now) const;
    Actions take_actions();

    Settings settings_;
    Setup setup_;
    bool pinging_ = false, waits_for_end_ = false;
    std::string line_;
    char last_ = 0;
    int breaks_ = 0;  ///< '+' or '=' in a row
    std::int64_t clock_error_ = 0;

    doppler::Modes modes_;
    doppler::ModeSearch search_;
    PingPacer pacer_;
    doppler::Plan plan_;
    doppler::Measurement measurement_;
    double altitude_ = 0;  ///< m; 0: no bottom
    std::optional<Time> followed_, last_good_, last_good_water_;
    std::array<double, 4> way_{}, way_in_water_{};
    std::uint64_t shots_ = 0;
    std::uint32_t ensembles_ = 0;
    std::size_t last_size_ = 0;  ///< bytes of the last report
    Actions actions_;
    DeviceCounters counters_;
};

}  // namespace echoloop::teledyne_dvl
