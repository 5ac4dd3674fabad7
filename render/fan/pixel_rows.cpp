#include "render/fan/pixel_rows.h"

#include <cstdint>

#include "render/simd.h"

namespace echoloop {
namespace {

ECHOLOOP_SIMD
void extents_of(const PixelArrays row, const EchoSpread spread, int count, float* __restrict near,
                float* __restrict far) {
    for (int i = 0; i < count; ++i) {
        const float r = row.range[i], half = spread.half(row.footprint[i], r);
        near[i] = std::max(r - half, r * row.cosine[i]);  // no point of the plane is nearer than its foot
        far[i] = r + half;
    }
}

ECHOLOOP_SIMD
void take_apart(const Pixel* __restrict pixels, std::size_t count, float* __restrict range,
                float* __restrict cosine, float* __restrict footprint, float* __restrict surface) {
    for (std::size_t i = 0; i < count; ++i) {
        range[i] = pixels[i].range;
        cosine[i] = pixels[i].cosine;
        footprint[i] = pixels[i].footprint;
        surface[i] = pixels[i].surface;
    }
}

ECHOLOOP_SIMD
void invert(const float* __restrict range, const float* __restrict surface, std::size_t count,
            float* __restrict inverse) {
    for (std::size_t i = 0; i < count; ++i) {
        const float one_over = 1 / range[i];
        inverse[i] = surface[i] != 0 ? one_over : 0.0F;
    }
}

/// Pixels whose way to the plane is shorter than to what they show, or that show nothing, show the plane.
ECHOLOOP_SIMD
void show_plane(const PlaneOfLine plane, std::size_t count, float* __restrict range, float* __restrict cosine,
                float* __restrict footprint, float* __restrict surface) {
    for (std::size_t i = 0; i < count; ++i) {
        const float y = plane.top - static_cast<float>(static_cast<int>(i)) * plane.sample_height;
        const float rise = plane.upright + plane.per_sample * y, square = plane.x * plane.x + y * y + 1;
        const float length = std::sqrt(square), way = plane.height * length / rise;
        const bool met = (rise > 0) & (way < plane.farthest) & ((surface[i] == 0) | (way < range[i]));
        const float along_sample = plane.usual_sample * way * std::abs(y / square - plane.per_sample / rise);
        const float along_line = plane.usual_line * way * std::abs(plane.x / square - plane.per_line / rise);
        const float size = std::min(std::max(along_line, along_sample), 0.5F * way);
        const float size_and_way = along_sample >= along_line ? size : -size;
        range[i] = met ? way : range[i];
        cosine[i] = met ? std::min(rise / length, 1.0F) : cosine[i];
        footprint[i] = met ? size_and_way : footprint[i];
        surface[i] = met ? plane.number : surface[i];
    }
}

/// The same where rays bend. `inverse`, `sine`, `slope`: of RayTable::Surfacing.
ECHOLOOP_SIMD
void show_bent_plane(const PlaneOfLine plane, const float* __restrict inverse, const float* __restrict sine,
                     const float* __restrict slope, std::size_t count, float* __restrict range,
                     float* __restrict cosine, float* __restrict footprint, float* __restrict surface) {
    constexpr float half = RayTable::Surfacing::half, inside = 0.999999F * half;  // of the last place
    for (std::size_t i = 0; i < count; ++i) {
        const float y = plane.top - static_cast<float>(static_cast<int>(i)) * plane.sample_height;
        const float rise = plane.upright + plane.per_sample * y, square = plane.x * plane.x + y * y + 1;
        const float up = rise / std::sqrt(square);
        const int first = static_cast<int>(half + inside * std::copysign(std::sqrt(std::abs(up)), up));
        const int next = first + 1;
        const float before = static_cast<float>(first) - half, after = before + 1;
        const float from = before * std::abs(before), to = after * std::abs(after);
        const float part = (half * half * up - from) / (to - from);
        const float way = plane.deeper / (inverse[first] + part * (inverse[next] - inverse[first]));
        const bool met = (way > 0) & (way < plane.farthest) & ((surface[i] == 0) | (way < range[i]));
        const float change = way * std::abs(slope[first] + part * (slope[next] - slope[first])),
                    per_rise = 1 / (std::abs(rise) > 1e-6F ? rise : 1e-6F);
        const float along_sample =
            plane.usual_sample * change * std::abs(y / square - plane.per_sample * per_rise);
        const float along_line =
            plane.usual_line * change * std::abs(plane.x / square - plane.per_line * per_rise);
        const float size = std::min(std::max(along_line, along_sample), 0.5F * way);
        const float size_and_way = along_sample >= along_line ? size : -size;
        const float arrival = std::min(sine[first] + part * (sine[next] - sine[first]), 1.0F);
        range[i] = met ? way : range[i];
        cosine[i] = met ? arrival : cosine[i];
        footprint[i] = met ? size_and_way : footprint[i];
        surface[i] = met ? plane.number : surface[i];
    }
}

}  // namespace

/// Places are those of the arrays.
void PixelRow::go_on_beyond(float end, std::size_t missing, std::size_t nearest, std::size_t next) {
    if (surface_[nearest] == 0 || surface_[next] == 0) return;
    const float inverse = 2 / range_[nearest] - 1 / range_[next];
    if (!(inverse * end < 1) || range_[nearest] > end) return;
    const float range = 1 / std::max(inverse, 1e-6F), growth = range / range_[nearest];
    range_[missing] = range, surface_[missing] = surface_[nearest];
    cosine_[missing] = cosine_[nearest] / growth, footprint_[missing] = footprint_[nearest] * growth * growth;
}

void PixelRow::load(const Pixel* pixels, std::size_t count, float end, const PlaneOfLine* plane) {
    for (auto* row : {&range_, &cosine_, &footprint_, &surface_}) row->resize(count + 2);
    take_apart(pixels, count, &range_[1], &cosine_[1], &footprint_[1], &surface_[1]);
    if (plane != nullptr && plane->surfacing == nullptr)
        show_plane(*plane, count, &range_[1], &cosine_[1], &footprint_[1], &surface_[1]);
    else if (plane != nullptr)
        show_bent_plane(*plane, plane->surfacing->inverse.data(), plane->surfacing->sine.data(),
                        plane->surfacing->slope.data(), count, &range_[1], &cosine_[1], &footprint_[1],
                        &surface_[1]);
    for (std::size_t i = 1, next = 1; i <= count; i = next) {
        next = i + count_alike(&surface_[i], count + 1 - i);
        if (surface_[i] != 0) continue;
        // Of a gap only the ends have a neighbour that shows something.
        const std::size_t last = next - 1;
        if (i == last && last + 2 <= count && pixels[last].surface != 0)
            go_on_beyond(end, last, last + 1, last + 2);
        if (i > 2 && pixels[i - 2].surface != 0) go_on_beyond(end, i, i - 1, i - 2);
        if (i != last && last + 2 <= count && pixels[last].surface != 0)
            go_on_beyond(end, last, last + 1, last + 2);
    }
    const auto go_on = [](const std::vector<float>& range, std::size_t from, std::size_t by) {
        const float inverse = 2 / range[from] - 1 / range[by];  // 1 / R is linear on a plane
        const bool usable = std::abs(inverse * range[from] - 1) < 0.2F;
        return usable ? 1 / inverse : range[from];
    };
    const std::size_t next = std::min<std::size_t>(2, count), previous = std::max<std::size_t>(1, count - 1);
    range_.front() = go_on(range_, 1, next), range_.back() = go_on(range_, count, previous);
    for (auto* row : {&cosine_, &footprint_, &surface_})
        row->front() = (*row)[1], row->back() = (*row)[count];
    inverse_.resize(count + 2);
    invert(range_.data(), surface_.data(), count + 2, inverse_.data());
}

ECHOLOOP_SIMD
std::size_t count_alike(const float* surface, std::size_t count) {
    constexpr std::size_t at_once = 32;
    const float first = surface[0];
    std::size_t i = 1;
    for (; i + at_once <= count; i += at_once) {
        std::int32_t others = 0;
        for (std::size_t k = 0; k < at_once; ++k) others |= surface[i + k] != first ? 1 : 0;
        if (others != 0) break;
    }
    while (i < count && surface[i] == first) ++i;
    return i;
}

void find_extents(const PixelRow& row, const View& view, Extents& extents) {
    extents.near.resize(view.samples), extents.far.resize(view.samples);
    extents_of(row.arrays(), EchoSpread(view), static_cast<int>(view.samples), extents.near.data(),
               extents.far.data());
}

}  // namespace echoloop
