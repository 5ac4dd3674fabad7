// V40: patches of a seabed.
#include <cmath>
#include <cstdio>
#include <utility>

#include "render/fan/patches.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

struct PatchMoments {
    double mean_db, scintillation;  ///< the latter behind fully developed speckle
};

PatchMoments of_patches(double strength_db) {
    Material sand;
    sand.name = "sand";
    sand.patchiness = strength_db;
    constexpr int side = 600;
    double sum = 0, squares = 0;
    for (int i = 0; i < side * side; ++i) {
        const double f = Patches::factor(sand, {0.173 * (i / side), 0.131 * (i % side), -7});
        sum += f / (side * side), squares += f * f / (side * side);
    }
    return {db(sum), 2 * squares / (sum * sum)};
}

/// The same of the mean over squares of so many correlation lengths.
double over_footprint(double strength_db, double lengths) {
    const double s = strength_db / 4.343;
    const PatchNoise& noise = PatchNoise::shared();
    const auto side = static_cast<std::uint32_t>(lengths * PatchNoise::length);
    double sum = 0, squares = 0, count = 0;
    for (std::uint32_t place = 0; place < 1024; ++place, ++count) {
        const std::uint32_t x = place % 8 * 8, y = place / 8 % 8 * 8, z = place / 64 * 4;
        double mean = 0;
        for (std::uint32_t i = 0; i < side * side; ++i) {
            const std::uint32_t cell = (x + i % side) % 64 + 64 * ((y + i / side) % 64 + 64 * z);
            mean += std::exp(s * noise.at(cell) * double{PatchNoise::scale} - s * s / 2) / (side * side);
        }
        sum += mean, squares += mean * mean;
    }
    return 2 * squares * count / (sum * sum);
}

/// Level of a floor with patches of that strength over that of an even one, over 12 places.
double floor_change(double strength_db) {
    Mesh floor = floor_at(-5, 150);
    floor.material.patchiness = strength_db;
    const auto scene = scene_of({floor});
    Effects effects = only({Effect::spreading, Effect::absorption, Effect::beam_pattern});
    Renderer even(scene, water_of(1500), with(effects));
    Renderer patchy(scene, water_of(1500), with(effects.set(Effect::texture)));
    Shot shot = fan(60, 20, 120, 400, 20);
    shot.tilt = deg_to_rad(-25);
    double a = 0, b = 0;
    for (int place = 0; place < 12; ++place) {
        const Pose pose{{3.7 * place, 1.3 * place, 0}, {}};
        a += total(patchy.render(shot, pose).values), b += total(even.render(shot, pose).values);
    }
    return db(a / b);
}

}  // namespace

void check_patches(Findings& find) {
    char name[80];
    find.source("2 exp(s^2), s = dB / 4.343: a log-normal mean behind speckle");
    for (const auto& [strength, scintillation] : {std::pair(2.0, 2.47), {2.36, 2.69}, {3.0, 3.22}}) {
        const PatchMoments ours = of_patches(strength);
        std::snprintf(name, sizeof name, "scintillation at %.2f dB", strength);
        find.within(name, "", scintillation, 0.1, ours.scintillation);
        std::snprintf(name, sizeof name, "mean at %.2f dB", strength);
        find.within(name, "dB", 0, 0.1, ours.mean_db);
    }
    find.source("the same over footprints, correlation exp(-r^2 / l^2)");
    for (const auto& [lengths, scintillation] : {std::pair(1.0, 2.52), {2.0, 2.28}, {8.0, 2.01}}) {
        std::snprintf(name, sizeof name, "scintillation over %.0f correlation lengths, 2.36 dB", lengths);
        find.within(name, "", scintillation, 0.1, over_footprint(2.36, lengths));
    }
    find.source("the mean level stays", Kind::property);
    find.within("floor with patches of 2.36 dB over an even one", "dB", 0, 0.5, floor_change(2.36));
}

}  // namespace echoloop::validation
