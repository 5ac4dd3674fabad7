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

PathSpace::PathSpace(std::shared_ptr<const Scene> scene, std::optional<WaterSurface> surface)
    : scene_(std::move(scene)), surface_(surface), rays_(scene_) {
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
