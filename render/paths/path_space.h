// Where paths run: the scene's triangles and the water's surface, with what each reflects and scatters. Knows
// no sonar.
#pragma once

#include <memory>
#include <optional>

#include "render/paths/paths.h"
#include "render/paths/ray_scene.h"

namespace echoloop {

/// Mirror image of a point in the plane through `on` with the unit normal `normal`.
inline Vec3 mirrored(Vec3 point, Vec3 on, Vec3 normal) {
    return point - 2 * dot(point - on, normal) * normal;
}

/// Amplitude that a surface of rms height `roughness` leaves of a mirrored wave: exp(-2 (k s sin g)^2),
/// Rayleigh's parameter (Brekhovskikh & Lysanov, Fundamentals of Ocean Acoustics, 2003, section 9.2).
/// `wavenumber` in rad/m.
double coherent_loss(double wavenumber, double roughness, double sine_of_grazing);

/// A point where a ray meets a surface.
struct Encounter {
    Vec3 point, normal;     ///< the normal towards where the ray came from
    double range = 0;       ///< m, along the ray
    double reflection = 0;  ///< amplitude of the mirrored wave at this angle of grazing, -1..1
    double mu = 0;          ///< Lambert's constant; 0 for the water's surface, which only mirrors
    double flatness =
        1;  ///< share of the mirrored amplitude that a facet smaller than its Fresnel zone keeps
    const Material* material = nullptr;  ///< none: the water's surface
};

class PathSpace {
  public:
    PathSpace(std::shared_ptr<const Scene> scene, std::optional<WaterSurface> surface);

    /// Where movers are from now on: world_from_object of every one.
    void place(std::span<const Pose> movers) { rays_.place(movers); }
    /// rad/m, of the pings to come.
    void set_wavenumber(double wavenumber) { wavenumber_ = wavenumber; }
    /// Hz, of the pings to come.
    void set_frequency(double frequency);

    /// The nearest of triangle and water's surface within `end` m; the surface is there from below only.
    std::optional<Encounter> meet(Vec3 origin, Vec3 direction, double end) const;
    /// The same for several rays, one `out` for each.
    void meet(std::span<const Ray> rays, std::span<std::optional<Encounter>> out) const;
    /// Whether a triangle is between two points.
    bool blocked(Vec3 from, Vec3 to) const { return rays_.blocked(from, to); }
    /// Empty where there is none near, or `point` is not below it.
    std::optional<WaterSurface> surface_above(Vec3 point) const;
    double surface_reflection(double sine_of_grazing) const;
    /// Amplitude that the bubbles below the surface leave of a mirrored wave.
    double bubble_loss(double sine_of_grazing) const;

  private:
    /// m along the ray to the water's surface, or its end.
    double until_surface(const Ray& ray) const;
    std::optional<Encounter> encounter(const Ray& ray, double up, const std::optional<RayHit>& hit) const;

    std::shared_ptr<const Scene> scene_;
    std::optional<WaterSurface> surface_;
    RayScene rays_;
    std::vector<double> mu_;  ///< per material
    double wavenumber_ = 0;
    double bubbles_ = 0;  ///< Np, what bubbles take from a wave that goes straight up
};

}  // namespace echoloop
