// V23 and V24: several mirrors, smooth and rough.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "render/paths/chains.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

Mesh mirror_of(Mesh mesh, double reflection, double roughness = 0, double slope = 0.1) {
    mesh.material.reflection = reflection;
    mesh.material.roughness = roughness;
    mesh.material.slope = slope;
    mesh.material.mu_db = -120, mesh.material.lobe = true;
    return mesh;
}

PathEchoes traced(const std::vector<Mesh>& meshes, std::optional<WaterSurface> surface, const Shot& shot,
                  const Pose& pose, double absorption_db, bool patterns) {
    Effects effects = only({Effect::spreading, Effect::absorption, Effect::multipath});
    if (patterns) effects.set(Effect::beam_pattern).set(Effect::side_lobes);
    PathTracer tracer(scene_of(meshes), surface, effects);
    PathEchoes echoes;
    tracer.trace(shot, pose, 1500, db_to_neper(absorption_db), 40, echoes);
    return echoes;
}

/// The loudest echo within 5 cm of a range, re the source.
double level_at_range(const PathEchoes& echoes, const Shot& shot, double range) {
    double power = 0;
    for (const TargetEcho& echo : echoes.targets)
        if (std::abs(echo.range - range) < 0.05) power = std::max(power, echo.power);
    return db(power) - shot.source_level;
}

/// m, of the coherent echo by so many mirrors that is nearest to a range.
double range_of(const PathEchoes& echoes, double range) {
    double best = 1e9;
    for (const TargetEcho& echo : echoes.targets)
        if (std::abs(echo.range - range) < std::abs(best - range)) best = echo.range;
    return best;
}

/// Between walls 2 m ahead and 4 m astern of smooth concrete.
PathEchoes channel(const Shot& shot, bool patterns) {
    Mesh astern = wall_at(4, 20, -20, 20);
    for (Vec3& p : astern.positions) p.x = -p.x, p.y = -p.y;
    return traced({mirror_of(wall_at(2, 20, -20, 20), 0.686), mirror_of(astern, 0.686)}, std::nullopt, shot,
                  {}, 0.146, patterns);
}

/// Straight down, 8.7 m above the bottom and 0.5 m below the surface, 330 kHz.
PathEchoes over_bottom(double reflection, double roughness, double beam_deg) {
    Shot shot = fan(beam_deg, beam_deg, 1, 1000, 30);
    shot.frequency = 330e3;
    const Pose down{{0, 0, -0.5}, axis_angle({0, 1, 0}, std::numbers::pi / 2)};
    return traced({mirror_of(floor_at(-9.2, 40), reflection, roughness)}, WaterSurface{0, roughness, 0.095},
                  shot, down, 0.0795, false);
}

/// dB: second bottom re first, of a rough bottom and a rough surface, by a Gaussian beam both ways.
double rough_second(double beam_deg) {
    const double spread = deg_to_rad(beam_deg) / 2.355;
    const ChainMirror once[] = {{0.5, 0.1}};
    const ChainMirror twice[] = {{8.7 / 35.8, 0.1}, {0.5, 0.095}, {27.1 / 35.8, 0.1}};
    return db(std::pow(chain_share(twice, spread).power / chain_share(once, spread).power, 2));
}

}  // namespace

void check_images(Findings& find) {
    Shot head = fan(3, 35, 1, 1000, 20);
    head.frequency = 700e3;
    const PathEchoes heard = channel(head, true);
    find.source("images in two walls of smooth concrete, 2 and 4 m away, a 0.146 dB/m, by a head");
    const struct {
        int order;
        double range, published;
    } odd[] = {{1, 2, -15.90}, {3, 8, -36.24}, {5, 14, -49.40}};
    for (const auto& row : odd) {
        char name[80];
        std::snprintf(name, sizeof name, "RL - SL of order %d", row.order);
        find.within(name, "dB", row.published, 0.5, level_at_range(heard, head, row.range));
        std::snprintf(name, sizeof name, "range of order %d", row.order);
        find.within(name, "m", row.range, 0.01, range_of(heard, row.range));
    }
    head.pan = std::numbers::pi;
    const PathEchoes astern = channel(head, true);
    find.within("RL - SL of order 1, the other wall", "dB", -22.50, 0.5, level_at_range(astern, head, 4));
    find.within("RL - SL of order 3, the other wall", "dB", -38.76, 0.5, level_at_range(astern, head, 10));
    Shot all_round = head;
    all_round.beam_width = 2 * std::numbers::pi, all_round.pan = 0;
    const PathEchoes both = channel(all_round, false);
    find.source("the same by a sonar that hears all round: each of two equal paths");
    find.within("RL - SL of order 2, one path", "dB", -29.88, 0.5, level_at_range(both, all_round, 6));
    find.within("RL - SL of order 4, one path", "dB", -44.20, 0.5, level_at_range(both, all_round, 12));
}

void check_second_bottom(Findings& find) {
    find.source("20 log10(H / (2H + D)) + 20 log10 V - 2a(H + D), H 8.7, D 0.5 m, 330 kHz, smooth");
    const auto smooth = [](double reflection) {
        const PathEchoes echoes = over_bottom(reflection, 0, 20);
        const Shot shot = fan(20, 20, 1, 1000, 30);
        return level_at_range(echoes, shot, 17.9) - level_at_range(echoes, shot, 8.7);
    };
    find.within("second bottom re first, V 0.353", "dB", -16.77, 0.5, smooth(0.353));
    find.within("second bottom re first, V 0.5", "dB", -13.75, 0.5, smooth(0.5));
    find.source(
        "1 / det(I + S (aa' + bb') / sb^2), bottom s 0.1, surface s 0.095; Monte Carlo within 0.1 dB");
    find.within("rough second re first, 20 deg", "dB", -4.51, 1, rough_second(20));
    find.within("rough second re first, 10 deg", "dB", -8.63, 1, rough_second(10));
    find.within("rough second re first, 5 deg", "dB", -13.83, 1, rough_second(5));
    find.source("the same through the search, boxes of 10 deg for the beam; smooth -16.77 dB at V 0.353");
    double second = 0;
    for (const PathEcho& echo :
         over_bottom(0.353, 0.01, 10 * 2 * std::sqrt(std::numbers::ln2) / 2.355).diffuse)
        if (std::abs(echo.near_range - 17.9F) < 0.05F) second += static_cast<double>(echo.power);
    const double first = -20 * std::log10(2 * 8.7) + 20 * std::log10(0.353) - 2 * 0.0795 * 8.7 - 6.67;
    find.within("incoherent second bottom re the first's lobe", "dB", -16.77 - 8.63, 1,
                db(second) - 200 - first);
}

}  // namespace echoloop::validation
