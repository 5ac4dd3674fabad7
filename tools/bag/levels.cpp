#include "tools/bag/levels.h"

#include <limits>

namespace echoloop::bag {
namespace {

constexpr std::size_t most_bins = 512, most_beams = 1024;
constexpr float half_db = 0.5F;
constexpr int steps = 254;

/// 0 for what lies below `floor` or is no number.
char to_byte(float level, float floor, float step) {
    if (!(level >= floor)) return 0;
    return static_cast<char>(std::min(static_cast<int>((level - floor) / step + 1), steps + 1));
}

/// dB of byte 1, so that `loudest` is the last byte.
float floor_below(float loudest) {
    return (std::isfinite(loudest) ? std::ceil(loudest) : 0) - half_db * static_cast<float>(steps);
}

Levels sized(const Grouping& to, const std::vector<double>& bearings) {
    constexpr double digits = 1e5;
    Levels levels;
    levels.rows = to.rows, levels.beams = to.beams, levels.bins = to.bins;
    for (std::size_t i = to.per_beam / 2; i < bearings.size(); i += to.per_beam)
        levels.bearings.push_back(std::round(bearings[i] * digits) / digits);
    levels.bytes.reserve(to.rows * to.beams * to.bins);
    return levels;
}

Grouping grouping_of(const said::Picture& picture) {
    return {picture.elevations.size(), picture.bearings.size(), picture.bins};
}

}  // namespace

Grouping::Grouping(std::size_t rows_, std::size_t columns_, std::size_t bins_)
    : rows(rows_),
      columns(columns_),
      all_bins(bins_),
      beams(columns_),
      bins(bins_),
      per_beam(1),
      per_bin((bins_ + most_bins - 1) / most_bins) {
    if (rows == 1 && columns > 0) per_beam = (columns + most_beams - 1) / most_beams;
    beams = (columns + per_beam - 1) / per_beam;
    if (per_bin > 0) bins = (all_bins + per_bin - 1) / per_bin;
}

Levels levels_of(const Echogram& echo) {
    const Shot& shot = echo.shot;
    const Grouping to(shot.rows(), shot.bearings.size(), shot.bins);
    float loudest = 0;
    for (const float value : echo.values) loudest = std::max(loudest, value);
    const float floor = floor_below(loudest > 0 ? level_db(loudest) : 0);
    const double metres = echo.sound_speed / 2;
    Levels levels = sized(to, shot.bearings);
    levels.pan = shot.pan, levels.beam_width = shot.beam_width;
    levels.sides = !shot.sides.empty();
    constexpr double steep = 0.7;  // of the axis, as the page has it
    levels.down = rotate(echo.world_from_sonar.orientation, {1, 0, 0}).z < -steep;
    levels.first_range = metres * shot.first_bin_time;
    levels.bin_size = metres * shot.bin_interval * static_cast<double>(to.per_bin);
    levels.floor = floor, levels.step = half_db;
    if (echo.noise_power > 0) levels.noise = 10 * std::log10(echo.noise_power);
    const bool objects = echo.objects.size() == echo.values.size();
    to.for_each([&echo](std::size_t at) { return echo.values[at]; },
                [&](std::size_t at) {
                    const float most = echo.values[at];
                    levels.bytes += most > 0 ? to_byte(level_db(most), floor, half_db) : '\0';
                    if (!objects) return;
                    levels.objects += static_cast<char>(echo.objects[at] & 0xFF);
                    levels.objects += static_cast<char>(echo.objects[at] >> 8);
                });
    return levels;
}

Levels levels_of(const said::Picture& picture) {
    const Grouping to = grouping_of(picture);
    Levels levels = sized(to, picture.bearings);
    levels.pan = picture.pan, levels.waterfall = picture.waterfall, levels.down = picture.down;
    levels.first_range = picture.first_range;
    levels.bin_size = picture.bin_size * static_cast<double>(to.per_bin);
    if (levels.beams > 1)
        levels.beam_width =
            (levels.bearings.back() - levels.bearings.front()) / static_cast<double>(levels.beams - 1);
    float loudest = -std::numeric_limits<float>::infinity();
    for (const float level : picture.levels)
        if (level > loudest) loudest = level;
    const bool counts = picture.unit == "counts" || picture.levels.empty();
    constexpr double most = 255;
    if (counts) levels.span = most;
    const float floor = counts ? 1 : floor_below(loudest), step = counts ? 1 : half_db;
    levels.floor = floor, levels.step = step;
    if (!picture.levels.empty())
        to.for_each([&](std::size_t at) { return picture.levels[at]; },
                    [&](std::size_t at) { levels.bytes += to_byte(picture.levels[at], floor, step); });
    return levels;
}

std::vector<float> ranges_of(const said::Picture& picture) {
    std::vector<float> ranges;
    if (picture.ranges.empty()) return ranges;
    const Grouping to = grouping_of(picture);
    for (std::size_t row = 0; row < to.rows; ++row)
        for (std::size_t beam = 0; beam < to.beams; ++beam) {
            float range = 0;
            for (std::size_t c = beam * to.per_beam; c < std::min(to.columns, (beam + 1) * to.per_beam); ++c)
                if (range == 0) range = picture.ranges[row * to.columns + c];
            ranges.push_back(range);
        }
    return ranges;
}

}  // namespace echoloop::bag
