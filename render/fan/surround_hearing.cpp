#include "render/fan/surround_hearing.h"

#include <algorithm>

#include "render/fan/far_lobes.h"
#include "render/simd.h"

namespace echoloop {
namespace {

/// Without a gap between them, so that a row of them is an array of floats.
constexpr std::size_t floats = 9;
static_assert(sizeof(SurroundPixel) == floats * sizeof(float));

ECHOLOOP_SIMD
void hear(const float* __restrict pixel, float line, float sample, std::size_t count,
          float* __restrict beside, float* __restrict off_plane, float* __restrict place) {
    for (std::size_t i = 0; i < count; ++i, pixel += floats) {
        beside[i] = pixel[0] + pixel[1] * line + pixel[2] * sample;
        off_plane[i] = pixel[3] + pixel[4] * line + pixel[5] * sample;
        place[i] = pixel[6] + pixel[7] * line + pixel[8] * sample;
    }
}

/// Both kinds together, which do not depend on the place.
ECHOLOOP_SIMD
void hear_as_one(const float* __restrict pixel, float line, float sample, std::size_t count,
                 float* __restrict heard) {
    for (std::size_t i = 0; i < count; ++i, pixel += floats)
        heard[i] = (pixel[0] + pixel[1] * line + pixel[2] * sample) +
                   (pixel[3] + pixel[4] * line + pixel[5] * sample);
}

ECHOLOOP_SIMD
void find_sectors(const float* __restrict place, std::size_t count, std::int32_t* __restrict sector,
                  float* __restrict next) {
    constexpr auto last = static_cast<float>(sectors_per_array - 2);
    for (std::size_t i = 0; i < count; ++i) {
        const float inside = std::min(std::max(place[i], 0.0F), last);
        sector[i] = static_cast<std::int32_t>(inside);
        next[i] = std::min(std::max(place[i] - static_cast<float>(sector[i]), 0.0F), 1.0F);
    }
}

ECHOLOOP_SIMD
bool any_above_nothing(const float* values, std::size_t count) {
    std::int32_t above = 0;
    for (std::size_t i = 0; i < count; ++i) above |= values[i] > 0 ? 1 : 0;
    return above != 0;
}

}  // namespace

void SurroundHearing::find(std::span<const SurroundPixel> pixels, PixelOffset offset, bool single) {
    const std::size_t count = pixels.size();
    const float* first = &pixels.front().beside.mean;
    const auto line = static_cast<float>(offset.line), sample = static_cast<float>(offset.sample);
    if (single) {
        beside.resize(count);
        hear_as_one(first, line, sample, count, beside.data());
        for (auto* nothing : {&off_plane, &place, &next}) nothing->assign(count, 0.0F);
        sector.assign(count, 0);
    } else {
        for (auto* numbers : {&beside, &off_plane, &place, &next}) numbers->resize(count);
        sector.resize(count);
        hear(first, line, sample, count, beside.data(), off_plane.data(), place.data());
        find_sectors(place.data(), count, sector.data(), next.data());
    }
    any_beside = any_above_nothing(beside.data(), count);
    any_off_plane = !single && any_above_nothing(off_plane.data(), count);
}

}  // namespace echoloop
