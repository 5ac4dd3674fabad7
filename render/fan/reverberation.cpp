#include "render/fan/reverberation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "render/simd.h"

namespace echoloop {
namespace {

constexpr std::size_t cells_of_depths = 33;

/// Sv as a ratio, m^-1, at a depth.
double scattering_at(std::span<const ScatteringPoint> points, double depth) {
    const auto after = std::ranges::upper_bound(points, depth, {}, &ScatteringPoint::depth);
    if (after == points.begin()) return db_to_power(points.front().strength);
    if (after == points.end()) return db_to_power(points.back().strength);
    const ScatteringPoint &a = *(after - 1), &b = *after;
    const double share = (depth - a.depth) / (b.depth - a.depth);
    return db_to_power(a.strength + share * (b.strength - a.strength));
}

/// Adds to each bin what floats in the water: `first` in the first one and `step` more in each, times `gain`.
ECHOLOOP_SIMD
void add_floating(float first, float step, std::size_t count, const float* __restrict from,
                  const float* __restrict gain, float* __restrict to) {
    for (std::size_t i = 0; i < count; ++i)
        to[i] = from[i] + (first + static_cast<float>(static_cast<int>(i)) * step) * gain[i];
}

/// Of one axis.
double near_range(const AxisPattern& pattern, double width, double wavelength) {
    constexpr double one_way = 1 / 0.72;  // width over that of both ways, of a line
    if (pattern.ways == 2) return 0.52 * wavelength / (width * one_way * width * one_way);
    const double length = pattern.shape == ApertureShape::hamming ? 1.30 : 0.886;  // widths of 1 / length
    return length * wavelength / width / 2;
}

/// `range`: m, of the middle of the first bin.
ECHOLOOP_SIMD
void find_nearness(const std::array<double, 2> near, double range, double length, int count,
                   float* __restrict nearness) {
    for (int i = 0; i < count; ++i) {
        const double middle = range + static_cast<double>(i) * length, square = middle * middle;
        nearness[i] = static_cast<float>(
            square / std::sqrt((square + near[0] * near[0]) * (square + near[1] * near[1])));
    }
}

/// The step in which each direction ends, and how much of its weight is under way in that step and up to it:
/// one after the other.
ECHOLOOP_SIMD
void find_steps(const StepScale scale, const float* __restrict range, const float* __restrict surface,
                const float* __restrict weight, float last, std::size_t count, std::int32_t* __restrict end,
                float* __restrict within_and_before) {
    for (std::size_t i = 0; i < count; ++i) {
        const float met = std::min(std::max(range[i] * scale.per_metre - scale.start + 1, 1.0F), last);
        const float at = surface[i] != 0 ? met : last;
        const auto whole = static_cast<std::int32_t>(at);
        const float heard = weight[i] > 0 ? weight[i] : 0.0F, part = heard * (at - static_cast<float>(whole));
        end[i] = whole, within_and_before[2 * i] = part, within_and_before[2 * i + 1] = heard - part;
    }
}

ECHOLOOP_SIMD
void find_ends(const StepScale scale, const float* __restrict range, const float* __restrict surface,
               float last, std::size_t count, std::int32_t* __restrict step, float* __restrict within) {
    for (std::size_t i = 0; i < count; ++i) {
        const float met = std::min(std::max(range[i] * scale.per_metre - scale.start + 1, 1.0F), last);
        const float at = surface[i] != 0 ? met : last;
        step[i] = static_cast<std::int32_t>(at), within[i] = at - static_cast<float>(step[i]);
    }
}

}  // namespace

void WayEnds::find(const Reverberation& water, const float* range, const float* surface, std::size_t count) {
    step.resize(count), within.resize(count);
    find_ends(water.scale(), range, surface, static_cast<float>(water.steps().count + 1), count, step.data(),
              within.data());
}

std::array<double, 2> near_ranges(const Shot& shot, double wavelength) {
    return {near_range(shot.horizontal, shot.beam_width, wavelength),
            near_range(shot.vertical, shot.fan_height, wavelength)};
}

RangeSteps RangeSteps::of(std::size_t bins) {
    const std::size_t each = (bins + usual - 1) / usual;
    return {(bins + each - 1) / each, each};
}

Reverberation::Reverberation(const WaterAround& around, double first_range, double bin_length,
                             std::size_t bins)
    : around_(around), steps_(RangeSteps::of(bins)) {
    const double step = bin_length * static_cast<double>(steps_.bins);
    scale_ = {static_cast<float>(1 / step), static_cast<float>(first_range / step)};
    end_ = first_range + bin_length * static_cast<double>(bins);
    const auto points = around.scattering;
    const bool varies = std::ranges::any_of(
        points, [&](const ScatteringPoint& point) { return point.strength != points.front().strength; });
    if (varies)
        cells_ = cells_of_depths;
    else
        strengths_.assign(
            steps_.count,
            static_cast<float>(points.empty() ? 0 : bin_length * db_to_power(points.front().strength)));
    for (std::size_t cell = 0; varies && cell < cells_; ++cell)
        for (std::size_t k = 0; k < steps_.count; ++k) {
            const double range = first_range + (static_cast<double>(k) + 0.5) * step;
            const double sine = 2 * static_cast<double>(cell) / static_cast<double>(cells_ - 1) - 1;
            double height = sine * range, focus = 1;
            if (around.rays != nullptr) {
                const auto up = static_cast<float>(sine), length = static_cast<float>(range);
                height = range * static_cast<double>(around.rays->place(up, length).height(up));
                focus = static_cast<double>(around.rays->focus(up, length));
            }
            strengths_.push_back(
                static_cast<float>(focus * bin_length * scattering_at(points, around.depth - height)));
        }
    nearness_.resize(bins);
    find_nearness(around.near, first_range + bin_length / 2, bin_length, static_cast<int>(bins),
                  nearness_.data());
}

std::size_t Reverberation::cell_near(double sine) const {
    return static_cast<std::size_t>(
        std::lround(std::clamp((sine + 1) / 2, 0.0, 1.0) * static_cast<double>(cells_ - 1)));
}

Reverberation::Rise Reverberation::rise(const View& view, double x) const {
    return {rotate(conjugate(view.fan_from_view()), around_.up), x};
}

bool Reverberation::find_plane(const View& view, std::size_t line, PixelOffset offset,
                               PlaneOfLine& plane) const {
    const RayTable* rays =
        around_.rays != nullptr && !around_.rays->surfacing().straight ? around_.rays : nullptr;
    if (!(around_.surface < end_)) return false;
    const Vec3 up = rotate(conjugate(view.fan_from_view()), around_.up);
    const double x = view.x(static_cast<double>(line) + 0.5 + offset.line), upright = up.x - x * up.y;
    const double least = std::min(view.bottom, view.top) - view.sample_height();
    const double most = std::max(view.bottom, view.top) + view.sample_height();
    if (rays == nullptr && !(std::max(upright + up.z * least, upright + up.z * most) > 0)) return false;
    const auto f = [](double value) { return static_cast<float>(value); };
    plane = {f(around_.surface),
             f(upright),
             f(-up.y),
             f(up.z),
             f(x),
             f(view.y(0.5 + offset.sample)),
             f(view.sample_height()),
             f(view.usual_width * view.line_width()),
             f(view.usual_height * view.sample_height()),
             f(2 * end_),
             around_.surface_number,
             rays == nullptr ? nullptr : &rays->surfacing(),
             rays == nullptr ? 1.0F : f(around_.surface / rays->depth())};
    return true;
}

void UnderWay::reset(const Reverberation& water) {
    cells_ = water.cells(), row_ = water.steps().count + 2;
    met_.assign(cells_ * row_, 0.0F);
}

void UnderWay::reset_alike(const Reverberation& water) {
    cells_ = 1, row_ = water.steps().count + 2;
    met_.assign(row_, 0.0F);
}

/// Neighbours mostly end in one step, and a sum waits for the one before: so they take turns in a few rows.
/// Both parts of a weight are one vector, which every processor has.
void UnderWay::add(const Reverberation& water, const float* range, const float* surface, const float* weight,
                   std::size_t count) {
    using Both = float __attribute__((vector_size(2 * sizeof(float))));
    ends_.resize(count), parts_.resize(2 * count);
    find_steps(water.scale(), range, surface, weight, static_cast<float>(row_ - 1), count, ends_.data(),
               parts_.data());
    turns_.assign(2 * turns * row_, 0.0F);
    const auto add = [&](std::size_t i, float* row) {
        float* to = row + 2 * static_cast<std::size_t>(ends_[i]);
        Both sum, part;
        std::memcpy(&sum, to, sizeof sum);
        std::memcpy(&part, &parts_[2 * i], sizeof part);
        sum += part;
        std::memcpy(to, &sum, sizeof sum);
    };
    std::array<float*, turns> rows;
    for (std::size_t turn = 0; turn < turns; ++turn) rows[turn] = &turns_[2 * turn * row_];
    std::size_t i = 0;
    for (; i + turns <= count; i += turns)
        for (std::size_t turn = 0; turn < turns; ++turn) add(i + turn, rows[turn]);
    for (std::size_t turn = 0; i < count; ++i, ++turn) add(i, rows[turn]);
    for (std::size_t step = 1; step < row_; ++step) {
        Both sum{};
        for (std::size_t turn = 0; turn < turns; ++turn)
            sum += Both{rows[turn][2 * step], rows[turn][2 * step + 1]};
        met_[step] += sum[0], met_[step - 1] += sum[1];
    }
}

void UnderWay::scatter(const Reverberation& water, float* steps) {
    for (std::size_t cell = 0; cell < cells_; ++cell) scatter_row(cell, water.strengths(cell), steps);
}

void UnderWay::scatter_alike(const Reverberation& water, std::size_t cell, float* steps) {
    scatter_row(0, water.strengths(cell), steps);
}

void UnderWay::scatter_row(std::size_t number, const float* strength, float* steps) {
    float* row = &met_[number * row_];
    float left = 0;
    for (std::size_t k = row_ - 2; k-- > 0;) {
        left += row[k + 1];
        steps[k] += left * strength[k];
    }
    std::fill_n(row, row_, 0.0F);
}

FinishedRows::FinishedRows(const Reverberation& water, const std::vector<float>& gain, std::size_t rows,
                           std::vector<float>& values, std::vector<float>& fresh)
    : water_(water), gain_(gain), values_(values), fresh_(fresh) {
    const std::size_t bins = water.nearness().size();
    values.resize(rows * bins), fresh.resize(rows * water.steps().count);
    volume_gain_.resize(bins);
    for (std::size_t i = 0; i < bins; ++i) volume_gain_[i] = gain[i] * water.nearness()[i];
}

void FinishedRows::finish(const float* rows, std::size_t first, std::size_t count) {
    const RangeSteps& steps = water_.steps();
    const std::size_t bins = volume_gain_.size(), stride = bins + 2 * steps.count;
    const auto per_step = 1 / static_cast<float>(steps.bins);
    thread_local std::vector<float> volume;
    for (std::size_t row = first; row < first + count; ++row) {
        const float* from = rows + (row - first) * stride;
        float* to = &values_[row * bins];
        const float *floating = from + bins, *surface = floating + steps.count;
        float* own = &fresh_[row * steps.count];
        volume.resize(steps.count + 2);
        std::copy_n(floating, steps.count, volume.begin() + 1);
        volume.front() = volume[1], volume.back() = volume[steps.count];
        for (std::size_t k = 0; k < steps.count; ++k) {
            const std::size_t middle = std::min(k * steps.bins + steps.bins / 2, bins - 1);
            own[k] = floating[k] * volume_gain_[middle] + surface[k] * per_step * gain_[middle];
        }
        // Linear from the middle of a step to that of the next, so over each half of a step.
        const std::size_t half = steps.bins / 2;
        const float* const gains = volume_gain_.data();
        const float past_middle = static_cast<float>(half) + 0.5F - 0.5F * static_cast<float>(steps.bins);
        for (std::size_t k = 0; k < steps.count; ++k) {
            const float *v = &volume[k], rise = (v[1] - v[0]) * per_step, fall = (v[2] - v[1]) * per_step;
            const std::size_t begin = k * steps.bins, middle = std::min(begin + half, bins),
                              end = std::min(begin + steps.bins, bins);
            // The rows are new, and in no near cache.
            prefetch<true>(to + begin + prefetched, end - begin);
            add_floating(0.5F * (v[0] + v[1] + rise), rise, middle - begin, from + begin, gains + begin,
                         to + begin);
            add_floating(v[1] + past_middle * fall, fall, end - middle, from + middle, gains + middle,
                         to + middle);
        }
    }
}

std::vector<float> with_steps(std::vector<float> gain, const RangeSteps& steps) {
    gain.resize(gain.size() + 2 * steps.count, 1.0F);
    return gain;
}

}  // namespace echoloop
