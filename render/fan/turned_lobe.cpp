#include "render/fan/turned_lobe.h"

#include <algorithm>
#include <cmath>

#include "render/simd.h"

namespace echoloop {
namespace {

/// Between the values of a table; beyond its ends as at them.
ECHOLOOP_SIMD
void look_up(const float* __restrict table, float first, float per_step, float last,
             const float* __restrict at, float beam, int count, float* __restrict out) {
    for (int i = 0; i < count; ++i) {
        const float place = std::min(std::max((at[i] - beam - first) * per_step, 0.0F), last);
        const int cell = static_cast<int>(place);
        const float share = place - static_cast<float>(cell);
        out[i] = table[cell] + share * (table[cell + 1] - table[cell]);
    }
}

}  // namespace

TurnedLobe::TurnedLobe(const FanPlan& plan)
    : both_ways_(plan.geometry.horizontal.ways == 2),
      per_step_(static_cast<float>(1 / plan.across.right.step)) {
    const auto& [left, right] = plan.across;
    const auto steps = static_cast<int>(std::min(left.values.size(), right.values.size())) - 1;
    first_ = static_cast<float>(-steps * right.step);
    for (int i = -steps; i <= steps; ++i) {
        const float power = (i < 0 ? left : right).values[static_cast<std::size_t>(std::abs(i))];
        values_.push_back(both_ways_ ? std::sqrt(power) : power);
    }
}

void TurnedLobe::weigh(std::span<const float> bearings, float beam, float turned,
                       std::vector<float>& weights) const {
    weights.resize(bearings.size());
    const int count = static_cast<int>(bearings.size());
    const float last = static_cast<float>(values_.size()) - 1.5F;
    look_up(values_.data(), first_, per_step_, last, bearings.data(), beam - turned, count, weights.data());
    if (!both_ways_) return;
    static thread_local std::vector<float> sent;
    sent.resize(bearings.size());
    look_up(values_.data(), first_, per_step_, last, bearings.data(), beam, count, sent.data());
    for (std::size_t i = 0; i < sent.size(); ++i) weights[i] *= sent[i];
}

}  // namespace echoloop
