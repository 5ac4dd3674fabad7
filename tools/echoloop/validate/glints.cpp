// V17 to V19: what smooth faces and round bodies send straight back.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr double concrete = 0.686;

/// Of `mesh` and nothing else, as a mirror that scatters next to nothing.
Mesh polished(Mesh mesh, double reflection) {
    mesh.material.reflection = reflection;
    mesh.material.roughness = 0;
    mesh.material.mu_db = -120;
    mesh.material.slope = 0.02;
    mesh.material.lobe = true;
    return mesh;
}

RendererOptions mirrors(std::initializer_list<Effect> effects) {
    RendererOptions options = with(only(effects).set(Effect::multipath));
    options.surface.reset();
    return options;
}

/// Target strength that the coherent echo from `range` m ahead tells.
double glint_strength(const Mesh& mesh, double range) {
    Renderer renderer(scene_of({mesh}), water_of(1500), mirrors({Effect::spreading, Effect::pulse}));
    const Shot shot = pencil(range + 2, 100e-6);
    const auto values = renderer.render(shot, {}).values;
    return db(peak(values)) - shot.source_level + 40 * std::log10(range);
}

/// A wall at x whose edge passes `beside` m to starboard of the axis; all of it lies beyond.
Mesh wall_beside(double x, double beside) {
    Mesh wall = wall_at(x, 10, -10, 10);
    for (Vec3& p : wall.positions) p.y -= 10 + beside;
    return wall;
}

/// Upright and open, about (x, 0).
Mesh cylinder(double x, double radius, double height, int around) {
    Mesh mesh;
    mesh.object = "pipe";
    for (int i = 0; i < around; ++i) {
        const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * (i + 1) / around;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const auto& [angle, z] : {std::pair(a, -height / 2), std::pair(b, -height / 2),
                                       std::pair(b, height / 2), std::pair(a, height / 2)})
            mesh.positions.push_back({x + radius * std::cos(angle), radius * std::sin(angle), z});
        for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + corner);
    }
    return mesh;
}

/// Target strength of all that comes back from about `range` m, as the mean over 64 pings.
double body_strength(const Mesh& mesh, double range, double width_deg, double height_deg) {
    Renderer renderer(scene_of({mesh}), water_of(1500), mirrors({Effect::spreading}));
    Shot shot = fan(width_deg, height_deg, 1, 60, 2);
    shot.first_bin_time = 2 * (range - 1) / 1500;
    const auto values = mean_values(renderer, shot, 64, {});
    return db(std::accumulate(values.begin(), values.end(), 0.0)) - shot.source_level +
           40 * std::log10(range);
}

}  // namespace

void check_plane(Findings& find) {
    find.source("the sonar's image behind a plane: TS = 20 log10(R / 2) + 20 log10 V");
    const struct {
        double range, rigid, of_concrete;
    } table[] = {{2, 0, -3.27}, {5, 7.96, 4.69}, {14, 16.90, 13.63}};
    for (const auto& row : table) {
        char name[80];
        std::snprintf(name, sizeof name, "TS of a plane at %.0f m, V 1", row.range);
        find.within(name, "dB", row.rigid, 0.2,
                    glint_strength(polished(wall_at(row.range, 20, -20, 20), 1), row.range));
        std::snprintf(name, sizeof name, "TS of a plane at %.0f m, smooth concrete", row.range);
        find.within(name, "dB", row.of_concrete, 0.2,
                    glint_strength(polished(wall_at(row.range, 20, -20, 20), concrete), row.range));
    }
}

void check_plates(Findings& find) {
    find.source("Fresnel's zones of a square plate at normal incidence, 750 kHz");
    const struct {
        double side, range, published;
    } plates[] = {{0.1, 2, 1.13}, {0.1, 10, 13.50}, {0.1, 50, 13.96}, {0.4, 50, 32.99}};
    for (const auto& row : plates) {
        char name[80];
        std::snprintf(name, sizeof name, "TS of a plate of %.1f x %.1f m at %.0f m", row.side, row.side,
                      row.range);
        const double half = row.side / 2;
        find.within(name, "dB", row.published, 0.5,
                    glint_strength(polished(wall_at(row.range, half, -half, half), 1), row.range));
    }
    find.source("a half plane, re a full one; its edge at u sqrt(lambda R) / 2 beside the foot, R 10 m");
    const double full = glint_strength(polished(wall_at(10, 20, -20, 20), 1), 10);
    const struct { double u, published; } edges[] = {{0, -6.02}, {0.5, -10.23}, {1, -13.86}, {2, -19.09}};
    for (const auto& row : edges) {
        char name[80];
        std::snprintf(name, sizeof name, "foot u = %.1f off an edge", row.u);
        const double beside = row.u * std::sqrt(1500 / 750e3 * 10) / 2;
        find.within(name, "dB", row.published, 0.5,
                    glint_strength(polished(wall_beside(10, beside), 1), 10) - full);
    }
}

void check_round_bodies(Findings& find) {
    find.source("V / 2R ((1 + R/a1)(1 + R/a2))^-1/2, R 10 m; meshes");
    find.within("smooth sphere, a 0.1 m", "dB", -26.11, 1,
                body_strength(polished(sphere({10.1, 0, 0}, 0.1, 32, -120), 1), 10, 2, 2));
    find.within("smooth sphere, a 0.5 m", "dB", -12.46, 1,
                body_strength(polished(sphere({10.5, 0, 0}, 0.5, 32, -120), 1), 10, 8, 8));
    find.within("smooth cylinder, a 0.15 m, 2 m long, broadside", "dB", -4.52, 1,
                body_strength(polished(cylinder(10.15, 0.15, 2, 64), 1), 10, 4, 20));
}

}  // namespace echoloop::validation
