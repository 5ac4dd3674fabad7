// Rays through a scene that is so large that two trees hold it.
#include "render/paths/ray_scene.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/render/meshes.h"

namespace echoloop {
namespace {

TEST(RayScene, FindsEveryPartOfALargeScene) {
    const auto scene = test::scene_of({test::seabed(520)});
    ASSERT_GT(scene->triangles(), 500'000U);
    const RayScene rays(scene);
    std::mt19937 random(1);
    std::uniform_real_distribution<> within(-59, 59);
    for (int i = 0; i < 500; ++i) {
        const Vec3 above{within(random), within(random), 0};
        const auto hit = rays.hit(above, {0, 0, -1}, 100);
        ASSERT_TRUE(hit.has_value()) << above.x << " " << above.y;
        EXPECT_NEAR(hit->range, 6, 1);
        EXPECT_GT(hit->normal.z, 0.5);
        EXPECT_TRUE(rays.blocked(above, {above.x, above.y, -20}));
        EXPECT_FALSE(rays.blocked(above, {above.x, above.y, -hit->range + 0.01}));
    }
}

// A slant ray meets the bottom of both trees' boxes: the nearer hit is the answer.
TEST(RayScene, TakesTheNearerOfTwoTreesHits) {
    std::vector<Mesh> meshes{test::floor_at(-6, 60, 400), test::floor_at(-12, 60, 400)};
    for (const bool upper_first : {true, false}) {
        if (!upper_first) std::swap(meshes[0], meshes[1]);
        const auto scene = test::scene_of(meshes);
        ASSERT_GT(scene->triangles(), 500'000U);
        const auto hit = RayScene(scene).hit({0.3, 0.2, 0}, {0, 0, -1}, 100);
        ASSERT_TRUE(hit.has_value());
        EXPECT_NEAR(hit->range, 6, 1e-3);
    }
}

}  // namespace
}  // namespace echoloop
