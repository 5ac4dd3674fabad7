// What a DVL makes of a ping: ranges, velocities with their noise, and its way since the last reset. Holds no
// clock and no message.
#pragma once

#include "emulator/devices/waterlinked-dvl/echo.h"
#include "emulator/devices/waterlinked-dvl/report.h"

namespace echoloop::waterlinked_dvl {

class Measurement {
  public:
    explicit Measurement(const Settings& settings) : settings_(settings) {}

    /// Of a ping that began at `began`, with what the host has set. Times and status are the device's to fill
    /// in.
    VelocityReport measure(const Echogram& echogram, const Configuration& configuration, const Plan& plan,
                           Time began);
    /// Sums the report up, which is valid at `validity`.
    void follow(const VelocityReport& report, Time validity);
    /// A report without any bottom.
    static VelocityReport nothing(const Settings& settings);

    void reset() { reckoning_.reset(); }
    void calibrate_gyro(Time now);
    LocalPosition position() const { return reckoning_.position(); }
    /// s, two-way, to the bottom in the last measure(); 0: none.
    double echo_time() const { return echo_time_; }

  private:
    struct Seen {
        Pose pose;
        Time time{};
    };
    void follow_motion(const Echogram& echogram, Time began);
    void follow_attitude(const Echogram& echogram, const Configuration& configuration, Time began);
    TransducerReport hear(const Echogram& echogram, std::size_t beam, const Configuration& configuration,
                          Time began, std::optional<BeamSpeed>& speed);
    void finish(VelocityReport& report, const BeamSpeeds& speeds, const Configuration& configuration) const;
    double gyro_bias(Time now) const;

    Settings settings_;
    std::optional<Seen> last_seen_;
    Vec3 motion_;  ///< m/s, mean since the ping before, in the axes x forward, y to starboard, z down
    DeadReckoning reckoning_;
    double yaw_error_ = 0;        ///< rad
    double gyro_correction_ = 0;  ///< rad/s, by calibrate_gyro
    std::optional<Time> followed_, turned_;
    double echo_time_ = 0;
};

}  // namespace echoloop::waterlinked_dvl
