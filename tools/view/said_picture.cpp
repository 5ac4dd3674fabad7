#include "tools/view/said_picture.h"

#include <cstring>

#include "tools/view/reduce.h"

namespace echoloop::view {
namespace {

struct Scale {
    float floor, step;
};

/// Counts of 8 bits as they are; decibels in half ones below the loudest.
Scale scale_of(const said::Picture& picture) {
    if (picture.unit == "counts" || picture.levels.empty()) return {1, 1};
    constexpr float half = 0.5F;  // dB
    float loudest = -1000;
    for (const float level : picture.levels)
        if (level > loudest) loudest = level;
    return {std::ceil(loudest) - half * static_cast<float>(byte_steps), half};
}

/// Of each group the range of the first beam that has one.
std::string ranges_of(const said::Picture& picture, const Grouping& to) {
    std::string bytes;
    for (std::size_t row = 0; row < to.rows; ++row)
        for (std::size_t beam = 0; beam < to.beams; ++beam) {
            float range = 0;
            for (std::size_t c = beam * to.per_beam; c < std::min(to.columns, (beam + 1) * to.per_beam); ++c)
                if (range == 0) range = picture.ranges[row * to.columns + c];
            std::uint32_t bits = 0;
            std::memcpy(&bits, &range, sizeof bits);
            put_le(bytes, bits, 4);
        }
    return bytes;
}

}  // namespace

std::string message_of(const said::Picture& picture, const std::string& device, std::uint64_t number,
                       double unix_time) {
    const Grouping to(picture.elevations.size(), picture.bearings.size(), picture.bins);
    const auto [floor, step] = scale_of(picture);
    std::string levels;
    if (picture.bins > 0)
        to.for_each(
            [&](std::size_t at) { return picture.levels[at]; },
            [&, low = floor, by = step](std::size_t at) { levels += to_byte(picture.levels[at], low, by); });
    const bool ranges = !picture.ranges.empty();
    const Json head{{"type", "said"},
                    {"device", device},
                    {"name", picture.name},
                    {"number", number},
                    {"t", unix_time},
                    {"unit", picture.unit},
                    {"floor", floor},
                    {"step", step},
                    {"rows", to.rows},
                    {"beams", to.beams},
                    {"bins", picture.bins > 0 ? to.bins : 0},
                    {"bearings", rounded(picture.bearings, to.per_beam)},
                    {"elevations", rounded(picture.elevations, 1)},
                    {"pan", picture.pan},
                    {"waterfall", picture.waterfall},
                    {"down", picture.down},
                    {"assumed", picture.assumed},
                    {"first_range", picture.first_range},
                    {"bin_size", picture.bin_size * static_cast<double>(to.per_bin)},
                    {"ranges", ranges}};
    return with_head(head, levels + (ranges ? ranges_of(picture, to) : ""));
}

}  // namespace echoloop::view
