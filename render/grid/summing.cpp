#include "render/grid/summing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/fan/far_lobes.h"
#include "render/fan/pixel_echoes.h"
#include "render/grid/main_lobes.h"
#include "render/grid/nearest.h"
#include "render/grid/paths.h"
#include "render/grid/turned_pixels.h"
#include "render/simd.h"
#include "render/workers.h"

namespace echoloop {
namespace {

ECHOLOOP_SIMD
void add_scaled(float* __restrict sum, const float* __restrict values, float weight, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) sum[i] += weight * values[i];
}

ECHOLOOP_SIMD
void add_far_and_scale(float* __restrict sum, const float* __restrict a, float weight_a,
                       const float* __restrict b, float weight_b, const float* __restrict gain,
                       std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) sum[i] = (sum[i] + weight_a * a[i] + weight_b * b[i]) * gain[i];
}

ECHOLOOP_SIMD
void multiply(float* __restrict values, const float* __restrict factors, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) values[i] *= factors[i];
}

void add_row(float* sum, const LineBins& row, const float* values, float weight) {
    if (weight > 0 && !row.empty())
        add_scaled(sum + row.begin(), values + row.begin(), weight, row.end() - row.begin());
}

class GridSumming final : public Summing {
  public:
    explicit GridSumming(Workers& workers) : workers_(workers) {}

    std::shared_ptr<const FanPlan> plan(const FanGeometry& geometry,
                                        const PlanDensity& density) const override {
        return std::make_shared<const GridPlan>(plan_grid(geometry, density));
    }

    void sum(const BinningInput& in, std::vector<float>& values, std::vector<float>& fresh) override {
        const GridPlan& plan = grid(in.plan);
        fresh.clear();
        if (in.rule != EchoRule::radiometric) return mean(in, plan, values);
        const BinGain gain(in);
        if (in.water == nullptr) return sum_rows_of(in, gain, plan, gain.values(), values);
        sum_rows_of(in, gain, plan, with_steps(gain.values(), in.water->steps()), rows_);
        const std::size_t beams = rows_.size() / (in.bins + 2 * in.water->steps().count);
        FinishedRows(*in.water, gain.values(), beams, values, fresh).finish(rows_.data(), 0, beams);
    }

    WantedPower sum_wanted(const BinningInput& in, std::span<const std::size_t> lines) override {
        const GridPlan& plan = grid(in.plan);
        const View& last = plan.field_views().back();
        if (lines.front() >= last.first_line + last.lines) return {};
        clear_wanted(plan.axes.size(), in.bins);
        add_wanted(in, plan, lines, wanted_beams_);
        const BinGain gain(in);
        stretches_.clear();
        for (std::size_t beam = 0; beam < wanted_beams_.size(); ++beam) {
            const LineBins& own = wanted_beams_[beam];
            if (own.empty()) continue;
            const WantedPower::Stretch heard{beam * in.bins + own.begin(), beam * in.bins + own.end()};
            multiply(&wanted_[heard.begin], &gain.values()[own.begin()], heard.end - heard.begin);
            stretches_.push_back(heard);
        }
        return {wanted_, stretches_};
    }

    void find_nearest(const BinningInput& in, std::span<BeamTruth> truth) const override {
        find_nearest_of_grid(in, grid(in.plan), truth);
    }

    std::vector<PointEcho> points(const FanPlan& plan, std::span<const TargetEcho> targets) const override {
        return points_of(grid(plan), targets);
    }

  private:
    static const GridPlan& grid(const FanPlan& plan) { return static_cast<const GridPlan&>(plan); }

    /// `of_row`: the gain of the bins, and of the water's steps behind them.
    void sum_rows_of(const BinningInput& in, const BinGain& gain, const GridPlan& plan,
                     const std::vector<float>& of_row, std::vector<float>& rows) {
        const std::size_t steps = in.water != nullptr ? in.water->steps().count : 0, stride = of_row.size();
        beams_ = bins_of_beams(rows, plan.axes.size(), in.bins, stride);
        if (in.water != nullptr) start_water(in, plan, stride, rows);
        outside_.clear();
        add_main_lobes(in, plan, Amount::echo, beams_, in.water != nullptr ? &water_ : nullptr, &outside_);
        if (in.water != nullptr) scatter_water(in, plan, stride, rows);
        add_arrivals(in, gain, arrivals_of(plan, in.paths));
        if (plan.far.nodes > 0) {
            far_.resize(plan.rows * sectors_per_array, plan.far.nodes * sectors_per_array, in.bins, steps);
            // Of rows that turn, their own far lobes hear what comes into the field, too.
            const bool turns = TurnedPixels(in, plan).turns();
            if (!turns) sum_far(plan, in.bins);
            add_surround(in, gain, plan);
            if (turns) sum_far(plan, in.bins);
        }
        finish(plan, stride, of_row, rows);
    }

    void start_water(const BinningInput& in, const GridPlan& plan, std::size_t stride,
                     std::vector<float>& rows) {
        const std::size_t beams = plan.axes.size(), steps = in.water->steps().count;
        water_.under_way.resize(beams), water_.surface.clear();
        for (std::size_t beam = 0; beam < beams; ++beam) {
            water_.under_way[beam].reset_alike(*in.water);
            water_.surface.emplace_back(&rows[beam * stride + in.bins + steps], steps);
        }
    }

    /// A beam hears the depths of its axis.
    void scatter_water(const BinningInput& in, const GridPlan& plan, std::size_t stride,
                       std::vector<float>& rows) {
        const View level;
        for (std::size_t beam = 0; beam < plan.axes.size(); ++beam) {
            const double elevation = plan.geometry.elevations[beam / plan.columns],
                         bearing = plan.geometry.bearings[beam % plan.columns];
            const float rise = in.water->rise(level, std::tan(bearing))
                                   .at(static_cast<float>(std::tan(elevation) / std::cos(bearing)));
            water_.under_way[beam].scatter_alike(*in.water, in.water->cell_near(rise),
                                                 &rows[beam * stride + in.bins]);
        }
    }

    /// An object fills few bins of a large grid, so only those are cleared.
    void clear_wanted(std::size_t beams, std::size_t bins) {
        if (wanted_beams_.size() == beams && wanted_.size() == beams * bins)
            for (LineBins& beam : wanted_beams_) beam.clear();
        else
            wanted_beams_ = bins_of_beams(wanted_, beams, bins);
    }

    void mean(const BinningInput& in, const GridPlan& plan, std::vector<float>& values) {
        beams_ = bins_of_beams(shares_, plan.axes.size(), in.bins);
        add_main_lobes(in, plan, Amount::paper_share, beams_);
        beams_ = bins_of_beams(values, plan.axes.size(), in.bins);
        add_main_lobes(in, plan, Amount::paper_echo, beams_);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = shares_[i] > 0 ? values[i] / shares_[i] : 0;
    }

    /// Their power is complete, so the gain that the beams will get is taken out first.
    void add_arrivals(const BinningInput& in, const BinGain& gain, std::span<const Arrival> arrivals) {
        for (const Arrival& echo : arrivals) {
            const auto low = static_cast<float>((echo.near_range - in.first_range) / in.bin_length);
            const auto high = static_cast<float>((echo.far_range - in.first_range) / in.bin_length);
            const auto bin = static_cast<std::size_t>(std::max(0.5F * (low + high), 0.0F));
            if (bin < in.bins && gain.values()[bin] > 0)
                beams_[echo.beam].deposit(low, high, echo.power / gain.values()[bin]);
        }
    }

    /// The field's echo as its rows and columns hear it.
    void sum_far(const GridPlan& plan, std::size_t bins) {
        const GridFar& far = plan.far;
        const std::size_t steps = 2 * far_.steps();
        for (std::size_t beam = 0; beam < beams_.size(); ++beam) {
            const LineBins& own = beams_[beam];
            if (own.empty() && steps == 0) continue;
            const std::size_t row = beam / plan.columns;
            const float* values = own.values();
            const auto add = [&](LineBins& sum, float* steps_of_sum, float share) {
                if (share > 0 && !own.empty()) sum.add(values, share, own.begin(), own.end());
                if (share > 0 && steps > 0) add_scaled(steps_of_sum, values + bins, share, steps);
            };
            const auto add_line = [&](std::size_t i, float share) {
                add(far_.line(i), far_.line_steps(i), share);
            };
            const auto add_sector = [&](std::size_t i, float share) {
                add(far_.sector(i), far_.sector_steps(i), share);
            };
            const Between across = far.across[beam], up = far.row_sector[row], node = far.node[beam];
            const float to_row = far.row_share[beam], to_column = far.column_share[beam];
            add_line(far.sum_beside(row, across.lower), to_row * (1 - across.next));
            add_line(far.sum_beside(row, across.lower + 1U), to_row * across.next);
            for (const auto& [n, share] :
                 {std::pair(node.lower + 0U, 1 - node.next), {node.lower + 1U, node.next}}) {
                add_sector(far.sum_above(n, up.lower, 0), to_column * share * (1 - up.next));
                add_sector(far.sum_above(n, up.lower + 1U, 0), to_column * share * up.next);
            }
        }
    }

    void add_surround(const BinningInput& in, const BinGain& gain, const GridPlan& plan) {
        if (plan.other_views().empty()) return;
        const std::size_t first = plan.other_views().front().first_pixel,
                          row_sums = plan.rows * sectors_per_array;
        LineReader reader;
        const TurnedPixels turned(in, plan);
        for (const MovedEcho& moved : outside_) add_around(in, plan, moved.echo, moved.pixel - first);
        if (in.water != nullptr) {
            far_under_way_.resize(row_sums + plan.far.nodes * sectors_per_array);
            for (UnderWay& sum : far_under_way_) sum.reset_alike(*in.water);
        }
        for (const View& view : plan.other_views())
            for (std::size_t line = 0; line < view.lines; ++line) {
                list_echoes(in, gain, Amount::echo, view, line, reader, echoes_);
                if (in.motion != nullptr) shift_echoes(in, view, line, reader, echoes_);
                const std::size_t line_first = view.first_pixel + line * view.samples - first;
                for (const PixelEcho& echo : echoes_) {
                    if (!turned.turns())
                        add_around(in, plan, echo, line_first + echo.sample);
                    else if (const auto pixel = turned.heard_at(view, line, echo))
                        add_heard(in, plan, echo, *pixel);
                }
                if (in.water != nullptr)
                    add_under_way(in, plan, reader.row(), view.samples, line_first + first, line_first);
            }
        for (std::size_t sum = 0; in.water != nullptr && sum < far_under_way_.size(); ++sum)
            far_under_way_[sum].scatter_alike(*in.water, in.water->cell_near(0), far_.line_steps(sum));
    }

    /// `pixel`: of those around the field.
    void add_around(const BinningInput& in, const GridPlan& plan, const PixelEcho& echo, std::size_t pixel) {
        const std::size_t row_sums = plan.rows * sectors_per_array;
        for (std::size_t i = plan.far.first[pixel]; i < plan.far.first[pixel + 1]; ++i) {
            const auto [sum, share] = plan.far.shares[i];
            LineBins& bins = sum < row_sums ? far_.line(sum) : far_.sector(sum - row_sums);
            bins.deposit(echo.near, echo.far, echo.amount * share, echo.slope);
            if (echo.of_water) add_surface(in, echo, share, far_.line_steps(sum));
        }
    }

    /// Of one around the field that is heard from another pixel of all, in main lobes if that is the field's.
    void add_heard(const BinningInput& in, const GridPlan& plan, const PixelEcho& echo, std::size_t pixel) {
        if (!plan.is_in_field(pixel))
            return add_around(in, plan, echo, pixel - plan.other_views().front().first_pixel);
        for (const Heard& heard : plan.heard_by(pixel))
            beams_[heard.beam].deposit(
                echo.near, echo.far, echo.amount * static_cast<float>(heard.share) / whole_share, echo.slope);
    }

    static void add_surface(const BinningInput& in, const PixelEcho& echo, float share, float* steps) {
        const RangeSteps& of = in.water->steps();
        const float per_bin = 1 / static_cast<float>(of.bins);
        LineBins(steps + of.count, of.count)
            .deposit(echo.near * per_bin, echo.far * per_bin, echo.amount * share);
    }

    /// Side lobes hear the water as at the sonar's own depth.
    void add_under_way(const BinningInput& in, const GridPlan& plan, const PixelRow& row, std::size_t samples,
                       std::size_t first_weight, std::size_t first_pixel) {
        constexpr float nowhere = std::numeric_limits<float>::infinity();
        for (std::size_t s = 0; s < samples; ++s) {
            const float end = row.surface()[s] != 0 ? in.water->place(row.range()[s]) : nowhere;
            const float weight = plan.weight[first_weight + s];
            for (std::size_t i = plan.far.first[first_pixel + s]; i < plan.far.first[first_pixel + s + 1];
                 ++i)
                far_under_way_[plan.far.shares[i].sum].add(end, weight * plan.far.shares[i].share);
        }
    }

    /// Adds the side lobes, and brings every bin to its level.
    void finish(const GridPlan& plan, std::size_t bins, const std::vector<float>& gain,
                std::vector<float>& values) {
        const GridFar& far = plan.far;
        workers_.run(plan.rows, [&](std::size_t row) {
            float* own = &values[row * plan.columns * bins];
            if (far.nodes == 0) {
                for (std::size_t column = 0; column < plan.columns; ++column)
                    multiply(own + column * bins, gain.data(), bins);
                return;
            }
            thread_local std::vector<float> nodes;
            nodes.assign(far.nodes * bins, 0.0F);
            for (std::size_t node = 0; node < far.nodes; ++node)
                for (std::size_t s = 0; s < sectors_per_array; ++s) {
                    const std::size_t beside = far.sum_beside(row, s), above = far.sum_above(node, s, 0);
                    add_row(&nodes[node * bins], far_.line(beside), far_.line_values(beside),
                            far.beside[node * sectors_per_array + s]);
                    add_row(&nodes[node * bins], far_.sector(above), far_.sector_values(above),
                            far.above[row * sectors_per_array + s]);
                    if (far_.steps() == 0) continue;
                    const std::size_t steps = 2 * far_.steps(), behind = bins - steps;
                    add_scaled(&nodes[node * bins + behind], far_.line_steps(beside),
                               far.beside[node * sectors_per_array + s], steps);
                    add_scaled(&nodes[node * bins + behind], far_.sector_steps(above),
                               far.above[row * sectors_per_array + s], steps);
                }
            for (std::size_t column = 0; column < plan.columns; ++column) {
                const Between at = far.node[row * plan.columns + column];
                const float* lower = &nodes[at.lower * bins];
                add_far_and_scale(own + column * bins, lower, 1 - at.next, lower + bins, at.next, gain.data(),
                                  bins);
            }
        });
    }

    Workers& workers_;
    std::vector<LineBins> beams_, wanted_beams_;
    LineSums far_;                         ///< those of GridFar, rows' sums as lines and columns' as sectors
    WaterOfBeams water_;                   ///< of the main lobes
    std::vector<UnderWay> far_under_way_;  ///< of the sums of far_
    std::vector<PixelEcho> echoes_;
    std::vector<MovedEcho> outside_;  ///< of the field, but heard from around it
    std::vector<float> shares_, wanted_, rows_;
    std::vector<WantedPower::Stretch> stretches_;
};

}  // namespace

std::unique_ptr<Summing> make_grid_summing(Workers& workers) {
    return std::make_unique<GridSumming>(workers);
}

}  // namespace echoloop
