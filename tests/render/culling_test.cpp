// Which nodes of a scene a view draws, and the coarse stand-ins among them.
#include "render/gl/culling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "render/fan/plan.h"
#include "render/ray_table.h"
#include "render/scene/clusters.h"
#include "render/scene/corner_normal.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using gl::find_visible, gl::NodeRange;

Shot shallow_fan() {
    Shot shot = test::fan(120, 20, 256, 500, 50);
    shot.tilt = deg_to_rad(-20);
    return shot;
}

// With no tolerance every chunk is drawn that reaches into the view, and none twice.
NodeRange all_of(const Scene& scene) { return {0, static_cast<std::uint32_t>(scene.nodes().size())}; }

TEST(Culling, KeepsEveryTriangleThatAViewCanSee) {
    const auto scene = test::scene_of({test::seabed(100), test::sphere({10, 2, -4}, 2, 24)});
    const Shot shot = shallow_fan();
    const FanPlan plan = plan_fan(geometry_of(shot, {}), {});
    const Pose fan = Pose{{1, 2, -2}, axis_angle({0, 0, 1}, 0.4)} * Pose{{}, sonar_from_fan(0, shot.tilt)};
    for (const View& view : plan.views) {
        std::vector<std::uint32_t> visible;
        find_visible(*scene, all_of(*scene), view, fan, {.end_range = 30}, visible);
        const std::set<std::uint32_t> chosen(visible.begin(), visible.end());
        EXPECT_EQ(chosen.size(), visible.size());
        for (std::uint32_t i = 0; i < scene->nodes().size(); ++i) {
            const SceneNode& node = scene->nodes()[i];
            if (node.next != i + 1) {
                EXPECT_FALSE(chosen.contains(i));
                continue;
            }
            bool inside = false;
            for (const SceneVertex& vertex : scene->vertices().subspan(node.first_vertex, node.vertices)) {
                const Vec3 p{vertex.position[0], vertex.position[1], vertex.position[2]};
                const Quat q = fan.orientation * view.fan_from_view();
                const Vec3 seen = rotate(conjugate(q), p - fan.position);
                const double x = -seen.y / seen.x, y = seen.z / seen.x;
                inside = inside || (seen.x > 0 && norm(seen) < 30 && x > view.left && x < view.right &&
                                    y > view.bottom && y < view.top);
            }
            EXPECT_TRUE(!inside || chosen.contains(i)) << "node " << i;
        }
    }
}

// What a bent ray shows of a small box is between the view's sides, though a straight one may not be.
TEST(Culling, KeepsABoxThatBentRaysShow) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> angle(-3.14, 3.14), high(-0.6, 0.6), share(0, 1);
    Shot shot = test::fan(40, 15, 16, 100, 60);
    const View view = plan_fan(geometry_of(shot, {}), {}).views.front();
    using Profile = std::vector<SoundSpeedPoint>;
    const Profile thermocline{{0, 1515}, {10, 1515}, {20, 1485}}, downward{{0, 1500}, {50, 1350}},
        upward{{0, 1400}, {50, 1550}};
    for (const Profile& profile : {thermocline, downward, upward}) {
        const RayTable rays(profile, 8, 60, true);
        int shown = 0, crossed = 0;
        for (int i = 0; i < 20'000; ++i) {
            const Pose fan{{100, -50, -8},
                           axis_angle({0, 0, 1}, angle(random)) * axis_angle({0, 1, 0}, high(random))};
            const gl::SeenBoxes bent(view, fan, {.end_range = 60, .rays = &rays}, {0, 0, 1}),
                straight(view, fan, {.end_range = 60}, {0, 0, 1});
            for (int k = 0; k < 20; ++k) {
                const double level = 55 * share(random), bearing = angle(random), height = 40 * high(random);
                if (height > 8) continue;
                const RayTable::Move move = rays.move(level, -height);
                const double along = (1 + static_cast<double>(move.outwards)) * level;
                const Vec3 seen = rotate(conjugate(fan.orientation * view.fan_from_view()),
                                         {along * std::cos(bearing), along * std::sin(bearing),
                                          height + static_cast<double>(move.rise)});
                const double x = -seen.y / seen.x, y = seen.z / seen.x;
                if (seen.x <= 0 || x < view.left || x > view.right || y < view.bottom || y > view.top ||
                    norm(seen) > 59)
                    continue;
                Bounds box = empty_bounds();
                for (const double side : {-0.05, 0.05})
                    grow(box, {static_cast<float>(100 + level * std::cos(bearing) + side),
                               static_cast<float>(-50 + level * std::sin(bearing) + side),
                               static_cast<float>(-8 + height + side)});
                ++shown, crossed += straight.has(box) ? 0 : 1;
                ASSERT_TRUE(bent.has(box)) << level << " m off, " << height << " m above";
            }
        }
        EXPECT_GT(shown, 1000);
        EXPECT_GT(crossed, 20) << "there must be what straight rays would cull";
    }
}

TEST(Culling, TakesACoarserStandInFromAfar) {
    const auto scene = test::scene_of({test::seabed(300)});
    const FanPlan plan = plan_fan(geometry_of(shallow_fan(), Effects::none()), {});
    std::map<double, std::size_t> triangles;
    for (const double height : {4.0, 40.0, 400.0}) {
        const Pose above{{0, 0, height - 6}, axis_angle({0, 1, 0}, deg_to_rad(90))};
        std::vector<std::uint32_t> visible;
        find_visible(*scene, all_of(*scene), plan.views.front(), above, {1000, 0, 0.005}, visible);
        for (const std::uint32_t node : visible) triangles[height] += scene->nodes()[node].indices / 3;
        for (const std::uint32_t node : visible) {
            const float error = scene->nodes()[node].error;
            EXPECT_LE(error,
                      0.005 * (height + 1) * 2.5);  // the view's corner is that much farther than its middle
        }
    }
    EXPECT_LT(triangles[400.0], scene->triangles() / 100);
}

// Also of rocks and valves, which have hardly more triangles than a chunk.
TEST(Culling, TakesACoarserStandInOfASmallObject) {
    const auto scene = test::scene_of({test::sphere({}, 1, 14)});
    const FanPlan plan = plan_fan(geometry_of(shallow_fan(), Effects::none()), {});
    std::map<double, std::size_t> triangles;
    for (const double distance : {1.5, 100.0}) {
        std::vector<std::uint32_t> visible;
        find_visible(*scene, all_of(*scene), plan.view_at(0),
                     {{0, 0, distance}, axis_angle({0, 1, 0}, deg_to_rad(90))}, {1000, 0.1, 0.005}, visible);
        for (const std::uint32_t node : visible) triangles[distance] += scene->nodes()[node].indices / 3;
    }
    EXPECT_EQ(triangles[1.5], scene->triangles());
    EXPECT_LT(triangles[100], scene->triangles() / 2);
    EXPECT_GT(triangles[100], 20U);
}

// A plane has no error at any size of the cells, and its border stays where it is.
TEST(Clusters, KeepAPlaneAndItsBorder) {
    const Mesh mesh = test::floor_at(-5, 10, 64);
    for (const double cell : {1.0, 1.25, 4.0}) {
        const Clusters clusters(mesh, test::places_of(mesh), mesh.indices, cell);
        double low = 0, high = 0;
        for (std::uint32_t i = 0; i < clusters.vertices(); ++i) {
            EXPECT_LT(clusters.error(i), 0.02);  // at the corners of the border, else 0
            EXPECT_NEAR(clusters.position(i).z, -5, 1e-6);
            EXPECT_NEAR(clusters.normals(i).mean().normal.z, 1, 1e-6);
            low = std::min(low, clusters.position(i).x);
            high = std::max(high, clusters.position(i).x);
        }
        EXPECT_NEAR(low, -10, 0.05);
        EXPECT_NEAR(high, 10, 0.05);
        EXPECT_LT(clusters.places(), cell < 4 ? 500U : 50U);
    }
}

// The error of a merged sphere is about the height of the arc over a cell, h^2 / 8 a.
TEST(Clusters, KnowHowFarTheyAreOff) {
    const double radius = 4;
    const Mesh mesh = test::sphere({0.3, 0.1, 0.2}, radius, 128);
    std::vector<std::uint32_t> indices;  // without the triangles at the poles that have no area
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        if (norm(face_normal(mesh, &mesh.indices[i])) > 0.5)
            indices.insert(indices.end(), &mesh.indices[i], &mesh.indices[i] + 3);
    const Clusters clusters(mesh, test::places_of(mesh), indices, 0.5);
    double off = 0, largest = 0, mean = 0;
    for (std::uint32_t i = 0; i < clusters.vertices(); ++i) {
        off = std::max(off, std::abs(norm(clusters.position(i) - Vec3{0.3, 0.1, 0.2}) - radius));
        largest = std::max(largest, clusters.error(i));
        mean += clusters.error(i) / static_cast<double>(clusters.vertices());
        EXPECT_GT(dot(clusters.normals(i).mean().normal, clusters.position(i) - Vec3{0.3, 0.1, 0.2}),
                  0.9 * radius);
    }
    EXPECT_LT(off, largest);
    EXPECT_NEAR(mean, 0.5 * 0.5 / 8 / radius, 0.006);
}

TEST(Clusters, TheSameMeshGivesTheSameStandIns) {
    const auto a = test::scene_of({test::seabed(100)}), b = test::scene_of({test::seabed(100)});
    ASSERT_GT(a->coarse_vertices().size(), 100U);
    ASSERT_EQ(a->coarse_vertices().size(), b->coarse_vertices().size());
    for (std::size_t i = 0; i < a->coarse_vertices().size(); ++i) {
        EXPECT_EQ(a->coarse_vertices()[i].position, b->coarse_vertices()[i].position);
        EXPECT_EQ(a->coarse_vertices()[i].surface, b->coarse_vertices()[i].surface);  // with the roughness
    }
    EXPECT_TRUE(std::ranges::equal(a->coarse_indices(), b->coarse_indices()));
}

}  // namespace
}  // namespace echoloop
