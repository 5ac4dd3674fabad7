// Pictures of what finds the surfaces in place of OpenGL, beside OpenGL's of the same scene at the same
// samples.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/fan/plan.h"
#include "render/gl/drawing_crew.h"
#include "render/gl/egl.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop::test {

using Pixels = std::vector<Pixel>;

constexpr double range = 50;  ///< m, of the pictures

inline gl::Outlook outlook_of(const Shot& shot, const Pose& pose, std::span<const Pose> movers = {}) {
    return {.world_from_fan = pose * Pose{{}, sonar_from_fan(shot.pan, shot.tilt)},
            .movers = movers,
            .end_range = range,
            .offset = {{0.2, -0.3}, {-0.1, 0.4}}};
}

inline Pixels by_gl(const std::shared_ptr<const Scene>& scene, const Shot& shot, const gl::Outlook& outlook) {
    gl::DrawingCrew crew([] { return gl::make_context("auto"); }, scene, 1);
    Pixels pixels;
    crew.draw(plan_fan(geometry_of(shot, Effects{}), {}), outlook, pixels);
    return pixels;
}

template <class Sampler>
Pixels sampled(Sampler& sampler, const Shot& shot, const gl::Outlook& outlook) {
    Pixels pixels;
    sampler.sample(plan_fan(geometry_of(shot, Effects{}), {}), outlook, pixels);
    return pixels;
}

inline bool same(const Pixels& a, const Pixels& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Pixel)) == 0;
}

inline bool alike(const Pixel& a, const Pixel& b) {
    if (a.surface != b.surface) return false;
    const float footprint = std::abs(std::abs(a.footprint) - std::abs(b.footprint));
    return std::abs(a.range - b.range) < 2e-3F && std::abs(a.cosine - b.cosine) < 2e-3F &&
           footprint < 2e-3F + 0.01F * std::abs(a.footprint);
}

/// The share of pixels in which both show the same; those beyond the range may be missing in either.
inline double likeness(const Pixels& a, const Pixels& b) {
    std::size_t compared = 0, same = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const bool near =
            (a[i].surface != 0 && a[i].range < range) || (b[i].surface != 0 && b[i].range < range);
        compared += near, same += near && alike(a[i], b[i]);
    }
    EXPECT_GT(compared, a.size() / 10);
    return static_cast<double>(same) / static_cast<double>(compared);
}

inline const std::string box_name = "box";

/// Both sides of a wall, a ball with smooth normals, and a box that moves.
inline std::shared_ptr<const Scene> room() {
    Mesh screen = wall_at(12, 2, -4, 1);
    screen.material.double_sided = true;
    const std::vector<Mesh> meshes{floor_at(-5, 60, 8),
                                   wall_at(30, 30, -5, 6),
                                   wall_at(-3, 40, -5, 6),
                                   sphere({9, 4, -3}, 1, 12),
                                   screen,
                                   box("box", {}, {1, 2, 1})};
    return Scene::from_meshes(meshes, {}, std::span(&box_name, 1));
}

}  // namespace echoloop::test
