#include "render/paths/path_space.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/acoustics/sea_surface.h"
#include "render/water.h"

namespace echoloop {

double coherent_loss(double wavenumber, double roughness, double sine_of_grazing) {
    const double rayleigh = wavenumber * roughness * sine_of_grazing;
    return std::exp(-2 * rayleigh * rayleigh);
}

namespace {

/// m, by how much the curved surfaces of a large scene may be off where indirect echoes meet them: a
/// ten-thousandth of the scene's size, and less than a bin is long.
double tolerance_in(const Scene& scene) {
    constexpr std::size_t large = 500'000;  // triangles
    constexpr double of_size = 1e-4, most = 0.02;
    if (scene.triangles() <= large) return 0;
    const Bounds& b = scene.bounds();
    const double size =
        std::hypot(double{b.max[0]} - b.min[0], double{b.max[1]} - b.min[1], double{b.max[2]} - b.min[2]);
    return std::min(of_size * size, most);
}

}  // namespace

PathSpace::PathSpace(std::shared_ptr<const Scene> scene, std::optional<WaterSurface> surface)
    : scene_(std::move(scene)), surface_(surface), rays_(scene_, tolerance_in(*scene_)) {
    for (const Material& material : scene_->materials()) mu_.push_back(db_to_power(material.mu_db));
}

std::optional<WaterSurface> PathSpace::surface_above(Vec3 point) const {
    return surface_ && point.z < surface_->height ? surface_ : std::nullopt;
}

double PathSpace::surface_reflection(double sine_of_grazing) const {
    return -coherent_loss(wavenumber_, surface_->roughness, sine_of_grazing) * bubble_loss(sine_of_grazing);
}

double PathSpace::bubble_loss(double sine_of_grazing) const {
    if (!(surface_->wind > 0)) return 1;
    return db_to_amplitude(-surface_bubble_loss_db(frequency_, surface_->wind, sine_of_grazing));
}

std::optional<Encounter> PathSpace::meet(Vec3 origin, Vec3 direction, double end) const {
    std::optional<Encounter> out;
    const auto surface = surface_above(origin);
    const double up = surface && direction.z > 0 ? (surface->height - origin.z) / direction.z : end;
    if (up > rays_.skin() && up < end) {
        out = Encounter{
            origin + up * direction, {0, 0, -1}, up, surface_reflection(direction.z), 0, 1, nullptr};
        end = up;
    }
    const auto hit = rays_.hit(origin, direction, end);
    if (!hit) return out;
    const Material& material = scene_->materials()[hit->material];
    const double loss = coherent_loss(wavenumber_, material.roughness, -dot(direction, hit->normal));
    // The facet's smaller side against the diameter of the first Fresnel zone: a pipe's facets mirror little.
    const double zone = 2 * std::sqrt(std::numbers::pi * hit->range / wavenumber_);
    return Encounter{origin + hit->range * direction,
                     hit->normal,
                     hit->range,
                     material.reflection * loss,
                     mu_[hit->material],
                     std::min(1.0, hit->height / zone),
                     &material};
}

}  // namespace echoloop
