#include "emulator/devices/nortek-dvl/track.h"

#include <cmath>

#include "emulator/devices/family/doppler/moment.h"

namespace echoloop::nortek_dvl {
namespace {

constexpr std::size_t beams = 4;
constexpr std::uint32_t woken_by_power = 1U << 28, woken_by_break = 2U << 28;

/// By how much each beam counts.
using Weights = std::array<double, beams>;
Weights sum(double a, const Weights& x, double b, const Weights& y) {
    Weights out{};
    for (std::size_t i = 0; i < beams; ++i) out[i] = a * x[i] + b * y[i];
    return out;
}

/// Of x, y, z1 and z2; none where too few beams heard anything.
using Combinations = std::array<std::optional<Weights>, 4>;

/// Beams 1 and 3 are opposite, as are 2 and 4: their difference is horizontal, their sum is vertical. Of
/// three beams the whole pair tells z1, and the single one has its vertical share taken off; so published
/// reports have it.
Combinations combinations(const std::array<bool, beams>& heard, const Settings& settings) {
    const double s = std::sin(settings.acoustics.tilt), c = std::cos(settings.acoustics.tilt);
    std::array<Weights, 2> along{}, down{};  // of each pair
    std::size_t whole = 0, last_whole = 0;
    for (std::size_t pair = 0; pair < 2; ++pair) {
        along[pair][pair] = 1 / (2 * s), along[pair][pair + 2] = -1 / (2 * s);
        down[pair][pair] = down[pair][pair + 2] = 1 / (2 * c);
        if (heard[pair] && heard[pair + 2]) ++whole, last_whole = pair;
    }
    if (whole == 0 || (whole == 1 && !heard[1 - last_whole] && !heard[3 - last_whole])) return {};
    std::optional<Weights> second = down[1];
    if (whole == 1) {
        const std::size_t pair = 1 - last_whole, single = heard[pair] ? pair : pair + 2;
        const double sign = single < 2 ? 1 : -1;
        along[pair] = sum(-sign * c / s, down[last_whole], 0, {});
        along[pair][single] += sign / s;
        second.reset();
    }
    const double a = settings.azimuths[0], b = settings.azimuths[1];
    return {sum(std::cos(a), along[0], std::cos(b), along[1]),
            sum(std::sin(a), along[0], std::sin(b), along[1]), whole == 1 ? down[last_whole] : down[0],
            second};
}

float as_float(double value) { return static_cast<float>(value); }

void set_time(nortek::DvlTrack& out, std::int64_t us) {
    const auto m = doppler::moment_of(us);
    const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
    out.year = byte(m.year() - 1900), out.month = byte(m.month() - 1), out.day = byte(m.day());
    out.hour = byte(m.hour()), out.minute = byte(m.minute()), out.second = byte(m.second());
    out.fraction = static_cast<std::uint16_t>(m.time.subseconds().count() / 100);
}

void set_beam(nortek::DvlTrack& out, std::size_t i, const doppler::BeamReport& beam, const Circumstances& how,
              const Settings& settings) {
    // Without an echo: the middle of what it listened to. Published reports tell something like it.
    double middle = how.plan.window / 2;
    out.beam_velocity[i] = nortek::no_velocity;
    out.beam_merit[i] = nortek::no_merit;
    if (beam.valid) {
        const double share = std::cos(settings.acoustics.tilt);
        const double slant = beam.distance > 0 ? beam.distance : settings.water_layer / share;
        middle = 2 * slant / out.sound_speed + how.plan.pulse / 2;
        out.beam_velocity[i] = as_float(beam.velocity);
        out.distance[i] = as_float(settings.slant_distance ? slant : slant * share);
        out.beam_merit[i] = as_float(beam.deviation);
        out.beam_duration[i] = as_float(how.plan.pulse);
        out.status |= 0x111U << i;
    }
    out.beam_from_trigger[i] = as_float(middle);
    out.beam_from_output[i] = as_float(middle - how.latency);
}

void set_component(nortek::DvlTrack& out, std::size_t i, const std::optional<Weights>& weights,
                   double latency) {
    out.velocity[i] = nortek::no_velocity;
    out.merit[i] = nortek::no_merit;
    double velocity = 0, variance = 0, middle = 0, duration = 0, used = 0;
    for (std::size_t beam = 0; beam < beams; ++beam) {
        const double weight = weights ? (*weights)[beam] : 1;
        if (weights && weight == 0) continue;
        ++used;
        middle += static_cast<double>(out.beam_from_trigger[beam]);
        duration += static_cast<double>(out.beam_duration[beam]);
        velocity += weight * static_cast<double>(out.beam_velocity[beam]);
        variance += std::pow(weight * static_cast<double>(out.beam_merit[beam]), 2);
    }
    if (weights) {
        out.velocity[i] = as_float(velocity);
        out.merit[i] = as_float(std::sqrt(variance));
        out.duration[i] = as_float(duration / used);
        out.status |= 0x11000U << i;
    }
    out.from_trigger[i] = as_float(middle / used);
    out.from_output[i] = as_float(middle / used - latency);
}

}  // namespace

nortek::DvlTrack track_of(const doppler::Measured& measured, const Circumstances& how,
                          const Settings& settings) {
    nortek::DvlTrack out;
    out.serial_number = settings.serial_number;
    set_time(out, how.trigger);
    out.status = how.broke ? woken_by_break : woken_by_power;
    out.sound_speed = as_float(measured.speed_of_sound);
    out.temperature = as_float(how.temperature);
    out.pressure = as_float(how.pressure);
    std::array<bool, beams> heard{};
    for (std::size_t i = 0; i < beams; ++i) {
        heard[i] = measured.beams[i].valid;
        set_beam(out, i, measured.beams[i], how, settings);
    }
    const Combinations all = measured.valid ? combinations(heard, settings) : Combinations{};
    for (std::size_t i = 0; i < beams; ++i) set_component(out, i, all[i], how.latency);
    return out;
}

}  // namespace echoloop::nortek_dvl
