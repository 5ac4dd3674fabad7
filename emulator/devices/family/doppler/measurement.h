// What a Doppler log makes of a ping: ranges, velocities with their noise, and its way since the last reset.
// Holds no clock and no message. Axes: x forward, y to starboard, z down.
#pragma once

#include "emulator/devices/family/doppler/beams.h"
#include "emulator/devices/family/doppler/dead_reckoning.h"
#include "emulator/devices/family/doppler/echo.h"

namespace echoloop::doppler {

struct BeamReport {
    double velocity = 0;       ///< m/s along the beam
    double deviation = 0;      ///< m/s, standard, of it
    double distance = -1;      ///< m along the beam
    double rssi = 0, nsd = 0;  ///< dBm
    bool valid = false;
};

struct Measured {
    Vec3 velocity;   ///< m/s
    double fom = 0;  ///< m/s
    Covariance covariance{};
    double error = 0;               ///< m/s, what four beams disagree by
    double altitude = -1;           ///< m
    std::vector<BeamReport> beams;  ///< in the device's own order
    bool valid = false, water = false;
    double speed_of_sound = 0;  ///< m/s
};

/// What a host has set.
struct Assumed {
    double speed_of_sound = 1500;  ///< m/s
    double rotation = 0;           ///< rad, by which velocities are turned about z
    bool water = false;            ///< it measures against the water
};

class Measurement {
  public:
    explicit Measurement(const Settings& settings)
        : settings_(settings),
          axes_(beam_axes(settings.acoustics.tilt, settings.azimuths)),
          order_(order_of_beams(settings)) {}

    /// Of a ping that began at `began`.
    Measured measure(const Echogram& echogram, const Assumed& assumed, const Plan& plan, Time began);
    /// Sums it up, which is valid at `validity`.
    void follow(const Measured& measured, Time validity);
    /// Without any bottom.
    static Measured nothing(const Settings& settings, double speed_of_sound);

    void reset() { reckoning_.reset(); }
    void calibrate_gyro(Time now);
    LocalPosition position() const { return reckoning_.position(); }
    /// s, two-way, to the bottom in the last measure(); 0: none.
    double echo_time() const { return echo_time_; }
    /// From the body to axes x east, y south, z down, with a yaw that drifts.
    const Quat& attitude() const { return attitude_; }
    /// m/s, its own motion since the ping before the last one.
    Vec3 motion() const { return motion_; }

  private:
    struct Seen {
        Pose pose;
        Time time{};
    };
    void follow_motion(const Echogram& echogram, Time began);
    void follow_attitude(const Echogram& echogram, const Assumed& assumed, Time began);
    BeamReport hear(const Echogram& echogram, std::size_t beam, const Assumed& assumed, Time began) const;
    void finish(Measured& measured, const Assumed& assumed) const;
    double gyro_bias(Time now) const;

    Settings settings_;
    Axes axes_;
    std::vector<std::size_t> order_;  ///< the device's beam, by the beam of a shot
    std::optional<Seen> last_seen_;
    Vec3 motion_;  ///< m/s, mean since the ping before, in the axes x forward, y to starboard, z down
    Quat attitude_;
    DeadReckoning reckoning_;
    double yaw_error_ = 0;        ///< rad
    double gyro_correction_ = 0;  ///< rad/s, by calibrate_gyro
    std::optional<Time> followed_, turned_;
    double echo_time_ = 0;
};

}  // namespace echoloop::doppler
