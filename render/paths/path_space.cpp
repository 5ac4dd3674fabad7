#include "render/paths/path_space.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/acoustics/sea_surface.h"
#include "render/water.h"

namespace echoloop {

double coherent_loss(double wavenumber, double roughness, double sine_of_grazing) {
    if (roughness == 0) return 1;
    const double rayleigh = wavenumber * roughness * sine_of_grazing;
    return std::exp(-2 * rayleigh * rayleigh);
}

namespace {

/// m, by how much the curved surfaces of a large scene may be off where indirect echoes meet them, in the
/// root mean square by a third of that. Fewer triangles stay in the processor's caches, and what a ray costs
/// there is waiting for memory, by our reading of the times; with 5 cm the nearest bottom's indirect echoes
/// are 0.3 dB off.
double tolerance_in(const Scene& scene) {
    constexpr std::size_t large = 500'000;  // triangles
    constexpr double of_size = 2e-4, most = 0.035;
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

void PathSpace::set_frequency(double frequency) {
    bubbles_ = surface_ ? db_to_neper(surface_bubble_loss_db(frequency, surface_->wind, 1)) : 0;
}

double PathSpace::bubble_loss(double sine_of_grazing) const {
    return bubbles_ > 0 ? std::exp(-bubbles_ / std::max(sine_of_grazing, least_bubble_sine)) : 1;
}

double PathSpace::until_surface(const Ray& ray) const {
    const auto surface = surface_above(ray.origin);
    if (!surface || !(ray.direction.z > 0)) return ray.end;
    const double up = (surface->height - ray.origin.z) / ray.direction.z;
    return up > rays_.skin() ? std::min(up, ray.end) : ray.end;
}

std::optional<Encounter> PathSpace::encounter(const Ray& ray, double up,
                                              const std::optional<RayHit>& hit) const {
    if (!hit) {
        if (!(up < ray.end)) return std::nullopt;
        return Encounter{ray.origin + up * ray.direction,
                         {0, 0, -1},
                         up,
                         surface_reflection(ray.direction.z),
                         0,
                         1,
                         nullptr};
    }
    const Material& material = scene_->materials()[hit->material];
    const double loss = coherent_loss(wavenumber_, material.roughness, -dot(ray.direction, hit->normal));
    // The facet's smaller side against the diameter of the first Fresnel zone: a pipe's facets mirror little.
    const double zone = 2 * std::sqrt(std::numbers::pi * hit->range / wavenumber_);
    return Encounter{ray.origin + hit->range * ray.direction,
                     hit->normal,
                     hit->range,
                     material.reflection * loss,
                     mu_[hit->material],
                     std::min(1.0, hit->height / zone),
                     &material};
}

std::optional<Encounter> PathSpace::meet(Vec3 origin, Vec3 direction, double end) const {
    const Ray ray{origin, direction, end};
    const double up = until_surface(ray);
    return encounter(ray, up, rays_.hit(origin, direction, up));
}

void PathSpace::meet(std::span<const Ray> rays, std::span<std::optional<Encounter>> out) const {
    static thread_local std::vector<Ray> cut;
    static thread_local std::vector<std::optional<RayHit>> hits;
    cut.assign(rays.begin(), rays.end());
    for (Ray& ray : cut) ray.end = until_surface(ray);
    hits.resize(rays.size());
    rays_.hit(cut, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) out[i] = encounter(rays[i], cut[i].end, hits[i]);
}

}  // namespace echoloop
