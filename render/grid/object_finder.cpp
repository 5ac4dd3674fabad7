#include "render/grid/object_finder.h"

#include <algorithm>
#include <limits>
#include <set>

#include "render/fan/line_sums.h"
#include "render/grid/binning.h"

namespace echoloop {
namespace {

std::set<std::uint32_t> objects_in_sight(const BinningInput& in, const GridPlan& plan,
                                         std::span<const std::uint32_t> object_of_surface) {
    std::vector<bool> seen(object_of_surface.size());
    for (const View& view : plan.field_views())
        for (std::size_t line = view.first_line; line < view.first_line + view.lines; ++line)
            for (const Pixel& pixel : in.pixels.subspan(line * in.plan.samples, view.samples))
                if (pixel.surface != 0) seen[static_cast<std::size_t>(pixel.surface) - 1] = true;
    std::set<std::uint32_t> objects;
    for (std::size_t surface = 0; surface < seen.size(); ++surface)
        if (seen[surface]) objects.insert(object_of_surface[surface]);
    return objects;
}

}  // namespace

void find_grid_objects(BinningInput in, const GridPlan& plan,
                       std::span<const std::uint32_t> object_of_surface, double least,
                       std::vector<std::uint16_t>& objects) {
    constexpr std::uint32_t last_number = std::numeric_limits<std::uint16_t>::max();
    const std::vector<float> gain = BinGain(in).values();
    std::vector<float> power, strongest(plan.across.size() * in.bins, static_cast<float>(least));
    std::vector<LineBins> beams = bins_of_beams(power, plan.across.size(), in.bins);
    objects.assign(strongest.size(), 0);
    std::vector<std::uint8_t> wanted(object_of_surface.size());
    in.wanted = wanted;
    for (const std::uint32_t object : objects_in_sight(in, plan, object_of_surface)) {
        for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = object_of_surface[i] == object ? 1 : 0;
        add_main_lobes(in, plan, Amount::wanted_echo, beams);
        const auto number = static_cast<std::uint16_t>(std::min(object + 1, last_number));
        for (std::size_t beam = 0; beam < beams.size(); ++beam) {
            for (std::size_t bin = beams[beam].begin(); bin < beams[beam].end(); ++bin) {
                const std::size_t i = beam * in.bins + bin;
                if (power[i] * gain[bin] <= strongest[i]) continue;
                strongest[i] = power[i] * gain[bin];
                objects[i] = number;
            }
            beams[beam].clear();
        }
    }
}

}  // namespace echoloop
