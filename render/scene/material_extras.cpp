#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/scene/document_parts.h"
#include "render/scene/fault.h"
#include "render/scene/materials.h"
#include "render/scene/seabeds.h"

namespace echoloop {
namespace {

std::string joined(const std::vector<std::string>& names) {
    std::string out;
    for (const auto& name : names) out += (out.empty() ? "" : ", ") + name;
    return out;
}

double within(const JsonView& value, double least, double most, const char* limits, const char* remedy) {
    const double number = value.number();
    if (!(number >= least && number <= most))
        scene_fault(value.place(), std::string("must be within ") + limits, remedy);
    return number;
}

void read_mu_db(const JsonView& value, Material& out) {
    out.mu_db = within(value, -120, ceiling_mu_db + 0.002, "-120..-4.97 dB",
                       "a Lambert surface cannot scatter more than 1/pi");
}

void set_surface(const SurfaceProperties& surface, Material& out) {
    out.mu_db = surface.mu_db;
    out.reflection = surface.reflection;
    out.roughness = surface.roughness;
    out.slope = surface.slope;
    out.lobe = surface.lobe;
    out.patchiness = surface.patchiness;
}

void read_named(const JsonView& value, Material& out) {
    const auto surface = surface_by_name(value.text());
    if (!surface)
        scene_fault(value.place(), "\"" + value.text().substr(0, 64) + "\" is not a known material",
                    "use one of " + joined(known_materials()) + ", or give mu_db");
    set_surface(*surface, out);
}

void read_seabed(const JsonView& value, Material& out) {
    const Material* seabed = seabed_by_name(value.text());
    if (!seabed)
        scene_fault(value.place(), "\"" + value.text().substr(0, 64) + "\" is not a known seabed",
                    "use one of " + joined(known_seabeds()) + ", or give backscatter_db");
    out.mu_db = seabed->mu_db;
    out.backscatter = seabed->backscatter;
    out.reflection = seabed->reflection;
    out.roughness = seabed->roughness;
    out.slope = seabed->slope;
    out.patchiness = surface_by_name(value.text()).value_or(SurfaceProperties{}).patchiness;
}

void read_curve(const JsonView& value, Material& out) {
    constexpr const char* example = "write for example [[1, -60], [45, -30], [90, -12]]";
    out.backscatter.clear();
    for (const JsonView& pair : value.elements(1000)) {
        if (!pair.value().is_array() || pair.value().size() != 2)
            scene_fault(pair.place(), "must be a grazing angle in degrees and a strength in dB", example);
        const auto numbers = pair.elements(2);
        const BackscatterPoint point{within(numbers[0], 0, 90, "0..90 deg", example),
                                     within(numbers[1], -120, 20, "-120..20 dB", example)};
        if (!out.backscatter.empty() && !(point.grazing_deg > out.backscatter.back().grazing_deg))
            scene_fault(numbers[0].place(), "must be more than the angle before it",
                        "sort the points by grazing angle and give each angle once");
        out.backscatter.push_back(point);
    }
    if (out.backscatter.empty()) scene_fault(value.place(), "has no points", example);
}

void read_reflection(const JsonView& value, Material& out) {
    out.reflection =
        within(value, -1, 1, "-1..1", "give the amplitude of the echo of a mirror, for example 0.35");
}

void read_roughness(const JsonView& value, Material& out) {
    out.roughness = within(value, 0, 10, "0..10 m", "give the rms height in metres, for example 0.005");
}

void read_slope(const JsonView& value, Material& out) {
    out.slope = within(value, 0, 1, "0..1", "give the rms slope of the surface's facets, for example 0.15");
    out.lobe = true;
}

void read_patchiness(const JsonView& value, Material& out) {
    out.patchiness =
        within(value, 0, 6, "0..6 dB", "give the standard deviation of its patches, for example 2");
}

/// What both keys say together; where only one is given, the scene gives way to it.
void check_energy(const JsonView& sonar, const Material& material) {
    if (!sonar.find("mu_db") || !sonar.find("reflection")) return;
    const double power =
        material.reflection * material.reflection + std::numbers::pi * std::pow(10, material.mu_db / 10);
    if (power > 1.005)
        scene_fault(sonar.place(), "sends back more than it receives: reflection^2 + pi mu is above 1",
                    "lower reflection or mu_db");
}

struct Key {
    const char* name;
    void (*read)(const JsonView& value, Material& out);
};

/// In this order, so that what is more particular wins.
constexpr std::array<Key, 8> material_keys{{{"material", read_named},
                                            {"mu_db", read_mu_db},
                                            {"seabed", read_seabed},
                                            {"backscatter_db", read_curve},
                                            {"reflection", read_reflection},
                                            {"roughness", read_roughness},
                                            {"slope", read_slope},
                                            {"patchiness_db", read_patchiness}}};

void check_material_keys(const JsonView& sonar) {
    if (!sonar.value().is_object())
        scene_fault(sonar.place(), "must be an object", "write for example {\"mu_db\": -27}");
    std::vector<std::string> known;
    for (const Key& key : material_keys) known.emplace_back(key.name);
    for (const auto& [key, value] : sonar.value().items()) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        const std::string near = nearest_of(key, known);
        scene_fault(sonar.place() + "." + key.substr(0, 64), "is not a known key",
                    near.empty() ? "known keys are " + joined(known) : "did you mean " + near + "?");
    }
}

}  // namespace

Material read_material(const JsonView& material) {
    Material out;
    if (const auto name = material.find("name")) out.name = name->text().substr(0, 256);
    if (const auto sided = material.find("doubleSided")) out.double_sided = sided->boolean();
    const auto surface = surface_by_name(out.name);
    set_surface(surface.value_or(*surface_by_name("sand")), out);
    if (!surface) out.patchiness = 0;  // nobody knows what it is
    const auto extras = material.find("extras");
    if (!extras || !extras->value().is_object()) return out;
    const auto sonar = extras->find("sonar");
    if (!sonar) return out;
    check_material_keys(*sonar);
    for (const Key& key : material_keys)
        if (const auto value = sonar->find(key.name)) key.read(*value, out);
    check_energy(*sonar, out);
    return out;
}

}  // namespace echoloop
