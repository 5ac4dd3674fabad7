#include "render/fan/line_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "render/fan/patches.h"
#include "render/fan/ping_motion.h"
#include "render/fan/range_scale.h"

namespace echoloop {
namespace {

/// Where the echo of the water's surface is added up in steps, too.
struct SurfaceSteps {
    float number = -1;  ///< as Pixel::surface; -1: nowhere
    float* steps = nullptr;
    LineBins bins{};
    float per_bin = 1, last = 0;

    /// Most echoes lie within a step.
    void deposit(float near, float far, float value) {
        const float low = near * per_bin, high = far * per_bin;
        const bool inside = low >= 0 && high < last && static_cast<int>(low) == static_cast<int>(high);
        inside ? void(steps[static_cast<int>(low)] += value) : bins.deposit(low, high, value);
    }
};

SurfaceSteps surface_steps(const BinningInput& in, float* steps) {
    const RangeSteps& of = in.water->steps();
    return {in.water->surface_number(), steps + of.count, LineBins(steps + of.count, of.count),
            1 / static_cast<float>(of.bins), static_cast<float>(of.count)};
}

/// The paper's rule as a strength, which a table holds over the cosine.
const StrengthTable& sigmoid_table() {
    static const StrengthTable table(
        [](double cosine) { return cosine * double{cerqueira_sigmoid(static_cast<float>(cosine))}; });
    return table;
}

/// `weight`: of each sample.
void find_amounts(const BinningInput& in, Amount amount, const PixelRow& row, const float* weight,
                  std::size_t samples, LineEchoes& out) {
    switch (amount) {
        case Amount::echo:
            return find_amounts(row.arrays(), weight, in.strength, {}, samples, out);
        case Amount::wanted_echo:
            return find_amounts(row.arrays(), weight, in.strength, in.wanted, samples, out);
        case Amount::paper_echo:
            return find_amounts_alike(row.arrays(), weight, &sigmoid_table(), samples, out);
        case Amount::paper_share:
            return find_amounts_alike(row.arrays(), weight, nullptr, samples, out);
    }
}

/// What of a line is still under way.
void add_volume(const BinningInput& in, const View& view, std::size_t line, const float* weight,
                LineReader& reader, float* steps) {
    const Reverberation& water = *in.water;
    const PixelRow& row = reader.row();
    UnderWay& under_way = reader.under_way;
    under_way.reset(water);
    if (!water.by_depth()) {
        under_way.add(water, row.range(), row.surface(), weight, view.samples);
        return under_way.scatter(water, steps);
    }
    const auto rise = water.rise(view, view.x(static_cast<double>(line) + 0.5 + in.offset.level.line));
    const auto top = static_cast<float>(view.y(0.5 + in.offset.level.sample)),
               step = static_cast<float>(view.sample_height());
    for (std::size_t i = 0; i < view.samples; ++i) {
        if (!(weight[i] > 0)) continue;
        const float end =
            row.surface()[i] != 0 ? water.place(row.range()[i]) : std::numeric_limits<float>::infinity();
        under_way.add(end, rise.at(top - static_cast<float>(i) * step), weight[i]);
    }
    under_way.scatter(water, steps);
}

/// What a single beam hears of each sample, at the direction where it was taken: a line aperture tells
/// directions apart by their angle off its plane of symmetry, which for one bearing is the smaller the higher
/// it looks.
void weigh_beside(const BinningInput& in, const View& view, std::size_t line, const float* weight,
                  std::vector<float>& out) {
    const double x = view.x(static_cast<double>(line) + 0.5 + in.offset.level.line);
    const double turn = view.bearing - in.plan.beams.front().bearing;
    const auto aside = static_cast<float>(std::sin(turn) + x * std::cos(turn)),
               ahead = static_cast<float>(1 + x * x);
    const auto top = static_cast<float>(view.y(0.5 + in.offset.level.sample)),
               step = static_cast<float>(view.sample_height());
    out.resize(view.samples);
    weigh_by_lobe(in.plan.beside, {aside, ahead, top, step}, weight, view.samples, out.data());
}

}  // namespace

void LineSums::look_at_sectors() {
    for (LineBins& sector : sectors_) sector.look_at(0, bins_);
}

void LineSums::clear_steps(std::size_t i) { std::fill_n(line_steps(i), 2 * steps_, 0.0F); }

void LineSums::clear_sectors() {
    for (std::size_t i = 0; i < sectors_.size(); ++i) sectors_[i].clear(), clear_steps(lines_.size() + i);
}

void LineSums::resize(std::size_t lines, std::size_t sectors, std::size_t bins, std::size_t steps) {
    fit(lines, sectors, bins, steps);
    for (std::size_t i = 0; i < lines; ++i) lines_[i].clear(), clear_steps(i);
    clear_sectors();
}

void LineSums::fit(std::size_t lines, std::size_t sectors, std::size_t bins, std::size_t steps) {
    if (bins == bins_ && steps == steps_ && lines == lines_.size() && sectors == sectors_.size()) return;
    bins_ = bins, steps_ = steps;
    static_assert(bins_at_once <= floats_per_line);
    std::size_t floats = (lines + sectors) * stride() + floats_per_line;
    values_.assign(floats + floats_per_line, 0.0F);
    void* begin = values_.data();
    std::size_t bytes = values_.size() * sizeof(float);
    first_ = static_cast<float*>(
        std::align(floats_per_line * sizeof(float), floats * sizeof(float), begin, bytes));
    lines_.clear(), sectors_.clear();
    for (std::size_t i = 0; i < lines; ++i) lines_.emplace_back(row(i), bins, length());
    for (std::size_t i = 0; i < sectors; ++i) sectors_.emplace_back(row(lines + i), bins, length());
}

void add_level_line(const BinningInput& in, const BinGain& gain, Amount amount, const View& view,
                    std::size_t line, LineReader& reader, LineBins& bins, float* steps) {
    reader.read_alone(in, view, line);
    const std::size_t first = view.first_pixel + line * view.samples;
    const float* weight = is_echo(amount) ? &in.plan.weight[first] : &in.plan.coverage[first];
    const float* plain = weight;
    if (is_echo(amount) && !in.plan.beside.empty()) {
        weigh_beside(in, view, line, plain, reader.weights);
        weight = reader.weights.data();
    }
    if (steps != nullptr) add_volume(in, view, line, weight, reader, steps);
    if (is_echo(amount) && in.motion != nullptr && in.motion->turning != Vec3{} &&
        (!in.plan.beside.empty() || !in.motion->upwards.empty())) {
        weigh_turned(in.plan, *in.motion, view, in.offset.level, line, reader.row().range(),
                     reader.row().surface(), plain, reader.weights);
        weight = reader.weights.data();
    }
    find_spreads(reader.row(), view, static_cast<float>(in.bin_length), end_of(in), reader.extents);
    if (is_echo(amount) && in.patches != nullptr &&
        in.patches->weigh(reader.row(), view, line, in.offset.level, weight, reader.weights))
        weight = reader.weights.data();
    if (in.motion != nullptr) weight = reader.apply_motion(in, view, line, weight);
    LineEchoes& echoes = reader.echoes;
    const PixelRow& row = reader.row();
    const std::size_t samples = view.samples;
    echoes.resize(samples);
    find_amounts(in, amount, row, weight, samples, echoes);
    find_places(row.arrays(), reader.extents, scale_of(in), samples, echoes);
    if (is_echo(amount))
        gain.correct(row.range(), echoes.low.data(), echoes.high.data(), samples, echoes.amount.data());
    if (const float* focus = focus_of(in, view, line); focus != nullptr && is_echo(amount))
        multiply(focus, samples, echoes.amount.data());
    deposit_line(echoes, samples, bins);
    if (steps == nullptr || !reader.meets_water()) return;
    SurfaceSteps water = surface_steps(in, steps);
    for (std::size_t i = 0, next = 0; i < samples; i = next) {
        next = i + count_alike(row.surface() + i, samples - i);
        if (row.surface()[i] != water.number) continue;
        for (std::size_t k = i; k < next; ++k)
            if (echoes.amount[k] > 0) water.deposit(echoes.low[k], echoes.high[k], echoes.amount[k]);
    }
}

}  // namespace echoloop
