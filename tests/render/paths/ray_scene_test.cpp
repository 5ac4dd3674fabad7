// Rays through a scene that is so large that two trees hold it, or stand-ins.
#include "render/paths/ray_scene.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/render/meshes.h"
#include "tests/render/paths/gentle_seabed.h"

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

// One-sided walls, two trees, movers: sixteen rays at once meet what each meets alone.
TEST(RayScene, ManyRaysMeetWhatEachMeets) {
    for (const bool large : {false, true}) {
        std::vector<Mesh> meshes{large ? test::seabed(520) : test::floor_at(-6, 60, 10),
                                 test::wall_at(10, 20, -20, 20), test::box("crate", {4, 1, -2}, {1, 1, 1})};
        const auto scene = test::scene_of(meshes);
        const RayScene scene_rays(scene);
        std::mt19937 random(3);
        std::uniform_real_distribution<> any(-1, 1);
        std::vector<Ray> rays;
        for (int i = 0; i < 100; ++i) {
            const Vec3 direction{any(random), any(random), any(random) - 0.2};
            rays.push_back({{12 * any(random), any(random), 0}, 1 / norm(direction) * direction, 40});
        }
        std::vector<std::optional<RayHit>> hits(rays.size());
        scene_rays.hit(rays, hits);
        int met = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const auto alone = scene_rays.hit(rays[i].origin, rays[i].direction, rays[i].end);
            ASSERT_EQ(hits[i].has_value(), alone.has_value()) << i;
            if (!alone) continue;
            ++met;
            EXPECT_NEAR(hits[i]->range, alone->range, 1e-4) << i;
            EXPECT_GT(dot(hits[i]->normal, alone->normal), 1 - 1e-6) << i;
            EXPECT_EQ(hits[i]->object, alone->object) << i;
            EXPECT_NEAR(hits[i]->height, alone->height, 1e-3 * alone->height) << i;
        }
        EXPECT_GT(met, 50);
        EXPECT_LT(met, 100);
    }
}

Vec3 slanting(std::mt19937& random) {
    std::uniform_real_distribution<> level(-1, 1), down(0.1, 1);
    const Vec3 direction{level(random), level(random), -down(random)};
    return 1 / norm(direction) * direction;
}

TEST(RayScene, StandInsAreOffByTheToleranceAtMost) {
    constexpr double tolerance = 0.02;
    const auto scene = test::scene_of({test::gentle_seabed(520)});
    const RayScene exact(scene), coarse(scene, tolerance);
    std::mt19937 random(2);
    std::uniform_real_distribution<> within(-20, 20);
    int off = 0, far_off = 0, small = 0, rays = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 from{within(random), within(random), -1}, direction = slanting(random);
        const auto a = exact.hit(from, direction, 40), b = coarse.hit(from, direction, 40);
        if (!a || !b) continue;
        ++rays;
        const double across = std::abs((a->range - b->range) * dot(direction, a->normal));
        off += across > 1e-3, far_off += across > tolerance;
        // Of the mesh's own triangles: a larger one would mirror more.
        small += b->height > 0.5 * a->height && b->height < 2 * a->height;
        EXPECT_GT(dot(a->normal, b->normal), 0.9);
        const Vec3 point = from + a->range * direction;
        EXPECT_FALSE(coarse.blocked(from, point)) << "a point on the bottom itself";
    }
    EXPECT_GT(rays, 1900);
    EXPECT_GT(off, rays / 10) << "no stand-ins";
    EXPECT_LT(far_off, rays / 100) << "rays that just miss a crest";
    EXPECT_GT(small, rays * 99 / 100);
}

// What lies behind a stand-in is hidden.
TEST(RayScene, StandInsHide) {
    const auto scene = test::scene_of({test::gentle_seabed(520)});
    const RayScene coarse(scene, 0.02);
    std::mt19937 random(3);
    for (int i = 0; i < 200; ++i) {
        const Vec3 from{0, 0, -1}, direction = slanting(random);
        const auto hit = coarse.hit(from, direction, 40);
        if (!hit) continue;
        const double behind = 0.1 / -dot(direction, hit->normal);  // m, of the ray, 10 cm of its plane
        EXPECT_TRUE(coarse.blocked(from, from + (hit->range + behind) * direction));
    }
}

}  // namespace
}  // namespace echoloop
