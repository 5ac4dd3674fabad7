#include "render/fan/far_lobes.h"

#include <optional>

#include "render/fan/plan_parts.h"
#include "render/fan/turned_far.h"

namespace echoloop {
namespace {

constexpr std::size_t most_nodes = 64;

constexpr double sector_spacing = std::numbers::pi / (sectors_per_array - 1);

/// A beam's power by angle, sampled more finely than any lobe that is drawn: means over sectors ask for it
/// often.
class PowerTable {
  public:
    /// `reach`: rad, beyond which it is nothing.
    explicit PowerTable(const Lobe& lobe, double reach = 4) {
        for (std::size_t i = 0; i <= 2 * half; ++i) {
            const double angle = (static_cast<double>(i) - static_cast<double>(half)) * step;
            values_.push_back(std::abs(angle) <= reach ? lobe.power(angle) : 0);
        }
    }
    /// `angle`: within +-pi.
    double at(double angle) const {
        return values_[static_cast<std::size_t>(std::clamp(angle / step + half + 0.5, 0.0, 2.0 * half))];
    }

  private:
    static constexpr std::size_t half = 5000;
    static constexpr double step = std::numbers::pi / half;
    std::vector<double> values_;
};

/// Mean pattern of a beam over a sector's tent, without the bearings from `skip_first` to `skip_last`.
double mean_over_sector(const PowerTable& power, double beam, std::size_t sector, double skip_first,
                        double skip_last) {
    constexpr int steps = 65;
    double sum = 0, weights = 0;
    for (int i = 0; i < steps; ++i) {
        const double place = 2 * (i + 0.5) / steps - 1,
                     angle = sector_middle(sector) + place * sector_spacing;
        if (angle >= skip_first && angle <= skip_last) continue;
        sum += (1 - std::abs(place)) * power.at(angle - beam);
        weights += 1 - std::abs(place);
    }
    return weights > 0 ? sum / weights : 0;
}

/// What a beam hears of the lines, at `bearings`, beyond its own ones, as a mean per sector.
void weigh_lines(const FanPlan& plan, const std::vector<LineBearings>& bearings, const PowerTable& power,
                 const BeamLines& own, float* far) {
    std::vector<double> sums(sectors_per_array), lines(sectors_per_array);
    for (std::size_t line = 0; line < plan.lines; ++line) {
        const bool near = line >= own.first_line && line < own.first_line + own.lines;
        const double heard = near ? 0 : power.at(bearings[line].middle - own.bearing);
        const SectorShare share = plan.line_sector[line];
        lines[share.sector] += 1 - share.next, lines[share.sector + 1U] += share.next;
        sums[share.sector] += (1 - share.next) * heard, sums[share.sector + 1U] += share.next * heard;
    }
    for (std::size_t s = 0; s < sectors_per_array; ++s)
        if (lines[s] > 0) far[s] = static_cast<float>(sums[s] / lines[s]);
}

void weigh_surround(const FanPlan& plan, const PowerTable& power, double beam, float* far) {
    const double first = plan.first_edge - plan.centre, last = plan.last_edge - plan.centre;
    for (std::size_t s = 0; s < sectors_per_array; ++s) {
        far[static_cast<std::size_t>(SectorKind::beside) * sectors_per_array + s] =
            static_cast<float>(mean_over_sector(power, beam, s, first, last));
        far[static_cast<std::size_t>(SectorKind::off_plane) * sectors_per_array + s] =
            static_cast<float>(mean_over_sector(power, beam, s, 1, 0));
    }
}

void weigh_ahead(const PowerTable& power, double beam, float* far) {
    for (std::size_t s = 0; s < sectors_per_array; ++s)
        far[static_cast<std::size_t>(SectorKind::ahead) * sectors_per_array + s] =
            static_cast<float>(mean_over_sector(power, beam, s, 1, 0));
}

}  // namespace

void add_far_lobes(FanPlan& plan, const FanGeometry& g, const FanLobes& lobes) {
    const std::size_t beams = plan.beams.size();
    plan.line_sector.resize(plan.lines);
    FarLobes& far = plan.far_lobes;
    const bool both_ways = g.horizontal.ways == 2 && !lobes.horizontal.is_box();
    far.sectors = beams == 1 ? 1 : (both_ways ? 4 : 3) * sectors_per_array;
    if (beams == 1) {
        far.nodes = 1;
        far.weight = {1.0F};  // the surround's pixels carry the whole pattern; all lines are the beam's own
        return;
    }
    const auto bearings = bearings_of_lines(plan);
    for (std::size_t line = 0; line < plan.lines; ++line)
        plan.line_sector[line] = sector_at(plan, SectorKind::lines, bearings[line].middle - plan.centre);
    if (both_ways) find_common_lobes(plan, g, lobes.horizontal);
    const double near = near_beam_widths * g.beam_width;
    const PowerTable power(lobes.horizontal);
    const auto ahead = both_ways ? std::optional(PowerTable(lobes.horizontal, near)) : std::nullopt;
    far.beams_per_node = (beams + most_nodes - 1) / most_nodes;
    far.nodes = (beams - 1 + far.beams_per_node - 1) / far.beams_per_node + 1;
    far.weight.assign(far.nodes * far.sectors, 0.0F);
    for (std::size_t node = 0; node < far.nodes; ++node) {
        const std::size_t beam = std::min(node * far.beams_per_node, beams - 1);
        float* weight = &far.weight[node * far.sectors];
        weigh_lines(plan, bearings, power, plan.beams[beam], weight);
        weigh_surround(plan, power, g.bearings[beam] - plan.centre, weight);
        if (ahead) weigh_ahead(*ahead, g.bearings[beam] - plan.centre, weight);
    }
}

}  // namespace echoloop
