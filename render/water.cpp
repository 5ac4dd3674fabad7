#include "render/water.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "render/refraction.h"

namespace echoloop {
namespace {

void require(double value, double low, double high, const char* name, const char* unit) {
    if (value >= low && value <= high) return;  // false for NaN
    throw std::invalid_argument("water: " + std::string(name) + " is " + std::to_string(value) +
                                ", must be within " + std::to_string(low) + ".." + std::to_string(high) +
                                " " + unit);
}

/// One relaxation process: strength f0 f^2 / (f^2 + f0^2), frequencies in kHz.
double relaxation(double f, double f0) { return f0 * f * f / (f * f + f0 * f0); }

/// Viscous absorption of pure water, dB/km/kHz^2 (equation 8 and its continuation above 20 C).
double water_viscosity_term(double t) {
    if (t <= 20) return 4.937e-4 - 2.59e-5 * t + 9.11e-7 * t * t - 1.5e-8 * t * t * t;
    return 3.964e-4 - 1.146e-5 * t + 1.45e-7 * t * t - 6.5e-10 * t * t * t;
}

void validate_profile(const std::vector<SoundSpeedPoint>& profile) {
    if (profile.size() > 1000) throw std::invalid_argument("water: profile has more than 1000 points");
    for (std::size_t i = 0; i < profile.size(); ++i) {
        require(profile[i].depth, 0, 12000, "depth of a profile point", "m");
        require(profile[i].speed, 1300, 1700, "speed of a profile point", "m/s");
        if (i > 0 && !(profile[i].depth > profile[i - 1].depth))
            throw std::invalid_argument("water: depths of the profile must increase from point to point");
    }
}

void validate_scattering(const std::vector<ScatteringPoint>& points) {
    if (points.size() > 1000) throw std::invalid_argument("water: scattering has more than 1000 points");
    for (std::size_t i = 0; i < points.size(); ++i) {
        require(points[i].depth, 0, 12000, "depth of a scattering point", "m");
        require(points[i].strength, -150, 0, "strength of a scattering point", "dB");
        if (i > 0 && !(points[i].depth > points[i - 1].depth))
            throw std::invalid_argument("water: depths of the scattering must increase from point to point");
    }
}

}  // namespace

void validate(const Water& water) {
    require(water.temperature, -4, 40, "temperature", "degrees Celsius");
    require(water.salinity, 0, 45, "salinity", "g/kg");
    require(water.ph, 5, 10, "ph", "");
    require(water.depth, 0, 12000, "depth", "m");
    if (water.sound_speed) require(*water.sound_speed, 1300, 1700, "sound_speed", "m/s");
    validate_profile(water.profile);
    validate_scattering(water.scattering);
}

double sound_speed(const Water& water) {
    if (water.sound_speed) return *water.sound_speed;
    if (!water.profile.empty()) return sound_speed_at(water.profile, water.depth);
    return mackenzie_sound_speed(water.temperature, water.salinity, water.depth);
}

double mackenzie_sound_speed(double t, double s, double d) {
    return 1448.96 + 4.591 * t - 5.304e-2 * t * t + 2.374e-4 * t * t * t + 1.340 * (s - 35) + 1.630e-2 * d +
           1.675e-7 * d * d - 1.025e-2 * t * (s - 35) - 7.139e-13 * t * d * d * d;
}

double absorption_db_per_km(const Water& water, double frequency) {
    const double f = frequency / 1e3, t = water.temperature, s = water.salinity, d = water.depth;
    const double c = water.sound_speed.value_or(1412 + 3.21 * t + 1.19 * s + 0.0167 * d);
    const double boric = 8.86 / c * std::pow(10, 0.78 * water.ph - 5);
    const double boric_f = 2.8 * std::sqrt(s / 35) * std::pow(10, 4 - 1245 / (t + 273));
    const double magnesium = 21.44 * s / c * (1 + 0.025 * t);
    const double magnesium_p = 1 - 1.37e-4 * d + 6.2e-9 * d * d;
    const double magnesium_f = 8.17 * std::pow(10, 8 - 1990 / (t + 273)) / (1 + 0.0018 * (s - 35));
    const double viscous_p = 1 - 3.83e-5 * d + 4.9e-10 * d * d;
    return boric * relaxation(f, boric_f) + magnesium * magnesium_p * relaxation(f, magnesium_f) +
           water_viscosity_term(t) * viscous_p * f * f;
}

double ainslie_mccolm_db_per_km(const Water& water, double frequency) {
    const double f = frequency / 1e3, t = water.temperature, s = water.salinity, z = water.depth / 1e3;
    const double boric_f = 0.78 * std::sqrt(s / 35) * std::exp(t / 26);
    const double magnesium_f = 42 * std::exp(t / 17);
    return 0.106 * relaxation(f, boric_f) * std::exp((water.ph - 8) / 0.56) +
           0.52 * (1 + t / 43) * (s / 35) * relaxation(f, magnesium_f) * std::exp(-z / 6) +
           0.00049 * f * f * std::exp(-(t / 27 + z / 17));
}

namespace {
const double db_per_neper = 20 * std::numbers::log10e;
}

double db_to_neper(double db) { return db / db_per_neper; }
double neper_to_db(double neper) { return neper * db_per_neper; }
double power_to_db(double power_ratio) { return 10 * std::log10(power_ratio); }
double db_to_power(double db) { return std::pow(10, db / 10); }
double amplitude_to_db(double amplitude_ratio) { return 20 * std::log10(amplitude_ratio); }
double db_to_amplitude(double db) { return std::pow(10, db / 20); }

double transmission_loss(double range, double absorption) {
    return 20 * std::log10(range) + absorption * range;
}

}  // namespace echoloop
