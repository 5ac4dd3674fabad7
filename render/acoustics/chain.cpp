#include "render/acoustics/chain.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "render/acoustics/beam_chain.h"
#include "render/recently_used.h"
#include "render/workers.h"

namespace echoloop {
namespace {

/// True when a plan of one shot is good for the other.
bool same_geometry(const Shot& a, const Shot& b) {
    return a.bins == b.bins && a.bin_interval == b.bin_interval && a.first_bin_time == b.first_bin_time &&
           a.pulse_length == b.pulse_length && a.bandwidth == b.bandwidth && a.frequency == b.frequency &&
           a.beam_width == b.beam_width && a.horizontal == b.horizontal && a.vertical == b.vertical &&
           a.receiver == b.receiver && a.bearings == b.bearings;
}

struct CachedPlan {
    Shot shot;
    double sound_speed;
    ChainPlan plan;
};

/// The points of one beam in a list that is sorted by beam.
std::span<const PointEcho> points_of(std::span<const PointEcho> sorted, std::size_t beam) {
    const auto [first, last] =
        std::ranges::equal_range(sorted, beam, {}, [](const PointEcho& point) { return point.beam; });
    return {first, last};
}

FreshPower fresh_of(const FreshPower& all, std::size_t beam, std::size_t beams) {
    const std::size_t count = all.steps.size() / beams;
    return {all.steps.subspan(beam * count, count), all.bins_per_step};
}

}  // namespace

class AcousticChain::Impl {
  public:
    Impl(Effects effects, SpeckleOptions speckle, std::shared_ptr<Workers> workers)
        : effects_(effects),
          speckle_(speckle),
          workers_(workers ? std::move(workers) : std::make_shared<Workers>()) {}

    double apply(const Shot& shot, const Pose& pose, double sound_speed, std::span<const PointEcho> points,
                 std::span<float> values, FreshPower fresh, const RowShares* rows) {
        const ChainPlan& plan = plan_for(shot, sound_speed);
        const ChainPing ping{shot.random_key,
                             shot.ping,
                             ScattererView(shot, pose, sound_speed / shot.frequency),
                             shot.pan,
                             shot.bearings,
                             shot.source_level,
                             rows_of(rows, plan, shot, pose, sound_speed),
                             rows != nullptr && rows->first};
        points_.assign(points.begin(), points.end());
        std::ranges::stable_sort(points_, {}, [](const PointEcho& point) { return point.beam; });
        const std::size_t beams = shot.bearings.size();
        const std::size_t parts = values.size() < worth_a_thread ? 1 : std::min(Workers::useful(), beams);
        if (chains_.size() < parts) chains_.resize(parts);
        for (std::size_t part = 0; part < parts; ++part) chains_[part].start(plan, ping);
        const auto bins_of = [&](std::size_t beam) { return values.subspan(beam * shot.bins, shot.bins); };
        const std::vector<Stretch> stretches = stretches_of(beams, parts);
        if (plan.leans()) keep_borders(plan, stretches, bins_of);
        share_out(stretches.size(), parts, [&](std::size_t part, std::size_t number) {
            BeamChain& chain = chains_[part];
            const Stretch& own = stretches[number];
            const BeamChain::Before before = [&](std::size_t beam) -> std::span<const float> {
                if (own.first <= beam && beam < own.last) return bins_of(beam);
                return borders_[number][beam < own.first ? 0 : 1];
            };
            chain.start_stretch();
            for (std::size_t beam = own.first; beam < own.last; ++beam)
                chain.run(beam, points_of(points_, beam), before, fresh_of(fresh, beam, beams),
                          bins_of(beam));
        });
        return plan.noise_power * plan.noise.law.mean;
    }

  private:
    static constexpr std::size_t worth_a_thread = 16'384, most_plans = 64, at_once = 16;

    /// Beams that one thread takes at once.
    struct Stretch {
        std::size_t first, last;
    };
    static std::vector<Stretch> stretches_of(std::size_t beams, std::size_t parts) {
        const std::size_t count = parts == 1 ? 1 : (beams + at_once - 1) / at_once;
        std::vector<Stretch> stretches;
        for (std::size_t i = 0; i < count; ++i)
            stretches.push_back({beams * i / count, beams * (i + 1) / count});
        return stretches;
    }

    /// Copies what the stretches' outer beams need of those beside them, which their threads overwrite.
    template <typename BinsOf>
    void keep_borders(const ChainPlan& plan, std::span<const Stretch> stretches, const BinsOf& bins_of) {
        borders_.resize(std::max(borders_.size(), stretches.size()));
        const auto keep = [&](std::size_t beam, std::vector<float>& border) {
            const std::span<const float> bins = bins_of(beam);
            border.assign(bins.begin(), bins.end());
        };
        for (std::size_t i = 0; i < stretches.size(); ++i) {
            const auto [first, last] = stretches[i];
            if (const std::size_t below = plan.lean.lean_on(first).first; below < first)
                keep(below, borders_[i][0]);
            if (const std::size_t above = plan.lean.lean_on(last - 1).second; above >= last)
                keep(above, borders_[i][1]);
        }
    }

    /// Calls work(part, number) for every stretch. Two parts begin at both ends of some stretches and meet
    /// where they meet, since neighbours share random numbers, and threads are not equally quick.
    template <typename Work>
    void share_out(std::size_t stretches, std::size_t parts, const Work& work) {
        std::vector<std::atomic<std::size_t>> taken((parts + 1) / 2);
        workers_->run(parts, [&](std::size_t part) {
            const std::size_t pair = part / 2, first = stretches * (2 * pair) / parts,
                              last = stretches * std::min(2 * pair + 2, parts) / parts;
            for (std::size_t own = 0; taken[pair]++ < last - first; ++own)
                work(part, part % 2 == 0 ? first + own : last - 1 - own);
        });
    }

    /// With the view and the weights of each row of cells.
    static std::vector<CellRow> rows_of(const RowShares* rows, const ChainPlan& plan, Shot shot,
                                        const Pose& pose, double sound_speed) {
        std::vector<CellRow> out;
        if (rows == nullptr) return out;
        double echo = 0, noise = 0;  // sums of squares
        for (const RowShare& share : rows->shares) {
            shot.tilt = share.tilt;
            const double of_echo = plan.echo.upright.weight(share.distance),
                         of_noise = plan.noise.upright.weight(share.distance);
            echo += of_echo * of_echo;
            noise += of_noise * of_noise;
            out.push_back({share, ScattererView(shot, pose, sound_speed / shot.frequency),
                           static_cast<float>(of_echo), static_cast<float>(of_noise)});
        }
        for (CellRow& row : out) {
            row.echo /= static_cast<float>(std::sqrt(echo));
            row.noise /= static_cast<float>(std::sqrt(noise));
        }
        return out;
    }

    const ChainPlan& plan_for(const Shot& shot, double sound_speed) {
        const auto fits = [&](const CachedPlan& cached) {
            return cached.sound_speed == sound_speed && same_geometry(cached.shot, shot);
        };
        const auto make = [&] {
            return std::pair(CachedPlan{shot, sound_speed, ChainPlan(shot, sound_speed, effects_, speckle_)},
                             std::size_t{1});
        };
        return plans_.get(fits, make).plan;
    }

    Effects effects_;
    SpeckleOptions speckle_;
    RecentlyUsed<CachedPlan> plans_{most_plans};
    std::vector<PointEcho> points_;
    std::vector<std::array<std::vector<float>, 2>> borders_;  ///< below and above each stretch
    std::vector<BeamChain> chains_;                           ///< one per part
    std::shared_ptr<Workers> workers_;
};

AcousticChain::AcousticChain(Effects effects, SpeckleOptions speckle, std::shared_ptr<Workers> workers)
    : impl_(std::make_unique<Impl>(effects, speckle, std::move(workers))) {}
AcousticChain::~AcousticChain() = default;
AcousticChain::AcousticChain(AcousticChain&&) noexcept = default;

double AcousticChain::apply(const Shot& shot, const Pose& world_from_sonar, double sound_speed,
                            std::span<const PointEcho> points, std::span<float> values, FreshPower fresh,
                            const RowShares* rows) {
    return impl_->apply(shot, world_from_sonar, sound_speed, points, values, fresh, rows);
}

}  // namespace echoloop
