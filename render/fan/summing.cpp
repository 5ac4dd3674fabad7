#include "render/fan/summing.h"
#include "render/simd.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/fan/beam_sums.h"
#include "render/fan/far_lobes.h"
#include "render/fan/line_sums.h"
#include "render/fan/nearest.h"
#include "render/fan/ping_motion.h"
#include "render/fan/target_beams.h"
#include "render/fan/turned_far.h"
#include "render/workers.h"

namespace echoloop {
namespace {

constexpr std::size_t lines_at_once = 32;

/// A stretch of lines of one view: one piece of work.
struct Piece {
    const View* view;
    std::size_t first, last;
};

std::vector<Piece> cut(std::span<const View> views) {
    std::vector<Piece> pieces;
    for (const View& view : views)
        for (std::size_t line = 0; line < view.lines; line += lines_at_once)
            pieces.push_back({&view, line, std::min(line + lines_at_once, view.lines)});
    return pieces;
}

const View& view_with(const FanPlan& plan, std::size_t image_line) {
    const auto after = std::ranges::upper_bound(plan.views, image_line, {}, &View::first_line);
    return *(after - 1);
}

/// The level lines of a plan by bearing.
class LineFinder {
  public:
    explicit LineFinder(const FanPlan& plan) {
        for (const View& view : std::span(plan.views).first(plan.level_views))
            views_.push_back({view.bearing, std::atan(view.right), view.left, 1 / view.line_width(),
                              view.first_line, view.lines});
    }

    /// The line that an echo arrives on, if it is drawn.
    std::optional<std::size_t> at(double bearing) const {
        const Lines* nearest = nullptr;
        double least = 0;
        for (const Lines& view : views_)
            if (const double beyond = std::abs(bearing - view.bearing) - view.half_width;
                nearest == nullptr || beyond < least)
                nearest = &view, least = beyond;
        if (least >= 0) return std::nullopt;
        const double line = (std::tan(bearing - nearest->bearing) - nearest->left) * nearest->per_line;
        return nearest->first + std::min(static_cast<std::size_t>(line), nearest->count - 1);
    }

  private:
    /// Of a level view.
    struct Lines {
        double bearing, half_width;  ///< rad
        double left, per_line;       ///< on the image plane; lines to a unit of it
        std::size_t first, count;
    };
    std::vector<Lines> views_;
};

class FanSumming final : public Summing {
  public:
    explicit FanSumming(Workers& workers) : workers_(workers) {}

    std::shared_ptr<const FanPlan> plan(const FanGeometry& geometry,
                                        const PlanDensity& density) const override {
        return std::make_shared<const FanPlan>(plan_fan(geometry, density));
    }

    void sum(const BinningInput& in, std::vector<float>& values, std::vector<float>& fresh) override {
        const BinGain gain(in);
        fresh.clear();
        if (in.rule == EchoRule::radiometric) {
            add_levels(in, gain, Amount::echo, true);
            if (in.moment == 0) add_paths(in, gain);
            if (in.water == nullptr) return beams_.sum(in, sums_, gain.values(), workers_, values);
            const RangeSteps& steps = in.water->steps();
            FinishedRows finished(*in.water, gain.values(), in.plan.beams.size(), values, fresh);
            beams_.sum_into(in, sums_, with_steps(gain.values(), steps), workers_,
                            [&](std::size_t first, std::size_t count, float* rows) {
                                if (in.motion != nullptr && in.motion->turning != Vec3{})
                                    turn_volume(in, steps, count, rows);
                                finished.finish(rows, first, count);
                            });
            return;
        }
        add_levels(in, gain, Amount::paper_share);
        beams_.sum(in, sums_, {}, workers_, shares_);
        add_levels(in, gain, Amount::paper_echo);
        beams_.sum(in, sums_, {}, workers_, values);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = shares_[i] > 0 ? values[i] / shares_[i] : 0;
    }

    WantedPower sum_wanted(const BinningInput& in, std::span<const std::size_t> lines) override {
        const BinGain gain(in);
        sums_.resize(in.plan.lines, in.plan.far_lobes.sectors, in.bins);
        const auto level_end = std::ranges::lower_bound(lines, in.plan.lines);
        const auto level = lines.first(static_cast<std::size_t>(level_end - lines.begin()));
        workers_.run((level.size() + lines_at_once - 1) / lines_at_once, [&](std::size_t piece) {
            LineReader reader;
            const std::size_t first = piece * lines_at_once;
            for (const std::size_t line :
                 level.subspan(first, std::min(lines_at_once, level.size() - first))) {
                const View& view = view_with(in.plan, line);
                add_level_line(in, gain, Amount::wanted_echo, view, line - view.first_line, reader,
                               sums_.line(line));
            }
        });
        LineReader reader;
        for (const std::size_t line : lines.subspan(level.size())) {
            const View& view = view_with(in.plan, line);
            add_surround_line(in, gain, true, view, line - view.first_line, reader, sums_);
        }
        sums_.look_at_sectors();
        beams_.sum(in, sums_, gain.values(), workers_, wanted_);
        everywhere_ = {0, wanted_.size()};
        return {wanted_, {&everywhere_, 1}};
    }

    void find_nearest(const BinningInput& in, std::span<BeamTruth> truth) const override {
        find_nearest_of_fan(in, truth);
    }

    std::vector<PointEcho> points(const FanPlan& plan, std::span<const TargetEcho> targets) const override {
        return target_beams_.points_of(plan, targets);
    }

  private:
    /// The surround's pixels go to sectors, each of which is added up by one thread; it takes longest and
    /// goes first.
    void add_levels(const BinningInput& in, const BinGain& gain, Amount amount, bool with_surround = false) {
        sums_.fit(in.plan.lines, in.plan.far_lobes.sectors, in.bins,
                  in.water != nullptr ? in.water->steps().count : 0);
        const auto pieces = cut(std::span(in.plan.views).first(in.plan.level_views));
        const auto add = [&](const Piece& piece) {
            thread_local LineReader reader;
            reader.restart();
            for (std::size_t line = piece.first; line < piece.last; ++line) {
                const std::size_t number = piece.view->first_line + line;
                sums_.clear_steps(number);
                add_level_line(in, gain, amount, *piece.view, line, reader, sums_.line(number),
                               sums_.steps() > 0 ? sums_.line_steps(number) : nullptr);
            }
        };
        if (!with_surround) sums_.clear_sectors();
        const std::size_t before = with_surround && pieces.size() > 1 ? 1 : 0;  // a beam's is too little
        workers_.run(pieces.size() + before, [&](std::size_t i) {
            if (i < before)
                add_surround(in, gain);
            else
                add(pieces[i - before]);
        });
        if (with_surround && before == 0) add_surround(in, gain);
    }

    void add_surround(const BinningInput& in, const BinGain& gain) {
        thread_local LineReader reader;
        reader.restart();
        sums_.clear_sectors();
        if (in.water != nullptr) {
            under_way_.resize(in.plan.far_lobes.sectors);
            for (UnderWay& sector : under_way_) sector.reset(*in.water);
        }
        const std::span<UnderWay> under_way =
            in.water != nullptr ? std::span(under_way_) : std::span<UnderWay>();
        for (const View& view : in.plan.surround_views())
            for (std::size_t line = 0; line < view.lines; ++line)
                add_surround_line(in, gain, false, view, line, reader, sums_, under_way);
        sums_.look_at_sectors();
        for (std::size_t s = 0; s < under_way.size(); ++s)
            under_way[s].scatter(*in.water, sums_.sector_steps(s));
        if (!under_way.empty()) turn_water_around(in, sums_);
    }

    /// Their power is complete, so the gain that the beams will get is taken out first.
    void add_paths(const BinningInput& in, const BinGain& gain) {
        if (in.paths.empty()) return;
        const LineFinder lines(in.plan);
        arrivals_.clear();
        for (const PathEcho& path : in.paths) {
            const auto low = static_cast<float>((path.near_range - in.first_range) / in.bin_length);
            const auto high = static_cast<float>((path.far_range - in.first_range) / in.bin_length);
            const auto bin = static_cast<std::size_t>(std::max(0.5F * (low + high), 0.0F));
            if (bin >= in.bins || !(gain.values()[bin] > 0)) continue;
            if (LineBins* row = row_of(in, lines, path))
                arrivals_.push_back({row, low, high, path.power / gain.values()[bin]});
        }
        constexpr std::size_t ahead = 4;
        for (std::size_t i = 0; i < arrivals_.size(); ++i) {
            if (i + ahead < arrivals_.size()) {
                const Arrival& next = arrivals_[i + ahead];
                const float first = std::max(next.low, 0.0F),
                            last = std::min(next.high, static_cast<float>(in.bins));
                if (first < last)
                    prefetch<true>(next.row->data() + static_cast<std::size_t>(first),
                                   static_cast<std::size_t>(last - first) + 1);
            }
            const Arrival& own = arrivals_[i];
            own.row->deposit(own.low, own.high, own.power);
        }
    }

    /// Where an echo that has arrived is added up. A single beam's is complete: it has its sector, or the
    /// line on its axis. A fan's lines are where they are at the transmission, since all of them are turned
    /// later; its sectors are where they are heard.
    LineBins* row_of(const BinningInput& in, const LineFinder& lines, const PathEcho& path) {
        const FanPlan& plan = in.plan;
        if (plan.beams.size() == 1)
            return plan.far_lobes.sectors > 0 ? &sums_.sector(0)
                                              : &sums_.line(lines.at(plan.centre).value_or(0));
        const double sent = double{path.bearing} - (turns_lines(in) ? double{path.turned} : 0);
        if (const auto line = lines.at(sent)) return &sums_.line(*line);
        if (plan.far_lobes.sectors == 0) return nullptr;
        return &sums_.sector(
            sector_at(plan, SectorKind::beside, cone_angle(double{path.bearing} - plan.centre, 0)).sector);
    }

    /// What floats in the water is everywhere, so its echo is that of both patterns together. Of so many
    /// beams.
    static void turn_volume(const BinningInput& in, const RangeSteps& steps, std::size_t count, float* rows) {
        const std::size_t stride = in.bins + 2 * steps.count;
        for (std::size_t step = 0; step < steps.count; ++step) {
            const double bin = (static_cast<double>(step) + 0.5) * static_cast<double>(steps.bins);
            const auto kept = static_cast<float>(in.motion->kept(in.first_range + bin * in.bin_length));
            for (std::size_t beam = 0; beam < count; ++beam) rows[beam * stride + in.bins + step] *= kept;
        }
    }

    /// Bins that an indirect echo covers.
    struct Arrival {
        LineBins* row;
        float low, high, power;
    };

    Workers& workers_;
    LineSums sums_;
    std::vector<Arrival> arrivals_;
    BeamSums beams_;
    mutable TargetBeams target_beams_;
    std::vector<UnderWay> under_way_;  ///< of each sector
    std::vector<float> shares_, wanted_;
    WantedPower::Stretch everywhere_{};
};

}  // namespace

std::unique_ptr<Summing> make_fan_summing(Workers& workers) { return std::make_unique<FanSumming>(workers); }

}  // namespace echoloop
