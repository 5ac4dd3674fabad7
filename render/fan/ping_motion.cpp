#include "render/fan/ping_motion.h"

#include <algorithm>
#include <cmath>

#include "render/fan/plan_parts.h"
#include "render/simd.h"

namespace echoloop {
namespace {

constexpr double least_share = 0.1;  ///< of a bin, or a beam: what matters

/// Of the part of it that is at the sonar.
Vec3 velocity_at_sonar(const PingMoves& moves, std::size_t mover) {
    if (mover == 0 || mover > moves.mover_motions.size()) return {};
    const Pose& pose = moves.movers[mover - 1];
    const Motion& motion = moves.mover_motions[mover - 1];
    return motion.velocity + cross(rotate(pose.orientation, motion.turning), moves.sonar - pose.position);
}

void find_approach(const PingMoves& moves, PingMotion& out) {
    const auto in_fan = [&](Vec3 world) { return rotate(conjugate(moves.world_from_fan), world); };
    std::vector<Vec3> by_mover;
    bool alike = true;
    for (std::size_t mover = 0; mover <= moves.movers.size(); ++mover) {
        const Vec3 theirs = velocity_at_sonar(moves, mover);
        alike = alike && theirs == Vec3{};
        by_mover.push_back(in_fan(moves.own.velocity - theirs));
        out.fastest = std::max(out.fastest, norm(by_mover.back()));
    }
    out.own = in_fan(moves.own.velocity);
    out.approach.assign(1, by_mover.front());
    if (alike) return;
    out.approach.clear();
    for (const std::uint32_t mover : moves.mover_of_surface)
        out.approach.push_back(by_mover[std::min<std::size_t>(mover, moves.movers.size())]);
}

/// rad/s that matter of what the array turns by; `flight`: s, the longest.
Vec3 turning_that_matters(const Shot& shot, const FanPlan& plan, Vec3 turning, double flight) {
    const bool boxes = !plan.geometry.patterns;
    const double across = std::abs(turning.z) * flight, along = std::hypot(turning.x, turning.y) * flight;
    const bool matters = across > least_share * shot.beam_width || along > least_share * shot.fan_height;
    return matters && !boxes ? turning : Vec3{};
}

bool is_piston(const FanGeometry& g) {
    return g.bearings.size() == 1 && g.elevations.empty() && g.vertical.shape == ApertureShape::piston;
}

/// As far as level views reach, and the receiver turns.
LobeTable upwards_of(const FanPlan& plan, double turn) {
    const FanGeometry& g = plan.geometry;
    if (g.vertical.ways != 2 || !g.elevations.empty()) return {};
    const FanLobes lobes(g, nullptr);
    const double widest = is_piston(g) ? lobes.horizontal.edge() : 0;
    const double reach = std::min(1.0, std::sin(drawn_half_height(lobes)) + widest + turn);
    LobeTable table{std::sin(g.fan_height) / 60, {}};
    for (double sine = 0; sine < reach + 3 * table.step; sine += table.step)
        table.values.push_back(static_cast<float>(lobes.vertical.power(std::asin(std::min(sine, 1.0)))));
    return table;
}

/// `turned` and `width` in rad, one way.
double kept_by_line(double turned, double width) {
    if (!(width > 0)) return 1;
    const double a = 2 * 1.391557 * 2 * turned / width;
    return std::abs(a) < 1e-2 ? 1 - a * a / 20 : 6 / (a * a) * (1 - std::sin(a) / a);
}

/// rad, of one way, of an axis that sends and receives; else 0.
double both_ways(const AxisPattern& pattern, double width) { return pattern.ways == 2 ? width / 0.72 : 0; }

ECHOLOOP_SIMD
void closing_of_row(float ahead, float up, float square, float top, float step, int count,
                    float* __restrict out) {
    for (int i = 0; i < count; ++i) {
        const float y = top - static_cast<float>(i) * step;
        out[i] = (ahead + up * y) / std::sqrt(square + y * y);
    }
}

ECHOLOOP_SIMD
void shift(const float* __restrict closing, float slowness, float sweep, int count, float* __restrict range) {
    for (int i = 0; i < count; ++i) range[i] -= closing[i] * (range[i] * slowness + sweep);
}

}  // namespace

std::optional<PingMotion> motion_of(const Shot& shot, const FanPlan& plan, const PingMoves& moves,
                                    const Effects& effects, double sound_speed) {
    PingMotion out;
    out.slowness = 1 / sound_speed;
    find_approach(moves, out);
    const bool on = effects.has(Effect::motion);
    const double flight = shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval;
    out.sweep = on ? sweep_bias(shot.frequency, shot.pulse_length, shot.bandwidth) : 0;
    const double bin_length = sound_speed / 2 * shot.bin_interval;
    out.shifts = on && out.fastest * (flight / 2 + out.sweep) > least_share * bin_length;
    if (on) out.turning = turning_that_matters(shot, plan, moves.own.turning, flight);
    const bool turns = out.turning != Vec3{};
    const double pitch = std::hypot(out.turning.x, out.turning.y) * flight;
    if (turns && (pitch > least_share * shot.fan_height || is_piston(plan.geometry)))
        out.upwards = upwards_of(plan, norm(out.turning) * flight);
    if (turns && shot.bearings.size() == 1)
        out.across = both_ways(shot.horizontal, shot.beam_width), out.axis = plan.beams.front().bearing;
    if (turns) out.upright = both_ways(shot.vertical, shot.fan_height), out.round = is_piston(plan.geometry);
    return out.shifts || turns || shot.velocities ? std::optional(std::move(out)) : std::nullopt;
}

double margin_of(const Shot& shot, const Effects& effects, double turning) {
    constexpr double most = deg_to_rad(8), widest = deg_to_rad(169);  // a wider fan has no surround
    const bool turns =
        effects.has(Effect::motion) && effects.has(Effect::beam_pattern) && effects.has(Effect::side_lobes);
    if (shot.bearings.size() < 2 || shot.rows() > 1 || !turns) return 0;
    const double flight = shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval,
                 turned = std::abs(turning) * flight;
    if (!(turned > least_share * shot.beam_width)) return 0;
    const double step = std::exp2(std::ceil(std::log2(std::max(rad_to_deg(turned), 0.5))));
    const double left = (widest - (shot.bearings.back() - shot.bearings.front()) - 4 * shot.beam_width) / 2;
    return std::max(0.0, std::min({deg_to_rad(step), most, left}));
}

double PingMotion::kept(double range) const {
    const Vec3 turned = flight(range) * rotate(axis_angle({0, 0, 1}, axis), turning);
    if (round) return kept_by_line(std::hypot(turned.y, turned.z), across);
    return kept_by_line(turned.z, across) * kept_by_line(turned.y, upright);
}

void find_closing(const PingMotion& motion, const View& view, PixelOffset offset, std::size_t line,
                  const float* surface, std::vector<float>& closing) {
    const double x = view.x(static_cast<double>(line) + 0.5 + offset.line);
    const auto square = static_cast<float>(1 + x * x), top = static_cast<float>(view.y(0.5 + offset.sample)),
               step = static_cast<float>(view.sample_height());
    const Vec3 level = rotate(view.fan_from_view(), {1, -x, 0}), up = rotate(view.fan_from_view(), {0, 0, 1});
    closing.resize(view.samples);
    if (motion.approach.size() == 1) {
        const Vec3 v = motion.approach.front();
        closing_of_row(static_cast<float>(dot(v, level)), static_cast<float>(dot(v, up)), square, top, step,
                       static_cast<int>(view.samples), closing.data());
        return;
    }
    for (std::size_t i = 0; i < view.samples; ++i) {
        if (surface[i] == 0) continue;
        const double y = view.y(static_cast<double>(i) + 0.5 + offset.sample);
        const auto number = static_cast<std::size_t>(surface[i]) - 1;
        const Vec3 v = number < motion.approach.size() ? motion.approach[number] : motion.own;  // the water's
        closing[i] = static_cast<float>((dot(v, level) + y * dot(v, up)) / std::sqrt(1 + x * x + y * y));
    }
}

void shift_ranges(const PingMotion& motion, std::span<const float> closing, std::vector<float>& ranges) {
    shift(closing.data(), static_cast<float>(motion.slowness), static_cast<float>(motion.sweep),
          static_cast<int>(ranges.size()), ranges.data());
}

void weigh_turned(const FanPlan& plan, const PingMotion& motion, const View& view, PixelOffset offset,
                  std::size_t line, const float* range, const float* surface, const float* weight,
                  std::vector<float>& out) {
    constexpr float least = 1e-4F;  // beside nulls, the pattern in `weight` is a pixel's mean
    const double axis = plan.beams.size() == 1 ? plan.beams.front().bearing : 0;
    const double x = view.x(static_cast<double>(line) + 0.5 + offset.line), turn = view.bearing - axis;
    const auto aside = static_cast<float>(std::sin(turn) + x * std::cos(turn)),
               ahead = static_cast<float>(std::cos(turn) - x * std::sin(turn)),
               square = static_cast<float>(1 + x * x), top = static_cast<float>(view.y(0.5 + offset.sample)),
               step = static_cast<float>(view.sample_height());
    const Vec3 per_range = 2 * motion.slowness * rotate(axis_angle({0, 0, 1}, axis), motion.turning);
    const auto wx = static_cast<float>(per_range.x), wy = static_cast<float>(per_range.y),
               wz = static_cast<float>(per_range.z);
    const bool piston = is_piston(plan.geometry), both = plan.geometry.horizontal.ways == 2;
    const LobeTable& upwards = motion.upwards;
    out.resize(view.samples);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const float y = top - static_cast<float>(i) * step, one = 1 / std::sqrt(square + y * y);
        // Seen from a receiver that has turned by w, what was at d is at d - w x d.
        const float s = aside * one, u = y * one, a = ahead * one, r = surface[i] != 0 ? range[i] : 0.0F;
        const float s2 = s + r * (wz * a - wx * u), u2 = u + r * (wx * s + wy * a);
        float value = weight[i];
        if (!plan.beside.empty())
            value *= both ? std::sqrt(plan.beside.at(s) * plan.beside.at(s2)) : plan.beside.at(s2);
        if (!upwards.empty()) {
            const float before = piston ? std::sqrt(s * s + u * u) : u,
                        after = piston ? std::sqrt(s2 * s2 + u2 * u2) : u2;
            value *= std::sqrt(upwards.at(after) / std::max(upwards.at(before), least));
        }
        out[i] = value;
    }
}

}  // namespace echoloop
