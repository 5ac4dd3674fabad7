// What the water does to sound: speed and absorption. Pure functions of temperature, salinity, pH and depth;
// knows no scene and no GL.
#pragma once

#include <optional>
#include <vector>

namespace echoloop {

/// One point of a measured profile.
struct SoundSpeedPoint {
    double depth = 0;     ///< m below the surface, positive down
    double speed = 1500;  ///< m/s
    friend bool operator==(const SoundSpeedPoint&, const SoundSpeedPoint&) = default;
};

/// Volume scattering strength at one depth.
struct ScatteringPoint {
    double depth = 0;       ///< m below the surface, positive down
    double strength = -70;  ///< Sv, dB re 1 m^-1
    friend bool operator==(const ScatteringPoint&, const ScatteringPoint&) = default;
};

/// The water that the sonar works in. A profile bends rays and times echoes (ray_table.h) where the effect
/// `refraction` is on.
struct Water {
    double temperature = 10;  ///< degrees Celsius
    double salinity = 35;     ///< practical salinity, g/kg
    double ph = 8;            ///< on the NBS scale
    double depth = 0;         ///< m below the surface, positive down
    std::optional<double>
        sound_speed;  ///< m/s; empty: from `profile`, or Mackenzie 1981 from the values above
    /// Strictly descending into the water, linear between, constant beyond its ends; empty: the same
    /// everywhere.
    std::vector<SoundSpeedPoint> profile{};
    /// Linear in dB between, constant beyond its ends; empty: nothing floats in it.
    std::vector<ScatteringPoint> scattering{};

    friend bool operator==(const Water&, const Water&) = default;
};

/// Throws std::invalid_argument, naming the value and its range, unless everything is finite and temperature
/// is within -4..40 C, salinity 0..45, pH 5..10, depth 0..12000 m and sound speed 1300..1700 m/s, and the
/// profile and the scattering have at most 1000 points each at strictly increasing depths with the same
/// limits and strengths of -150..0 dB.
void validate(const Water& water);

/// Sound speed in m/s at the water's depth: the given one, or that of the profile, or else
/// mackenzie_sound_speed().
double sound_speed(const Water& water);

/// Mackenzie, "Nine-term equation for sound speed in the oceans", JASA 70 (1981) 807, in m/s. The fit holds
/// for 2..30 C, salinity 25..40 and 0..8000 m (standard error 0.07 m/s); outside it extrapolates, in fresh
/// water by less than 1 m/s.
double mackenzie_sound_speed(double temperature, double salinity, double depth);

/// Francois & Garrison, JASA 72 (1982) 896 and 1879: absorption in dB/km, one way, at `frequency` Hz. The fit
/// goes to 1 MHz; above it extrapolates (see absorption_is_extrapolated()). Uses `water.sound_speed` where
/// given and else the paper's own short formula, not Mackenzie's.
double absorption_db_per_km(const Water& water, double frequency);

/// Ainslie & McColm, JASA 103 (1998) 1671: the same in dB/km, to check the other by.
double ainslie_mccolm_db_per_km(const Water& water, double frequency);

/// True above the 1 MHz to which Francois & Garrison fitted their data.
constexpr bool absorption_is_extrapolated(double frequency) { return frequency > 1e6; }

/// Attenuation of amplitude: 1 Np = 20 log10(e) dB = 8.686 dB.
double db_to_neper(double db);
double neper_to_db(double neper);

/// Power ratios take 10 log10, amplitude (pressure) ratios take 20 log10.
double power_to_db(double power_ratio);
double db_to_power(double db);
double amplitude_to_db(double amplitude_ratio);
double db_to_amplitude(double db);

/// One-way transmission loss in dB, spherical spreading re 1 m: 20 log10 R + a R, with `absorption` in dB/m.
double transmission_loss(double range, double absorption);

}  // namespace echoloop
