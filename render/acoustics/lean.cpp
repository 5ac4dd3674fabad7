#include "render/acoustics/lean.h"

#include <algorithm>
#include <cmath>

#include "render/acoustics/lean_kernels.h"

namespace echoloop {
namespace {

constexpr double farthest = 0.95;    // widths between beams; those farther apart hear little of the same
constexpr float not_worth = 0.125F;  // cells

bool too_far_apart(const Shot& shot) {
    for (std::size_t i = 1; i < shot.bearings.size(); ++i)
        if (shot.bearings[i] - shot.bearings[i - 1] > farthest * shot.beam_width) return true;
    return shot.bearings.size() < 3;
}

}  // namespace

Lean::Lean(const Shot& shot, double cell) : most_(static_cast<float>(most_widths * shot.beam_width / cell)) {
    if (too_far_apart(shot)) return;
    const auto& bearings = shot.bearings;
    const double k = 4 * std::log(2.0) / (shot.beam_width * shot.beam_width);
    const auto scale = [&](double step) { return static_cast<float>(1 / (2 * k * step * cell)); };
    const auto term = [](std::size_t over, std::size_t under, float by) {
        return Term{over, under, by, std::exp(not_worth / std::abs(by))};
    };
    const std::size_t last = bearings.size() - 1;
    beams_.resize(bearings.size());
    for (std::size_t n = 1; n < last; ++n)
        beams_[n].terms[0] = term(n + 1, n - 1, scale(bearings[n + 1] - bearings[n - 1]));
    // At the ends by the parabola through three: half of 4 ln P1 - ln P2 - 3 ln P0 a step.
    const float begin = scale(bearings[2] - bearings[0]), end = scale(bearings[last] - bearings[last - 2]);
    beams_[0] = {{term(1, 0, 3 * begin), term(1, 2, begin)}};
    beams_[last] = {{term(last - 1, last, -3 * end), term(last - 1, last - 2, -end)}};
}

std::pair<std::size_t, std::size_t> Lean::lean_on(std::size_t beam) const {
    const std::size_t first = std::clamp<std::size_t>(beam, 1, beams_.size() - 2) - 1;
    return {first, first + 2};
}

void Lean::cut(std::size_t beam, const Means& means, float least, std::size_t bins, std::size_t most,
               std::vector<Stretch>& out) const {
    constexpr std::size_t block = kernels::lean_block;
    const std::size_t blocks = (bins + block - 1) / block;
    constexpr std::size_t at_once = 128;  // blocks
    out.clear();
    bool differs[at_once];
    for (std::size_t begin = 0; begin < blocks; begin += at_once) {
        const std::size_t those = std::min(at_once, blocks - begin), first = begin * block;
        std::fill_n(differs, those, false);
        for (const Term& term : beams_[beam].terms)
            if (term.scale != 0)
                kernels::differ(means.of(term.over).data() + first, means.of(term.under).data() + first,
                                term.worth, least, std::min(those * block, bins - first), differs);
        for (std::size_t k = 0; k < those; ++k) {
            const std::size_t at = first + k * block, count = std::min(block, bins - at);
            const bool joins = !out.empty() && out.back().leans == differs[k] &&
                               (!differs[k] || out.back().count + count <= most);
            joins ? void(out.back().count += count) : out.push_back({at, count, differs[k]});
        }
    }
}

void Lean::find(std::size_t beam, const Means& means, std::size_t first, std::span<float> out) const {
    const auto levels = [&](std::size_t n) { return means.of(n).data() + first; };
    std::fill(out.begin(), out.end(), 0.0F);
    for (const Term& term : beams_[beam].terms)
        if (term.scale != 0)
            kernels::add_log_ratio(term.scale, levels(term.over), levels(term.under), out.size(), out.data());
    kernels::limit(most_, out.size(), out.data());
}

}  // namespace echoloop
