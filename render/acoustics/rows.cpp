#include "render/acoustics/rows.h"

#include <algorithm>
#include <cmath>

#include "render/acoustics/random.h"
#include "render/acoustics/scatterer_view.h"

namespace echoloop {
namespace {

/// Of row `row` of beams: rows of cells in elevation, as cells along the beams, with the height of a beam for
/// its width. They are counted upwards from the lowest that the lowest beams hear.
RowShares shares_of(const Shot& grid, std::size_t row) {
    const double cell = AngularGrid(grid.fan_height).cell_width();  // rad
    const int cells = BeamKernel{}.cells();                         // no kernel reaches farther
    const double place = (grid.elevations[row] - grid.elevations.front()) / cell + cells;
    const double whole = std::floor(place);
    RowShares out{row == 0, {}};
    for (int step = 1 - cells; step <= cells; ++step) {
        const double number = whole + step;
        out.shares.push_back({static_cast<std::uint32_t>(number),
                              mix(grid.random_key, static_cast<std::uint64_t>(number)),
                              grid.tilt + grid.elevations.front() + (number - cells) * cell, place - number});
    }
    return out;
}

}  // namespace

void apply_to_rows(AcousticChain& chain, std::vector<PointEcho> points, Echogram& echogram,
                   FreshPower fresh) {
    const Shot& grid = echogram.shot;
    if (grid.elevations.empty()) {
        echogram.noise_power = chain.apply(grid, echogram.world_from_sonar, echogram.sound_speed, points,
                                           echogram.values, fresh);
        return;
    }
    const std::size_t columns = grid.bearings.size(), size = columns * grid.bins,
                      fresh_size = fresh.steps.size() / grid.rows();
    std::ranges::stable_sort(points, {}, &PointEcho::beam);
    Shot row = grid;
    row.elevations.clear();
    auto first = points.begin();
    for (std::size_t i = 0; i < grid.rows(); ++i) {
        row.tilt = grid.tilt + grid.elevations[i];
        row.random_key = mix(grid.random_key, i);
        const auto last =
            std::ranges::lower_bound(first, points.end(), (i + 1) * columns, {}, &PointEcho::beam);
        std::for_each(first, last, [&](PointEcho& point) { point.beam -= i * columns; });
        const RowShares shares = shares_of(grid, i);
        echogram.noise_power =
            chain.apply(row, echogram.world_from_sonar, echogram.sound_speed, {first, last},
                        std::span(echogram.values).subspan(i * size, size),
                        {fresh.steps.subspan(i * fresh_size, fresh_size), fresh.bins_per_step}, &shares);
        first = last;
    }
}

}  // namespace echoloop
