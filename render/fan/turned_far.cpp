#include "render/fan/turned_far.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

#include "render/fan/far_lobes.h"
#include "render/fan/line_sums.h"
#include "render/fan/ping_motion.h"
#include "render/fan/plan_parts.h"

namespace echoloop {
namespace {

/// One way's power, to both sides of the axis.
class Samples {
  public:
    static constexpr int per_width = 32;

    Samples(const Lobe& lobe, double width, int count) {
        for (int i = 0; i < count; ++i) power_.push_back(std::sqrt(lobe.power(i * width / per_width)));
    }
    /// Of two lobes 2 `half` places apart, over that of one with itself, both seen half-way between them from
    /// the place `first` to `last`.
    double common(int half, int first, int last) const {
        double both = 0, one = 0;
        for (int i = first; i < last; ++i) both += at(i - half) * at(i + half), one += at(i) * at(i);
        return both / one;
    }

  private:
    double at(int place) const { return power_[static_cast<std::size_t>(std::abs(place))]; }

    std::vector<double> power_;
};

}  // namespace

void find_common_lobes(FanPlan& plan, const FanGeometry& geometry, const Lobe& lobe) {
    constexpr int far_widths = 6, ahead_widths = 16, whole = Samples::per_width;
    const double width = geometry.beam_width;
    const auto place_of = [&](double angle) { return static_cast<int>(angle / width * whole); };
    const int first = std::min(12 * whole, place_of(std::numbers::pi / 6)),
              near = std::min(static_cast<int>(near_beam_widths) * whole, place_of(std::numbers::pi / 2));
    const Samples samples(lobe, width, std::max(2 * first, near) + ahead_widths * whole);
    const auto table = [&](int widths, int from, int to) {
        LobeTable out{2 * width / whole, {}};
        for (int half = 0; half <= widths * whole / 2; ++half)
            out.values.push_back(static_cast<float>(samples.common(half, from, to)));
        return out;
    };
    plan.common_ahead = table(ahead_widths, -near, near);
    plan.common_far = table(far_widths, first, 2 * first);
    // Turned farther, they fit by chance.
    auto& far = plan.common_far.values;
    const auto last_widths = std::span(far).last(whole);
    const float mean = std::reduce(last_widths.begin(), last_widths.end()) / static_cast<float>(whole);
    far.insert(far.end(), {mean, mean});
}

void turn_water_around(const BinningInput& in, LineSums& sums) {
    const FanPlan& plan = in.plan;
    if (plan.common_far.empty() || in.motion == nullptr || in.motion->turning.z == 0) return;
    const RangeSteps& steps = in.water->steps();
    for (std::size_t step = 0; step < steps.count; ++step) {
        const double bin = (static_cast<double>(step) + 0.5) * static_cast<double>(steps.bins);
        const auto turned = static_cast<float>(in.motion->turning.z *
                                               in.motion->flight(in.first_range + bin * in.bin_length));
        const float far = plan.common_far.at(turned), ahead = plan.common_ahead.at(turned) - far;
        const auto of = [&](SectorKind kind, std::size_t sector) -> float& {
            return sums.sector_steps(static_cast<std::size_t>(kind) * sectors_per_array + sector)[step];
        };
        for (std::size_t s = 0; s < sectors_per_array; ++s) {
            of(SectorKind::ahead, s) += ahead * of(SectorKind::off_plane, s);
            of(SectorKind::off_plane, s) *= far;
            of(SectorKind::beside, s) *= far;
        }
    }
}

}  // namespace echoloop
