#include "render/acoustics/rows.h"

#include <algorithm>

#include "render/acoustics/random.h"

namespace echoloop {

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
        echogram.noise_power =
            chain.apply(row, echogram.world_from_sonar, echogram.sound_speed, {first, last},
                        std::span(echogram.values).subspan(i * size, size),
                        {fresh.steps.subspan(i * fresh_size, fresh_size), fresh.bins_per_step});
        first = last;
    }
}

}  // namespace echoloop
