#include "render/scene/seabeds.h"

#include <cmath>
#include <numbers>

#include "render/scene/materials.h"

namespace echoloop {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The generic seafloor response A exp(-i^2 / (2 B^2)) + C cos^2 i of Lamarche, Lurton, Verdier & Augustin,
/// Continental Shelf Research 31 (2011) S93, here with B = 7 deg and D = 2. Levels in dB.
Material generic_seabed(const char* name, double nadir_db, double oblique_db, const char* surface) {
    Material out;
    const SurfaceProperties properties = *surface_by_name(surface);
    out.name = name;
    out.mu_db = oblique_db;
    out.reflection = properties.reflection;
    out.roughness = properties.roughness;
    out.slope = properties.slope;
    for (const double g :
         {1.0,  2.0,  3.0,  5.0,  7.0,  10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0,
          60.0, 65.0, 68.0, 70.0, 72.0, 74.0, 76.0, 78.0, 80.0, 82.0, 84.0, 86.0, 88.0, 90.0}) {
        const double facets = std::pow(10, nadir_db / 10) * std::exp(-(90 - g) * (90 - g) / (2 * 7.0 * 7.0));
        const double oblique = std::pow(10, oblique_db / 10) * std::pow(std::sin(g * degree), 2);
        out.backscatter.push_back({g, 10 * std::log10(facets + oblique)});
    }
    return out;
}

/// Strengths at 200 kHz: C such that Sb at 45 deg is in the middle of what was measured, -36 to -37.5 dB for
/// sand and -45 to -47 dB for mud. Gravel and rock: by the impedance table, as materials.cpp does from
/// sand's. The rise at nadir, A 12 dB above C, is an own choice.
const std::vector<Material>& seabeds() {
    static const std::vector<Material> all = [] {
        const double sand = -36.75 + 3.01, mud = -46 + 3.01, sand_mu = *mu_db_by_name("sand");
        const double gravel = sand + *mu_db_by_name("gravel") - sand_mu;
        const double rock = sand + *mu_db_by_name("rock") - sand_mu;
        return std::vector<Material>{generic_seabed("sand-200khz", sand + 12, sand, "sand"),
                                     generic_seabed("mud-200khz", mud + 12, mud, "mud"),
                                     generic_seabed("gravel-200khz", gravel + 12, gravel, "gravel"),
                                     generic_seabed("rock-200khz", rock + 12, rock, "rock")};
    }();
    return all;
}

}  // namespace

const Material* seabed_by_name(std::string_view name) {
    for (const Material& seabed : seabeds())
        if (seabed.name == name) return &seabed;
    return nullptr;
}

std::vector<std::string> known_seabeds() {
    std::vector<std::string> names;
    for (const Material& seabed : seabeds()) names.push_back(seabed.name);
    return names;
}

}  // namespace echoloop
