#include "tools/said/said.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "tools/said/fields.h"

namespace echoloop::said {
namespace {

struct Row {
    std::string_view family;
    std::unique_ptr<Maker> (*make)();
};
constexpr Row rows[] = {
    {"seanet", make_heads},      {"ping", make_heads},         {"cerulean", make_heads},
    {"imagenex", make_heads},    {"deltat", make_heads},       {"nmea", make_depths},
    {"altimeter", make_depths},  {"waterlinked", make_depths}, {"teledyne", make_depths},
    {"nortek", make_depths},     {"wayfinder", make_depths},   {"oculus", make_oculus},
    {"aris", make_aris},         {"sonar3d", make_sonar3d},    {"kmall", make_kmall},
    {"reson7k", make_reson7k},   {"r2sonic", make_r2sonic},    {"norbit", make_norbit},
    {"edgetech", make_edgetech},
};

}  // namespace

std::unique_ptr<Maker> maker_of(std::string_view family) {
    const auto row = std::ranges::find(rows, family, &Row::family);
    return row == std::end(rows) ? nullptr : row->make();
}

std::optional<Picture> picture_of(std::vector<Strip> strips, Picture picture, double sample) {
    constexpr std::size_t most_bins = 4096, farthest = std::size_t{1} << 30;
    std::ranges::stable_sort(strips, {}, &Strip::bearing);
    std::size_t last = 0;
    for (const Strip& strip : strips) last = std::max(last, strip.first + strip.levels.size());
    if (last == 0 || last > farthest) return std::nullopt;
    const std::size_t step = std::max<std::size_t>(std::bit_floor(last) / 8, 1);
    const std::size_t samples = (last + step - 1) / step * step;
    const std::size_t per_bin = (samples + most_bins - 1) / most_bins;
    picture.bins = (samples + per_bin - 1) / per_bin;
    picture.bin_size = sample * static_cast<double>(per_bin);
    picture.levels.assign(strips.size() * picture.bins, std::numeric_limits<float>::quiet_NaN());
    picture.bearings.clear();
    for (const Strip& strip : strips) {
        const std::size_t beam = picture.bearings.size() * picture.bins;
        for (std::size_t i = 0; i < strip.levels.size(); ++i) {
            float& level = picture.levels[beam + (strip.first + i) / per_bin];
            if (!(level >= strip.levels[i])) level = strip.levels[i];
        }
        picture.bearings.push_back(strip.bearing);
    }
    return checked(std::move(picture));
}

void sort_beams(Picture& picture) {
    if (std::ranges::is_sorted(picture.bearings)) return;
    std::vector<std::size_t> order(picture.bearings.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return picture.bearings[i]; });
    Picture sorted = picture;
    for (std::size_t to = 0; to < order.size(); ++to) {
        const std::size_t from = order[to];
        sorted.bearings[to] = picture.bearings[from];
        if (!picture.ranges.empty()) sorted.ranges[to] = picture.ranges[from];
        if (!picture.levels.empty())
            std::copy_n(picture.levels.begin() + static_cast<std::ptrdiff_t>(from * picture.bins),
                        picture.bins, sorted.levels.begin() + static_cast<std::ptrdiff_t>(to * picture.bins));
    }
    picture = std::move(sorted);
}

}  // namespace echoloop::said
