#include "emulator/devices/sonar-3d-15/image.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace echoloop::sonar_3d_15 {
namespace {

constexpr double strength_per_db = 5;  // 100 log10 of an amplitude
constexpr double bins_per_pulse = 1.5;

/// Index of the greatest, the first of them; many lanes side by side, of which the compiler makes vectors.
std::size_t peak_of(std::span<const float> levels) {
    constexpr std::size_t lanes = 16;
    std::array<float, lanes> most{};
    std::size_t i = 0;
    for (; i + lanes <= levels.size(); i += lanes)
        for (std::size_t k = 0; k < lanes; ++k) most[k] = std::max(most[k], levels[i + k]);
    for (; i < levels.size(); ++i) most[0] = std::max(most[0], levels[i]);
    const float greatest = *std::max_element(most.begin(), most.end());
    const auto found = std::find(levels.begin(), levels.end(), greatest);
    return found == levels.end() ? 0 : static_cast<std::size_t>(found - levels.begin());
}

/// Mean place of the power in the peak and its two neighbours, in bins from the start of the first.
double centre_of(std::span<const float> levels, std::size_t peak) {
    const std::size_t first = peak > 0 ? peak - 1 : 0, last = std::min(peak + 1, levels.size() - 1);
    double sum = 0, moment = 0;
    for (std::size_t i = first; i <= last; ++i) {
        sum += levels[i];
        moment += levels[i] * (static_cast<double>(i) + 0.5);
    }
    return moment / sum;
}

/// Mean power that beams of the same row hear in that bin, its own among them.
double around(const Echogram& echogram, std::size_t beam, std::size_t bin) {
    constexpr std::size_t reach = 10;  // beams to either side
    const std::size_t column = beam % width, row = beam - column;
    const std::size_t first = row + std::max(column, reach) - reach,
                      last = row + std::min(column + reach, width - 1);
    double sum = 0;
    for (std::size_t other = first; other <= last; ++other) sum += echogram.beam(other)[bin];
    return sum / static_cast<double>(last - first + 1);
}

double gain(double range, const Plan& plan, const Settings& settings) {
    if (!settings.tvg) return 0;
    const double r = std::max(range, 1.0);
    return settings.acoustics.tvg_spreading * std::log10(r) + 2 * settings.mode(plan.high).tvg_absorption * r;
}

}  // namespace

Plan make_plan(const State& state, double speed, const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    Plan plan{state.high, state.range_min, state.range_max, speed};
    const double window = plan.range_max - plan.range_min;
    plan.bins =
        std::clamp(static_cast<std::size_t>(std::ceil(window / a.finest_bin)), std::size_t{1}, a.bins);
    plan.bin = window / static_cast<double>(plan.bins);
    plan.period =
        std::max(1 / settings.mode(plan.high).rate, 2 * plan.range_max / speed + settings.processing_time);
    return plan;
}

Shot make_shot(const Plan& plan, const View& view, const Settings& settings, std::uint64_t number) {
    const ModeFigures& mode = settings.mode(plan.high);
    Shot shot;
    shot.ping = number;
    shot.bearings = view.bearings;
    shot.elevations = view.elevations;
    shot.beam_width = mode.beam_width;
    shot.fan_height = mode.fan_height;
    shot.first_bin_time = 2 * plan.range_min / plan.speed;
    shot.bin_interval = 2 * plan.bin / plan.speed;
    shot.bins = plan.bins;
    shot.frequency = mode.frequency;
    shot.pulse_length = settings.acoustics.pulse_length;
    shot.bandwidth = 1 / (bins_per_pulse * shot.bin_interval);
    shot.source_level = mode.source_level;
    shot.horizontal = settings.acoustics.horizontal;
    shot.vertical = settings.acoustics.vertical;
    shot.receiver = settings.acoustics.receiver;
    shot.receiver.directivity_index = mode.directivity_index;
    shot.interval = plan.period;
    return shot;
}

std::optional<Pixel> strongest(const Echogram& echogram, std::size_t beam, const Plan& plan,
                               const Settings& settings) {
    const auto levels = echogram.beam(beam);
    const std::size_t peak = peak_of(levels);
    const double power = levels[peak];
    if (!(power > 0)) return std::nullopt;
    const double distance = plan.range_min + centre_of(levels, peak) * plan.bin;
    double strength = 255 * power;  // of the paper's rule
    if (echogram.rule != EchoRule::cerqueira2016) {
        const double noise = echogram.noise_power;
        if (noise > 0 && 10 * std::log10(power / noise) < settings.acoustics.detection) return std::nullopt;
        if (10 * std::log10(around(echogram, beam, peak) / power) > settings.acoustics.neighbours)
            return std::nullopt;
        const double db =
            10 * std::log10(power) + gain(distance, plan, settings) - settings.acoustics.reference_level;
        strength = strength_per_db * db;
    }
    if (strength < 1) return std::nullopt;
    return Pixel{distance, static_cast<std::uint8_t>(std::lround(std::min(strength, 255.0)))};
}

namespace {

/// In place, from the first pixel on: a pixel meets neighbours that are smoothed already.
void smooth_once(std::vector<std::uint32_t>& distances) {
    for (std::size_t at = 0; at < distances.size(); ++at) {
        if (distances[at] == 0) continue;
        const std::size_t column = at % width;
        std::array<std::uint32_t, 5> cross{distances[at], at >= width ? distances[at - width] : 0,
                                           at + width < distances.size() ? distances[at + width] : 0,
                                           column > 0 ? distances[at - 1] : 0,
                                           column + 1 < width ? distances[at + 1] : 0};
        std::sort(cross.begin(), cross.end());
        const auto first = std::upper_bound(cross.begin(), cross.end(), 0U);  // 0 is no distance
        distances[at] = *(first + (cross.end() - first - 1) / 2);
    }
}

}  // namespace

/// Before a surface made of a recording's own ranges, twice in place over four neighbours is nearest to its
/// equal pixels in rows, columns and diagonals: 0.46 and 0.15 of pixels one and two apart are equal, where
/// they are 0.48 and 0.17; once in place gives 0.40 and 0.12, three times the median over all eight
/// neighbours 0.35 and 0.12.
std::vector<std::uint32_t> smoothed(std::vector<std::uint32_t> distances) {
    for (int pass = 0; pass < 2; ++pass) smooth_once(distances);
    return distances;
}

double automatic_speed(double temperature, double salinity) {
    const double t = temperature;
    return 1448.96 + 4.591 * t - 5.304e-2 * t * t + 2.374e-4 * t * t * t +
           (1.340 - 1.025e-2 * t) * (salinity - 35);
}

}  // namespace echoloop::sonar_3d_15
