// What the samples of one level line send back, worked out for the whole line at once before it is sorted
// into bins, since such loops use the processor's vectors. Knows no beams.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/fan/line_bins.h"
#include "render/fan/pixel_rows.h"
#include "render/fan/spread_echoes.h"

namespace echoloop {

/// Where a line's echoes lie: as LineBins::deposit() takes them, one of each per sample.
struct LineEchoes {
    std::vector<float> low, high, amount, slope;
    EchoSpreader spreader;

    void resize(std::size_t samples);
};

/// The window's scale, from m to bins.
struct BinScale {
    float per_metre, start;
};

/// Fills `amount` with weight times strength, 0 where there is no surface or no weight. `strength`: per
/// surface; `wanted`: the same, 0: it does not count; empty: all do.
void find_amounts(PixelArrays row, const float* weight, std::span<const StrengthTable* const> strength,
                  std::span<const std::uint8_t> wanted, std::size_t samples, LineEchoes& out);
/// The same with a strength of 1 (`table` null), or of one table for all surfaces.
void find_amounts_alike(PixelArrays row, const float* weight, const StrengthTable* table, std::size_t samples,
                        LineEchoes& out);
/// The directions (1, x, y) of a line's samples on a view's image plane, as an axis in the plane y = 0 sees
/// them: the part of each that is beside the axis, 1 + x^2, and y of the first sample and down to the next.
struct LineDirections {
    float aside, ahead, top, step;
};
/// Fills `out` with weight times the lobe at the sine of each direction's angle off the axis' plane of
/// symmetry.
void weigh_by_lobe(const LobeTable& lobe, const LineDirections& line, const float* weight,
                   std::size_t samples, float* out);
/// amount *= factor.
void multiply(const float* factor, std::size_t samples, float* amount);
/// Fills low, high and slope. Along a plane seen at grazing incidence the solid angle of a slice of range
/// falls as R^-2, cos(i) as R^-1.
void find_places(PixelArrays row, const Extents& extents, BinScale scale, std::size_t samples,
                 LineEchoes& out);
/// Sets the bins to the sum of all of them, whatever was there before.
void deposit_line(LineEchoes& echoes, std::size_t samples, LineBins& bins);

/// m, the nearest of `samples` pixels with a surface; infinity: there is none.
float nearest_range(const Pixel* pixels, std::size_t samples);

}  // namespace echoloop
