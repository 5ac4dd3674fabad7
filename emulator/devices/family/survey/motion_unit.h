// What the sensors of a survey vessel say at one place of it: a motion reference unit, a gyrocompass and a
// satellite receiver. Shared by the sounders that pass such data on and by a unit of its own.
#pragma once

#include <cmath>
#include <optional>

#include "emulator/contract/sensors.h"
#include "render/geographic.h"

namespace echoloop::survey {

/// Unit vectors of the vessel in the world. A head that looks down has its x axis down and its z axis to the
/// bow; any other device has x to the bow and z up.
struct Axes {
    Vec3 ahead, starboard, down;
};
Axes axes_of(Quat world_from_device);
Axes axes_of_vehicle(Quat world_from_body);

/// Angles deg: roll with port up, pitch with the bow up, heading and course clockwise from north, 0 to below
/// 360.
struct Reading {
    Time time{};
    GeoPlace place;
    double roll = 0, pitch = 0, heading = 0;
    double heave = 0;                                    ///< m, down
    double roll_rate = 0, pitch_rate = 0, yaw_rate = 0;  ///< deg/s, of these angles
    double north = 0, east = 0, down = 0;                ///< m/s
    double speed = 0, course = 0;                        ///< m/s and deg over ground
};

/// How far something is below where it usually is: what is slower than some seconds is no heave.
class Heave {
  public:
    /// m, downwards, at `height` m in the world; times must not fall. The 10 s that it remembers are our own
    /// choice.
    double at(double height, Time now);

  private:
    std::optional<double> usual_{};  ///< m, the mean height of the last seconds
    Time last_{};
};

/// How the sensors of a unit stray.
struct Strays {
    Stray position = stray::position;  ///< m, each axis, and heave
    Stray motion = stray::motion;      ///< deg, roll and pitch
    Stray heading = stray::heading;    ///< deg
    Stray velocity = stray::velocity;  ///< m/s, each axis
};

class MotionUnit {
  public:
    enum class Mount {
        head,     ///< of a sonar, see axes_of()
        vehicle,  ///< x to the bow, z up, however it lies
    };
    /// `origin`: of the scene.
    MotionUnit(const Sensors& sensors, const GeoPlace& origin, const Strays& strays = {},
               Mount mount = Mount::head)
        : sensors_(sensors), origin_(origin), strays_(strays), mount_(mount) {}

    /// Times must not fall.
    Reading read(const Located& where);

  private:
    Sensors sensors_;
    GeoPlace origin_;
    Strays strays_;
    Mount mount_;
    Heave heave_;
};

/// deg, 0 to below 360.
inline double turned_once(double degrees) {
    const double angle = std::remainder(degrees, 360);
    return angle < 0 ? angle + 360 : angle;
}

}  // namespace echoloop::survey
