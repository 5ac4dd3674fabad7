#include "emulator/devices/family/doppler/echo.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "emulator/devices/family/sounder/water.h"

namespace echoloop::doppler {
namespace {

constexpr double bins_per_pulse = 4;

double time_of(const Shot& shot, std::size_t bin) {
    return shot.first_bin_time + (static_cast<double>(bin) + 0.5) * shot.bin_interval;
}

/// From -pi to below pi.
double bearing_of(double azimuth) {
    constexpr double pi = std::numbers::pi;
    return azimuth - 2 * pi * std::floor((azimuth + pi) / (2 * pi));
}

/// The bin of the strongest echo, if one stands out of the noise and of the water. Without what absorption
/// takes given back the water before the face would be louder than a bottom far away.
std::optional<std::size_t> peak_of(const Echogram& e, std::size_t beam, double detection) {
    const auto powers = e.beam(beam);
    const double gain =
        std::numbers::ln10 / 10 * usual_absorption(e.shot.frequency) * e.sound_speed;  // per s
    const double least = e.noise_power * std::pow(10, detection / 10);
    std::optional<std::size_t> best;
    double strongest = 0;
    for (std::size_t bin = 0; bin < powers.size(); ++bin) {
        const double power = static_cast<double>(powers[bin]) - e.noise_power;
        const double time = time_of(e.shot, bin);
        const double strength = power * time * time * std::exp(gain * time);
        if (static_cast<double>(powers[bin]) <= least || strength <= strongest) continue;
        strongest = strength;
        best = bin;
    }
    if (best && !echosounder::stands_out_of_water(e, beam, *best, static_cast<double>(powers[*best]),
                                                  echosounder::bin_margin))
        return std::nullopt;
    return best;
}

/// Bins of one beam around a time, weighed by their power above the noise.
struct Around {
    const Echogram& echogram;
    std::size_t beam;

    /// Sums over the bins within `half` s of `time`, each weighed by `weigh(power above the noise)`.
    struct Sums {
        double weights = 0, values = 0;
    };
    template <class Value, class Weigh>
    Sums sums(double time, double half, const Value& value, const Weigh& weigh) const {
        const Shot& shot = echogram.shot;
        const auto place = [&](double t) {
            const double bin = std::floor((t - shot.first_bin_time) / shot.bin_interval);
            return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(shot.bins)));
        };
        const auto powers = echogram.beam(beam);
        Sums out;
        const std::size_t end = std::min(place(time + half) + 1, shot.bins);
        for (std::size_t bin = place(time - half); bin < end; ++bin) {
            const double power = static_cast<double>(powers[bin]) - echogram.noise_power;
            const double one = value(bin);
            if (!(power > 0) || std::isnan(one)) continue;
            out.weights += weigh(power);
            out.values += weigh(power) * one;
        }
        return out;
    }
    /// Mean of `value(bin)`; nothing where there is no power.
    template <class Value>
    std::optional<double> mean(double time, double half, const Value& value) const {
        const Sums all = sums(time, half, value, [](double power) { return power; });
        return all.weights > 0 ? std::optional(all.values / all.weights) : std::nullopt;
    }
    /// Standard deviation of that mean by speckle alone: powers are exponentially distributed, so the sum of
    /// their squares is twice that of the squares of their means; bins that one pulse fills vary together.
    template <class Value>
    double scatter(double time, double half, double mean, const Value& value) const {
        const auto square = [&](std::size_t bin) { return std::pow(value(bin) - mean, 2); };
        const double strays = sums(time, half, square, [](double power) { return power * power; }).values;
        const double weights = sums(time, half, value, [](double power) { return power; }).weights;
        return std::sqrt(bins_per_pulse / 2 * strays) / weights;
    }
};

}  // namespace

double usual_absorption(double frequency) {
    // Shares of boric acid and of magnesium sulphate, their relaxation frequencies, kHz, and that of water.
    constexpr double boric = 0.1037, boric_at = 1.117, magnesium = 0.6313, magnesium_at = 75.9,
                     water = 3.108e-4;
    const double khz = frequency / 1000, square = khz * khz;
    return (boric * boric_at * square / (square + boric_at * boric_at) +
            magnesium * magnesium_at * square / (square + magnesium_at * magnesium_at) + water * square) /
           1000;
}

Plan make_plan(const Mode& mode, double speed, const Settings& settings) {
    constexpr double margin = 1.15;  // for a vehicle that is not level, and slopes; own choice
    constexpr double share = 0.1;    // of the way to the nearest bottom that a pulse is long; own choice
    const Acoustics& a = settings.acoustics;
    Plan plan{.mode = mode};
    plan.pulse = std::clamp(share * 2 * mode.nearest / speed, a.shortest_pulse, a.longest_pulse);
    plan.window = 2 * margin * mode.farthest / std::cos(a.tilt) / speed;
    plan.period = std::max(1 / mode.rate, plan.window + settings.processing_time);
    return plan;
}

std::vector<std::size_t> order_of_beams(const Settings& settings) {
    std::vector<std::size_t> order(settings.azimuths.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::size_t i) { return bearing_of(settings.azimuths[i]); });
    return order;
}

Shot make_shot(const Plan& plan, const Settings& settings, std::uint64_t number) {
    const Acoustics& a = settings.acoustics;
    Shot shot;
    shot.ping = number;
    for (const std::size_t beam : order_of_beams(settings))
        shot.bearings.push_back(bearing_of(settings.azimuths[beam]));
    shot.sides.assign(shot.bearings.size(), {std::numbers::pi / 2 - a.tilt, a.source_level});
    shot.beam_width = shot.fan_height = a.beam_width;
    shot.bin_interval = plan.pulse / bins_per_pulse;
    shot.bins = static_cast<std::size_t>(std::ceil(plan.window / shot.bin_interval));
    shot.frequency = a.frequency;
    shot.pulse_length = plan.pulse;
    shot.source_level = a.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    shot.receiver.bandwidth = 1 / plan.pulse;
    shot.interval = plan.period;
    shot.velocities = true;
    return shot;
}

std::optional<Echo> find_bottom_echo(const Echogram& e, std::size_t beam, const Settings& settings) {
    constexpr int steps = 4;
    const auto peak = peak_of(e, beam, settings.acoustics.detection);
    if (!peak) return std::nullopt;
    const Around around{e, beam};
    const double extent =
        std::tan(settings.acoustics.tilt) * settings.acoustics.beam_width;  // of the range, to either side
    double middle = time_of(e.shot, *peak), half = 0;
    for (int step = 0; step < steps; ++step) {
        half = extent * middle + 0.75 * e.shot.pulse_length + e.shot.bin_interval;
        middle =
            around.mean(middle, half, [&](std::size_t bin) { return time_of(e.shot, bin); }).value_or(middle);
    }
    Echo echo;
    // An echo begins at its range. A receiver of the pulse's bandwidth makes it half as long again.
    const double lag = 0.75 * e.shot.pulse_length;
    echo.time = middle - lag;
    const std::size_t first = beam * e.shot.bins;
    const auto later = static_cast<std::size_t>(std::lround(lag / e.shot.bin_interval));
    const auto closing_in = [&](std::size_t bin) {  // of what lies where the echo comes from
        return static_cast<double>(e.velocities[first + bin - std::min(bin, later)].mean);
    };
    if (e.velocities.size() == e.values.size()) echo.closing = around.mean(middle, half, closing_in);
    if (echo.closing) echo.scatter = around.scatter(middle, half, *echo.closing, closing_in);
    echo.level = static_cast<double>(level_db(e.beam(beam)[*peak]));
    return echo.time > 0 ? std::optional(echo) : std::nullopt;
}

}  // namespace echoloop::doppler
