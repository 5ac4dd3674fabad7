// What a Teledyne DVL has to say of a ping, in each of its formats. Pure functions.
#pragma once

#include "emulator/devices/family/doppler/attitude.h"
#include "emulator/devices/family/doppler/measurement.h"
#include "emulator/devices/teledyne-dvl/settings.h"
#include "protocols/teledyne/messages.h"

namespace echoloop::teledyne_dvl {

/// Of the water track.
struct WaterLayer {
    doppler::Measured
        measured;  ///< velocity of the vehicle against it, in the vehicle's axes, and of the beams
    std::array<std::uint8_t, 4> correlation{}, amplitude{};
    double middle = 0;  ///< m, vertical
    bool too_shallow = false;
};

/// Everything about one ensemble.
struct Report {
    doppler::Measured measured;  ///< velocity in the vehicle's axes, which EA turns from the device's own
    doppler::Attitude attitude;  ///< of the vehicle, as its sensors read it
    std::uint32_t number = 1;
    std::int64_t unix_us = 0;
    double temperature = 0;                  ///< degC
    double period = 0, pulse = 0;            ///< s; m
    std::vector<teledyne::Section> profile;  ///< of the water, if any
    std::array<double, 4> way{};             ///< m made good: east, north, up, error
    double since = 0;                        ///< s since the last good velocity
    std::optional<WaterLayer> water;         ///< of a water track
    std::array<double, 4> way_in_water{};    ///< m made good
    double since_in_water = 0;               ///< s
};

/// Velocity of the bottom against the log, m/s, in the frame that is set, and the error velocity; nothing
/// where it cannot be told. Axes of that frame: beams 1 to 4; starboard, aft to forward and to the face;
/// east, north and up.
using Velocities = std::array<std::optional<double>, 4>;
Velocities bottom_velocities(const Report& report, const Setup& setup);
/// The same of the layer of water, which moves against the log as the bottom does.
Velocities water_velocities(const Report& report, const Setup& setup);
/// The same for a velocity (x forward, y to starboard, z down) of the vehicle, without the beam frame.
Velocities in_frame(Vec3 velocity, std::optional<double> error, const doppler::Attitude& attitude,
                    const Setup& setup);

Bytes ensemble_bytes(const Report& report, const Setup& setup, const Settings& settings);
Bytes pd4_bytes(const Report& report, const Setup& setup, const Settings& settings);
Bytes pd5_bytes(const Report& report, const Setup& setup, const Settings& settings);

/// Lines of text.
Bytes pd6_bytes(const Report& report, const Setup& setup, const Settings& settings);
Bytes pd13_bytes(const Report& report, const Setup& setup, const Settings& settings);
/// In the format that is set.
Bytes report_bytes(const Report& report, const Setup& setup, const Settings& settings);

/// The vehicle's own velocity, mm/s: starboard, forward, up or east, north, up; error.
std::array<std::int16_t, 4> own_velocities(const Velocities& velocities);
/// m, vertical; 0: none.
double vertical_range(const doppler::BeamReport& beam, const Settings& settings);
/// kPa, of the depth that is set, in sea water.
constexpr double pressure_of(const Setup& setup) { return 1.025 * setup.depth; }
/// As a tilt sensor of two axes reads it, deg.
double tilt_pitch(const doppler::Attitude& attitude);
/// deg, from 0 to below 360.
double compass_heading(const doppler::Attitude& attitude);

/// mm/s; -32768 where there is none.
std::int16_t millimetres(const std::optional<double>& velocity);

}  // namespace echoloop::teledyne_dvl
