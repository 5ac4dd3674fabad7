// What varies in a unit that does nothing: its temperatures and voltages drift, its sensors scatter, its
// pings come a little late. One source for all models. Nothing here has a state: a reading is a function of
// the unit (seed and name), the sensor's name and the run's clock, so that a stepped run says the same each
// time.
#pragma once

#include <cstdint>
#include <string_view>

#include "emulator/contract/device.h"
#include "render/effects.h"

namespace echoloop {

/// How the readings of a sensor stray from the truth, in the unit of the reading.
struct Stray {
    double drift = 0;  ///< standard deviation of what changes within minutes
    double noise = 0;  ///< standard deviation from one reading to the next
    double step = 0;   ///< of the converter; 0: none
    double every =
        0;  ///< s from one reading to the next, which is told again until then; 0: always a new one
};
constexpr Stray operator*(double unit, const Stray& s) {
    return {unit * s.drift, unit * s.noise, unit * s.step, s.every};
}

/// Magnitudes. Own choices, if nothing else is said, of what sensors of the kind do in a vehicle at rest.
namespace stray {
/// degC. The projector of a Sonic 2026 reads 291.76 to 291.79 K within a second, 291.7 to 291.8 K within 48
/// s.
inline constexpr Stray water_temperature{.drift = 0.03, .noise = 0.012};
/// degC, within the housing, at a converter of 1/16 degC, as common digital thermometers have.
inline constexpr Stray board_temperature{.drift = 0.6, .noise = 0.05, .step = 0.0625};
/// Share of a supply's voltage.
inline constexpr Stray supply{.drift = 0.002, .noise = 0.001};
/// Share of a supply's current.
inline constexpr Stray current{.drift = 0.02, .noise = 0.02};
/// m of water, for sensors of pressure and depth.
inline constexpr Stray depth{.drift = 0.01, .noise = 0.005};
/// deg, of a magnetic compass and of a gyrocompass or a satellite compass.
inline constexpr Stray compass{.drift = 0.4, .noise = 0.15};
inline constexpr Stray heading{.drift = 0.02, .noise = 0.01};
/// deg, of roll and pitch by an accelerometer and by a motion reference unit.
inline constexpr Stray tilt{.drift = 0.05, .noise = 0.05};
inline constexpr Stray motion{.drift = 0.01, .noise = 0.005};
/// m, of a satellite receiver with corrections from a base station.
inline constexpr Stray position{.drift = 0.01, .noise = 0.005};
/// m/s, of a satellite receiver with corrections and an inertial unit, each axis.
inline constexpr Stray velocity{.drift = 0.005, .noise = 0.005};
/// g, of each axis.
inline constexpr Stray acceleration{.drift = 0.001, .noise = 0.002};
/// m/s, of a sound-speed probe at the head: 1514.962, 1515.073, 1515.038 m/s, each for 9 pings of a Sonic
/// 2026.
inline constexpr Stray sound_speed{.drift = 0.05, .noise = 0.05, .step = 0.001, .every = 0.47};
}  // namespace stray

/// By how much pings come late: 0, 1, .. `most` whole steps, each as likely.
struct Jitter {
    Time step{};
    std::uint32_t most = 0;
};

namespace jitter {
/// Own choices: of a programmable gate array that serves a network, and of a microcontroller or a program
/// under an operating system.
inline constexpr Jitter gate_array{std::chrono::microseconds(1), 50};
inline constexpr Jitter processor{std::chrono::microseconds(10), 50};
}  // namespace jitter

/// The sensors and the timer of one unit.
class Sensors {
  public:
    /// Everything reads what it is.
    Sensors() = default;
    /// `key`: random_key(seed, name of the device).
    Sensors(std::uint64_t key, const Effects& effects)
        : key_(key), noisy_(effects.has(Effect::sensor_noise)), jitters_(effects.has(Effect::ping_jitter)) {}

    /// What the sensor called `name` reads at `now`.
    double read(std::string_view name, double truth, const Stray& stray, Time now) const;
    /// The same of an angle in deg from 0 to below 360.
    double read_bearing(std::string_view name, double truth, const Stray& stray, Time now) const;
    /// read() at one moment, as float, which is what most words have room for.
    auto at(Time now) const {
        return [this, now](std::string_view name, double truth, const Stray& stray) {
            return static_cast<float>(read(name, truth, stray, now));
        };
    }
    /// What swings in a way of its own: `value` with the effect, 0 without.
    double swing(double value) const { return noisy_ ? value : 0; }
    /// The lateness of a ping, by its number.
    Time lateness(const Jitter& jitter, std::uint64_t ping) const;

  private:
    std::uint64_t key_ = 0;
    bool noisy_ = false, jitters_ = false;
};

}  // namespace echoloop
