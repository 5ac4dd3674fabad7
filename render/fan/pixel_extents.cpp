#include "render/fan/pixel_extents.h"

#include <algorithm>
#include <cmath>

#include "render/simd.h"

namespace echoloop {
namespace {

ECHOLOOP_SIMD
void extents_of(const float* __restrict range, const float* __restrict cosine,
                const float* __restrict footprint, const float* __restrict surface,
                const float* __restrict range_before, const float* __restrict surface_before,
                const float* __restrict range_after, const float* __restrict surface_after,
                const float* __restrict coverage, float line_offset, float sample_offset, int count,
                float both_ways, float* __restrict near, float* __restrict middle, float* __restrict far) {
    constexpr float at_least = 0.01F;  // m, a step that is no outline
    const int half = count / 2;
    for (int i = 0; i < count; ++i) {
        const float r = range[i], hidden = 1 - coverage[i];
        const bool along_line = footprint[i] >= 0;
        const float size = std::abs(footprint[i]);
        const float vertical =
            range_step(range[i - 1], surface[i - 1], r, range[i + 1], surface[i + 1], size);
        const float across =
            range_step(range_before[i], surface_before[i], r, range_after[i], surface_after[i], size);
        const float greater = along_line ? vertical : across,
                    smaller = both_ways * (along_line ? across : vertical);
        const float step = std::copysign(std::sqrt(greater * greater + smaller * smaller), greater);
        const float centre = along_line ? -sample_offset : -line_offset;
        const float upper = along_line && i < half ? hidden : 0.0F,
                    lower = along_line && i >= half ? hidden : 0.0F;
        const float most = 3 * size + at_least;
        const bool outline =
            along_line && (!(std::abs(range[i - 1] - r) < most) || !(std::abs(range[i + 1] - r) < most));
        const float begin = outline ? -0.0625F : centre - 0.5F + upper,
                    end = outline ? 0.0625F : centre + 0.5F - lower;
        const float square = r * r;
        const float first = square / (r - step * begin), last = square / (r - step * end);
        near[i] =
            std::max(std::min(first, last), r * cosine[i]);  // no point of the plane is nearer than its foot
        far[i] = std::max(first, last);
        middle[i] = square / (r - step * (0.5F * (begin + end)));
    }
}

}  // namespace

void PixelExtents::resize(std::size_t count) { near.resize(count), middle.resize(count), far.resize(count); }

void find_pixel_extents(const PixelRow& before, const PixelRow& row, const PixelRow& after,
                        const float* coverage, PixelOffset offset, std::size_t count, bool both_ways,
                        PixelExtents& extents) {
    extents.resize(count);
    // At a view's edge the line itself stands for its neighbour and must not tell a step: no surface.
    static thread_local std::vector<float> nothing;
    nothing.assign(count, 0.0F);
    const float* no_surface = nothing.data();
    extents_of(row.range(), row.cosine(), row.footprint(), row.surface(), before.range(),
               &before == &row ? no_surface : before.surface(), after.range(),
               &after == &row ? no_surface : after.surface(), coverage, static_cast<float>(offset.line),
               static_cast<float>(offset.sample), static_cast<int>(count), both_ways ? 1.0F : 0.0F,
               extents.near.data(), extents.middle.data(), extents.far.data());
}

}  // namespace echoloop
