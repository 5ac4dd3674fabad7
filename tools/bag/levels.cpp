#include "tools/bag/levels.h"

#include <algorithm>
#include <cmath>

namespace echoloop::bag {
namespace {

constexpr std::size_t most_bins = 512, most_beams = 1024;
constexpr float half_db = 0.5F;
constexpr int steps = 254;

/// Bytes and objects, of the loudest sample of each group.
void fill(Levels& levels, const Echogram& echo, const Grouping& to) {
    const auto floor = static_cast<float>(levels.floor);
    const std::size_t columns = echo.shot.bearings.size(), bins = echo.shot.bins;
    const bool objects = echo.objects.size() == echo.values.size();
    levels.bytes.reserve(to.rows * to.beams * to.bins);
    for (std::size_t row = 0; row < to.rows; ++row)
        for (std::size_t beam = 0; beam < to.beams; ++beam)
            for (std::size_t bin = 0; bin < to.bins; ++bin) {
                std::size_t loudest = 0;
                float most = -1;
                for (std::size_t c = beam * to.per_beam; c < std::min(columns, (beam + 1) * to.per_beam); ++c)
                    for (std::size_t b = bin * to.per_bin; b < std::min(bins, (bin + 1) * to.per_bin); ++b) {
                        const std::size_t at = (row * columns + c) * bins + b;
                        if (echo.values[at] > most) most = echo.values[loudest = at];
                    }
                const float level = most > 0 ? level_db(most) : floor - half_db;
                levels.bytes += static_cast<char>(
                    std::clamp(static_cast<int>((level - floor) / half_db + 1), 0, steps + 1));
                if (!objects) continue;
                levels.objects += static_cast<char>(echo.objects[loudest] & 0xFF);
                levels.objects += static_cast<char>(echo.objects[loudest] >> 8);
            }
}

}  // namespace

Grouping::Grouping(const Shot& shot)
    : rows(shot.rows()),
      beams(shot.bearings.size()),
      bins(shot.bins),
      per_beam(1),
      per_bin((shot.bins + most_bins - 1) / most_bins) {
    if (rows == 1) per_beam = (beams + most_beams - 1) / most_beams;
    beams = (beams + per_beam - 1) / per_beam;
    bins = (bins + per_bin - 1) / per_bin;
}

Levels levels_of(const Echogram& echo) {
    const Shot& shot = echo.shot;
    const Grouping to(shot);
    float loudest = 0;
    for (const float value : echo.values) loudest = std::max(loudest, value);
    const float top = loudest > 0 ? std::ceil(level_db(loudest)) : 0;
    const double metres = echo.sound_speed / 2;
    Levels levels;
    levels.rows = to.rows, levels.beams = to.beams, levels.bins = to.bins;
    constexpr double digits = 1e5;
    for (std::size_t i = to.per_beam / 2; i < shot.bearings.size(); i += to.per_beam)
        levels.bearings.push_back(std::round(shot.bearings[i] * digits) / digits);
    levels.pan = shot.pan, levels.beam_width = shot.beam_width;
    levels.sides = !shot.sides.empty();
    constexpr double steep = 0.7;  // of the axis, as the page has it
    levels.down = rotate(echo.world_from_sonar.orientation, {1, 0, 0}).z < -steep;
    levels.first_range = metres * shot.first_bin_time;
    levels.bin_size = metres * shot.bin_interval * static_cast<double>(to.per_bin);
    levels.floor = top - half_db * static_cast<float>(steps), levels.step = half_db;
    if (echo.noise_power > 0) levels.noise = 10 * std::log10(echo.noise_power);
    fill(levels, echo, to);
    return levels;
}

}  // namespace echoloop::bag
