#include "tools/bag/levels.h"

#include <array>
#include <bit>
#include <limits>

#include "render/simd.h"

namespace echoloop::bag {
namespace {

constexpr std::size_t most_bins = 512, most_beams = 1024;
constexpr float half_db = 0.5F;
constexpr int steps = 254;

/// dB of byte 1, so that `loudest` is the last byte.
float floor_below(float loudest) {
    return (std::isfinite(loudest) ? std::ceil(loudest) : 0) - half_db * static_cast<float>(steps);
}

/// 0 for what lies below `floor`.
ECHOLOOP_SIMD void write_bytes(const float* levels, std::size_t count, float floor, float step, char* bytes) {
    const float scale = 1 / step;
    for (std::size_t i = 0; i < count; ++i) {
        const float above = (levels[i] - floor) * scale;
        const float byte = std::min(above + 1, static_cast<float>(steps + 1));
        bytes[i] = static_cast<char>(static_cast<int>(above >= 0 ? byte : 0));
    }
}

std::string bytes_of(const std::vector<float>& levels, float floor, float step) {
    std::string bytes(levels.size(), '\0');
    write_bytes(levels.data(), levels.size(), floor, step, bytes.data());
    return bytes;
}

/// Powers become dB, within 1e-4; far below all others what is 0, less or hardly more. No logarithm of the
/// library's: a picture has hundreds of thousands.
ECHOLOOP_SIMD void to_levels(float* powers, std::size_t count) {
    constexpr float db_per_octave = 3.0102999F, silence = -1000;
    constexpr float least = std::numeric_limits<float>::min();
    for (std::size_t i = 0; i < count; ++i) {
        const auto bits = std::bit_cast<std::int32_t>(powers[i]);
        const auto octave = static_cast<float>((bits >> 23) - 127);
        const float m = std::bit_cast<float>((bits & 0x7FFFFF) | 0x3F800000) - 1.5F;  // -0.5 to 0.5
        // log2(1.5 + m) by Chebyshev points
        const float fraction =
            (((((((0.014778721F) * m - 0.025123203F) * m + 0.037462938F) * m - 0.070589676F) * m +
               0.14252637F) *
                  m -
              0.32063233F) *
                 m +
             0.96179597F) *
                m +
            0.58496277F;
        powers[i] = powers[i] >= least ? db_per_octave * (octave + fraction) : silence;
    }
}

/// `most` of each bin, of it and of every `step`-th value.
ECHOLOOP_SIMD void keep_greater(const float* values, std::size_t step, std::size_t bins, float* most) {
    for (std::size_t bin = 0; bin < bins; ++bin) {
        const float value = values[bin * step];
        most[bin] = value > most[bin] ? value : most[bin];
    }
}

float greatest_of(const std::vector<float>& values) {
    constexpr std::size_t at_once = 8;
    std::array<float, at_once> most{};
    std::size_t i = 0;
    for (; i + at_once <= values.size(); i += at_once)
        for (std::size_t k = 0; k < at_once; ++k) most[k] = std::max(most[k], values[i + k]);
    for (; i < values.size(); ++i) most[0] = std::max(most[0], values[i]);
    return *std::ranges::max_element(most);
}

Levels sized(const Grouping& to, const std::vector<double>& bearings) {
    constexpr double digits = 1e5;
    Levels levels;
    levels.rows = to.rows, levels.beams = to.beams, levels.bins = to.bins;
    for (std::size_t i = to.per_beam / 2; i < bearings.size(); i += to.per_beam)
        levels.bearings.push_back(std::round(bearings[i] * digits) / digits);
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

std::vector<float> Grouping::greatest(const std::vector<float>& values,
                                      std::vector<std::size_t>* places) const {
    if (per_beam == 1 && per_bin == 1 && places == nullptr) return values;
    std::vector<float> found(rows * beams * bins, -std::numeric_limits<float>::infinity());
    if (places != nullptr) places->assign(found.size(), 0);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t from = (row * columns + column) * all_bins;
            const std::size_t to = (row * beams + column / per_beam) * bins;
            if (places == nullptr) {
                for (std::size_t k = 0; k < per_bin; ++k)
                    keep_greater(&values[from + k], per_bin, (all_bins - k + per_bin - 1) / per_bin,
                                 &found[to]);
                continue;
            }
            if (column % per_beam == 0)
                for (std::size_t bin = 0; bin < bins; ++bin) (*places)[to + bin] = from + bin * per_bin;
            for (std::size_t bin = 0, b = 0; bin < bins; ++bin)
                for (std::size_t k = 0; k < per_bin && b < all_bins; ++k, ++b) {
                    if (!(values[from + b] > found[to + bin])) continue;
                    found[to + bin] = values[from + b];
                    (*places)[to + bin] = from + b;
                }
        }
    return found;
}

Levels levels_of(const Echogram& echo) {
    const Shot& shot = echo.shot;
    const Grouping to(shot.rows(), shot.bearings.size(), shot.bins);
    const float loudest = greatest_of(echo.values);
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
    std::vector<std::size_t> places;
    std::vector<float> of_groups = to.greatest(echo.values, objects ? &places : nullptr);
    to_levels(of_groups.data(), of_groups.size());
    levels.bytes = bytes_of(of_groups, floor, half_db);
    levels.objects.reserve(2 * places.size());
    for (const std::size_t at : places) {
        levels.objects += static_cast<char>(echo.objects[at] & 0xFF);
        levels.objects += static_cast<char>(echo.objects[at] >> 8);
    }
    return levels;
}

Levels levels_of(const said::Picture& picture) {
    const Grouping to = grouping_of(picture);
    Levels levels = sized(to, picture.bearings);
    levels.pan = picture.pan, levels.waterfall = picture.waterfall, levels.down = picture.down;
    levels.sides = picture.numbered;
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
    if (!picture.levels.empty()) levels.bytes = bytes_of(to.greatest(picture.levels, nullptr), floor, step);
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
