// V20 to V22: the lobe of rough faces, and a room's wall beside its corner.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "render/acoustics/scattering.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr double wavenumber_700khz = 2 * std::numbers::pi * 700e3 / 1500;

Material rough(double reflection, double roughness, double slope, double mu_db) {
    Material material;
    material.lobe = true;
    material.reflection = reflection;
    material.roughness = roughness;
    material.slope = slope;
    material.mu_db = mu_db;
    return material;
}

/// dB: the lobe of a plane at the distance 1 re V^2 / 4, heard by a Gaussian beam of `width_deg` both ways
/// (0: alike from everywhere), as the integral of S(i) / cos i cos i dO.
double lobe_over_plane(double slope, double width_deg) {
    const Material material = rough(1, 1, slope, -120);
    const double spread = deg_to_rad(width_deg) / 2.355;
    double sum = 0;
    constexpr int steps = 20'000;
    for (int n = 0; n < steps; ++n) {
        const double i = (n + 0.5) / steps * std::numbers::pi / 2, cosine = std::cos(i),
                     tangent = std::tan(i);
        // dA / R^4 with R = 1 / cos i: 2 pi tan i sec^2 i cos^4 i di
        const double beam = width_deg > 0 ? std::exp(-tangent * tangent / (spread * spread)) : 1;
        sum += facet_lobe(material, wavenumber_700khz, cosine) * beam * 2 * std::numbers::pi * tangent *
               cosine * cosine * std::numbers::pi / 2 / steps;
    }
    return db(4 * sum);
}

/// The same as rendered: all that comes from a wall 5 m ahead within 60 x 60 deg.
double rendered_lobe(double slope) {
    Mesh wall = wall_at(5, 40, -40, 40);
    wall.material = rough(0.5, 0.01, slope, -120);
    RendererOptions options = with(only({Effect::spreading, Effect::multipath}));
    options.surface.reset();
    Renderer renderer(scene_of({wall}), water_of(1500), options);
    Shot shot = fan(60, 60, 1, 400, 12);
    return db(total(renderer.render(shot, {}).values)) - shot.source_level + 20 * std::log10(2 * 5 / 0.5);
}

/// uPa^2 of the loudest point echo within a metre of `range`.
double loudest(const std::vector<TargetEcho>& echoes, double range) {
    double power = 0;
    for (const TargetEcho& echo : echoes)
        if (std::abs(echo.range - range) < 1) power = std::max(power, echo.power);
    return power;
}

/// RL - SL of the wall that a head faces and of the edge where it meets the floor.
struct RoomEchoes {
    double wall, corner;
};
RoomEchoes room(double roughness) {
    Mesh wall = wall_at(14, 20, -4, 6), floor = floor_at(-4, 14);
    wall.material = floor.material = rough(0.686, roughness, 0.1, -21.2);
    PathTracer tracer(scene_of({wall, floor}), std::nullopt,
                      only({Effect::spreading, Effect::multipath, Effect::beam_pattern, Effect::side_lobes}));
    // 3 x 35 deg one way.
    Shot shot = fan(2.16, 25.0, 1, 500, 20);
    shot.frequency = 700e3;
    PathEchoes echoes;
    tracer.trace(shot, {}, 1500, db_to_neper(0.146), 20, echoes);
    return {db(loudest(echoes.targets, 13.5)) - shot.source_level,
            db(loudest(echoes.targets, 15.5)) - shot.source_level};
}

}  // namespace

void check_lobe(Findings& find) {
    find.source("the lobe of a plane integrates to its mirror's echo, V^2 / 4H^2");
    for (const double slope : {0.05, 0.1, 0.2, 0.4}) {
        char name[80];
        std::snprintf(name, sizeof name, "lobe over a plane, s %.2f, re V^2 / 4H^2", slope);
        find.within(name, "dB", 0, 0.3, lobe_over_plane(slope, 0));
    }
    for (const double slope : {0.05, 0.1, 0.15}) {
        char name[80];
        std::snprintf(name, sizeof name, "the same as rendered, s %.2f", slope);
        find.within(name, "dB", 0, 0.3, rendered_lobe(slope));
    }
    find.source("Gaussian beam of width b both ways: 1 / (1 + 2 s^2 / sb^2), sb = b / 2.355, s 0.1");
    const struct { double width, published; } beams[] = {{10, -6.67}, {3, -16.18}, {1, -25.62}};
    for (const auto& row : beams) {
        char name[80];
        std::snprintf(name, sizeof name, "lobe by a beam of %.0f deg, re V^2 / 4H^2", row.width);
        find.within(name, "dB", row.published, 0.3, lobe_over_plane(0.1, row.width));
    }
    find.source("Eckart 1953: exp(-(2 k h)^2), 700 kHz");
    find.within("coherent echo of a wall, h 0.1 mm re smooth", "dB", -1.49, 0.3,
                room(1e-4).wall - room(0).wall);
    find.within("coherent echo of a wall, h 0.3 mm re smooth", "dB", -13.44, 0.3,
                room(3e-4).wall - room(0).wall);
}

void check_facets(Findings& find) {
    const double angles[] = {0, 5, 10, 20, 30, 40, 60};
    const struct {
        const char* name;
        Material material;
        double published[7];
    } table[] = {
        {"concrete, h 0.3 mm, s 0.10",
         rough(0.686, 3e-4, 0.1, -21.2),
         {2.54, 0.95, -3.90, -20.14, -22.45, -23.51, -27.22}},
        {"concrete, h 1 mm, s 0.20",
         rough(0.686, 1e-3, 0.2, -21.2),
         {-3.23, -3.57, -4.62, -9.16, -17.31, -23.32, -27.22}},
    };
    find.source("(1 - e^-G) V^2 / (8 pi s^2 cos^4 i) exp(-tan^2 i / 2s^2) + mu cos^2 i, 700 kHz");
    const auto check = [&](const char* name, const Material& material, double angle, double published) {
        const StrengthTable strength(material, wavenumber_700khz);
        char what[100];
        std::snprintf(what, sizeof what, "S of %s at %.0f deg", name, angle);
        const double cosine = std::cos(deg_to_rad(angle));
        find.within(what, "dB", published, 0.3,
                    db(static_cast<double>(strength.at(static_cast<float>(cosine))) * cosine));
    };
    for (const auto& row : table)
        for (int i = 0; i < 7; ++i) check(row.name, row.material, angles[i], row.published[i]);
    const double sand_angles[] = {0, 10, 20, 30, 45, 60};
    const double sand[] = {-6.53, -9.23, -17.79, -27.61, -30.01, -33.02};
    for (int i = 0; i < 6; ++i)
        check("sand, s 0.15", rough(0.353, 0.005, 0.15, -27), sand_angles[i], sand[i]);
}

void check_room(Findings& find) {
    find.source("images of a head of 3 x 35 deg; wall 14 m ahead, floor 4 m below, concrete, a 0.146 dB/m");
    const RoomEchoes smooth = room(0), coherent = room(3e-4);
    find.within("RL - SL of the wall, smooth", "dB", -36.30, 0.5, smooth.wall);
    find.within("RL - SL of wall and floor's edge, smooth", "dB", -45.04, 0.5, smooth.corner);
    find.within("wall over edge, smooth", "dB", 8.74, 0.5, smooth.wall - smooth.corner);
    find.within("wall over edge, coherent parts at h 0.3 mm", "dB", 8.74, 0.5,
                coherent.wall - coherent.corner);
}

}  // namespace echoloop::validation
