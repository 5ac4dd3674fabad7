// Scenes and measurements that the tests of paths share.
#pragma once

#include <cmath>

#include "render/paths/paths.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop::test {

inline constexpr double sound = 1500;  ///< m/s

/// A mirror, but for `roughness`; it scatters next to nothing.
inline Mesh smooth(Mesh mesh, double reflection, double roughness = 0, double mu_db = -120) {
    mesh.material.reflection = reflection;
    mesh.material.roughness = roughness;
    mesh.material.mu_db = mu_db;
    return mesh;
}

/// A Lambert surface that mirrors nothing.
inline Mesh dull(Mesh mesh, double mu_db = -20) { return smooth(std::move(mesh), 0, 0, mu_db); }

inline Effects without(std::initializer_list<Effect> off) {
    Effects effects;
    for (const Effect effect : off) effects.set(effect, false);
    return effects;
}

inline PathEchoes trace(const std::shared_ptr<const Scene>& scene, std::optional<WaterSurface> surface,
                        Effects effects, const Shot& shot, const Pose& pose, double absorption = 0,
                        double end_range = 50) {
    PathTracer tracer(scene, surface, effects);
    PathEchoes echoes;
    tracer.trace(shot, pose, sound, absorption, end_range, echoes);
    return echoes;
}

/// One horizontal beam, wide and high.
inline Shot wide_beam(double width_deg = 60, double height_deg = 100) {
    return fan(width_deg, height_deg, 1, 500, 50);
}

}  // namespace echoloop::test
