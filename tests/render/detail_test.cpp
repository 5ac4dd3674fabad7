// Coarse stand-ins: what is drawn instead of many small triangles must sound as they do, leave no gaps, and
// cost little.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "render/fan/culling.h"
#include "render/fan/plan.h"
#include "render/gl/drawing_crew.h"
#include "render/scene/clusters.h"
#include "render/scene/corner_normal.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

/// A bumpy seabed about z = -6 m of cells x cells quads on 120 m x 120 m.
Mesh seabed(int cells) {
    const double half = 60, step = 2 * half / cells;
    const auto height = [](double x, double y) {
        return 0.25 * (std::sin(0.9 * x) * std::cos(0.7 * y) + 0.4 * std::sin(2.3 * x + 1.7 * y));
    };
    Mesh mesh;
    mesh.object = "seabed";
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column) {
            const double x = -half + column * step, y = -half + row * step, d = 1e-4;
            mesh.positions.push_back({x, y, -6 + height(x, y)});
            mesh.normals.push_back({(height(x - d, y) - height(x + d, y)) / (2 * d),
                                    (height(x, y - d) - height(x, y + d)) / (2 * d), 1});
        }
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
            const auto i = static_cast<std::uint32_t>(row * (cells + 1) + column), above = i + cells + 1;
            for (const std::uint32_t corner : {i, i + 1, above + 1, i, above + 1, above})
                mesh.indices.push_back(corner);
        }
    return mesh;
}

/// Two million triangles, made once.
std::shared_ptr<const Scene> fine_seabed() {
    static const std::shared_ptr<const Scene> scene = test::scene_of({seabed(1000)});
    return scene;
}

Shot shallow_fan() {
    Shot shot = test::fan(120, 20, 256, 500, 50);
    shot.tilt = deg_to_rad(-20);
    return shot;
}

/// Mean levels in dB of regions of 16 beams by 50 bins that are full of seabed.
std::vector<double> levels_of_regions(const std::shared_ptr<const Scene>& scene, double pixel_density = 1) {
    RendererOptions options;
    options.pixel_density = pixel_density;
    options.effects = Effects::none().set(Effect::spreading);
    Renderer renderer(scene, test::water_of(1500), options);
    const std::size_t beams = 16, first_bin = 70, bins = 50;
    std::vector<double> power(256 / beams * 4);
    for (std::uint64_t ping = 0; ping < 4; ++ping) {
        Shot shot = shallow_fan();
        shot.ping = ping;
        const Echogram e =
            renderer.render(shot, {{0, 0, -2}, axis_angle({0, 0, 1}, 0.7 * static_cast<double>(ping))});
        for (std::size_t region = 0; region < power.size(); ++region)
            for (std::size_t beam = region / 4 * beams; beam < (region / 4 + 1) * beams; ++beam)
                for (std::size_t i = 0; i < bins; ++i)
                    power[region] += e.beam(beam)[first_bin + region % 4 * bins / 2 + i];
    }
    for (double& p : power) p = test::db(p);
    return power;
}

// V16, with two million triangles against a quarter of them.
TEST(Detail, FinerMeshKeepsTheLevelOfEveryRegion) {
    const auto coarse = levels_of_regions(test::scene_of({seabed(500)}));
    const auto fine = levels_of_regions(fine_seabed());
    for (std::size_t region = 0; region < fine.size(); ++region)
        EXPECT_NEAR(fine[region], coarse[region], 0.2) << "region " << region;
}

// The same scene with sixteen times as many pixels, which leave hardly anything to stand-ins; once with
// grains of 1 cm on top, that at grazing incidence are half of the echo.
TEST(Detail, StandInsKeepTheLevelOfEveryRegion) {
    for (const double grain : {0.0, 0.01}) {
        Mesh mesh = seabed(1000);
        std::mt19937 random(5);
        if (grain > 0) mesh.normals.clear();
        for (Vec3& p : mesh.positions) p.z += std::uniform_real_distribution<>(-grain, grain)(random);
        const auto scene = test::scene_of({mesh});
        const auto few = levels_of_regions(scene, 1), many = levels_of_regions(scene, 16);
        double mean = 0;
        for (std::size_t region = 0; region < few.size(); ++region) {
            EXPECT_NEAR(few[region], many[region], 0.2) << "region " << region << ", grains of " << grain;
            mean += (few[region] - many[region]) / static_cast<double>(few.size());
        }
        EXPECT_NEAR(mean, 0, 0.05) << "grains of " << grain;
    }
}

struct Drawn {
    std::vector<Pixel> pixels;
    gl::DrawProfile profile;
};

std::unique_ptr<gl::Context> make_context() { return gl::make_context("auto"); }

Drawn draw(gl::DrawingCrew& drawer, const Effects& effects, const Pose& pose, double begin_range = 0) {
    const Shot shot = shallow_fan();
    const FanPlan plan = plan_fan(geometry_of(shot, effects), {});
    Drawn out;
    drawer.draw(plan,
                {pose * Pose{{}, sonar_from_fan(shot.pan, shot.tilt)}, {}, begin_range + 50, begin_range},
                out.pixels);
    out.profile = drawer.profile();
    return out;
}

// All that the fan sees is seabed, up to its upper corners, which look down by 20 degrees.
TEST(Detail, LeavesNoGaps) {
    gl::DrawingCrew drawer(make_context, fine_seabed(), 1);
    for (int i = 0; i < 5; ++i) {
        const Pose pose{{3.0 * i, 5.0 * i, -2},
                        axis_angle({0, 0, 1}, 0.8 * i) * axis_angle({0, 1, 0}, deg_to_rad(15))};
        const Drawn drawn = draw(drawer, Effects::none(), pose);
        std::size_t empty = 0;
        for (const Pixel& pixel : drawn.pixels) empty += pixel.surface == 0;
        EXPECT_EQ(empty, 0U);
    }
}

// Small triangles must not dominate: sixteen times as many on the same ground cost about twice as many drawn.
TEST(Detail, DrawsHardlyMoreOfAFinerMesh) {
    for (const Effects& effects : {Effects::none(), Effects{}}) {
        gl::DrawingCrew coarse(make_context, test::scene_of({seabed(250)}), 1);
        gl::DrawingCrew fine(make_context, fine_seabed(), 1);
        const Pose pose{{0, 0, -2}, {}};
        const gl::DrawProfile few = draw(coarse, effects, pose).profile,
                              many = draw(fine, effects, pose).profile;
        EXPECT_LT(many.triangles, 3 * few.triangles);
        EXPECT_GT(few.triangles, 1000U);
        EXPECT_EQ(few.pixels, many.pixels);
        EXPECT_GT(few.cull + few.draw + few.read_back, 0);
    }
}

struct Beyond {
    double pixels = 0, mean_range = 0;
};

/// Of what a drawing shows between 30 and 50 m.
Beyond beyond(const Drawn& drawn) {
    Beyond out;
    for (const Pixel& pixel : drawn.pixels)
        if (pixel.surface != 0 && pixel.range > 30 && pixel.range < 50)
            ++out.pixels, out.mean_range += static_cast<double>(pixel.range);
    out.mean_range /= out.pixels;
    return out;
}

// A late echo's window begins beyond most of what is in view: that hides as much as before, for few
// triangles.
TEST(Detail, DrawsCoarselyWhatOnlyHides) {
    gl::DrawingCrew drawer(make_context, test::scene_of({seabed(1000), test::wall_at(12, 3, -8, 0)}), 1);
    const Pose pose{{0, 0, -2}, axis_angle({0, 0, 1}, 0.5)};
    const Drawn whole = draw(drawer, {}, pose, 0), background = draw(drawer, {}, pose, 30);
    EXPECT_NEAR(beyond(background).pixels / beyond(whole).pixels, 1, 0.02);
    EXPECT_NEAR(beyond(background).mean_range / beyond(whole).mean_range, 1, 0.005);
    EXPECT_LT(2 * background.profile.triangles, whole.profile.triangles);
    const Drawn nothing = draw(drawer, {}, pose, 200);
    EXPECT_EQ(nothing.profile.triangles, 0U) << "the scene ends at 85 m";
    for (const Pixel& pixel : nothing.pixels) EXPECT_EQ(pixel.surface, 0);
}

// With no tolerance every chunk is drawn that reaches into the view, and none twice.
NodeRange all_of(const Scene& scene) { return {0, static_cast<std::uint32_t>(scene.nodes().size())}; }

TEST(Culling, KeepsEveryTriangleThatAViewCanSee) {
    const auto scene = test::scene_of({seabed(100), test::sphere({10, 2, -4}, 2, 24)});
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

TEST(Culling, TakesACoarserStandInFromAfar) {
    const auto scene = test::scene_of({seabed(300)});
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

// A plane has no error at any size of the cells, and its border stays where it is.
TEST(Clusters, KeepAPlaneAndItsBorder) {
    const Mesh mesh = test::floor_at(-5, 10, 64);
    Clusters clusters(mesh, mesh.indices, 0);
    for (const int exponent : {0, 2}) {
        if (exponent > 0) clusters = Clusters(std::move(clusters), exponent);
        double low = 0, high = 0;
        for (std::uint32_t i = 0; i < clusters.vertices(); ++i) {
            EXPECT_LT(clusters.error(i), 0.02);  // at the corners of the border, else 0
            EXPECT_NEAR(clusters.position(i).z, -5, 1e-6);
            EXPECT_NEAR(clusters.normal(i).z, 1, 1e-6);
            low = std::min(low, clusters.position(i).x);
            high = std::max(high, clusters.position(i).x);
        }
        EXPECT_NEAR(low, -10, 0.05);
        EXPECT_NEAR(high, 10, 0.05);
        EXPECT_LT(clusters.places(), exponent == 0 ? 500U : 50U);
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
    const Clusters clusters(mesh, indices, -1);
    double off = 0, largest = 0, mean = 0;
    for (std::uint32_t i = 0; i < clusters.vertices(); ++i) {
        off = std::max(off, std::abs(norm(clusters.position(i) - Vec3{0.3, 0.1, 0.2}) - radius));
        largest = std::max(largest, clusters.error(i));
        mean += clusters.error(i) / static_cast<double>(clusters.vertices());
        EXPECT_GT(dot(clusters.normal(i), clusters.position(i) - Vec3{0.3, 0.1, 0.2}), 0.9 * radius);
    }
    EXPECT_LT(off, largest);
    EXPECT_NEAR(mean, 0.5 * 0.5 / 8 / radius, 0.006);
}

TEST(Clusters, TheSameMeshGivesTheSameStandIns) {
    const auto a = test::scene_of({seabed(100)}), b = test::scene_of({seabed(100)});
    ASSERT_GT(a->coarse_vertices().size(), 100U);
    ASSERT_EQ(a->coarse_vertices().size(), b->coarse_vertices().size());
    for (std::size_t i = 0; i < a->coarse_vertices().size(); ++i) {
        EXPECT_EQ(a->coarse_vertices()[i].vertex.position, b->coarse_vertices()[i].vertex.position);
        EXPECT_EQ(a->coarse_vertices()[i].roughness, b->coarse_vertices()[i].roughness);
    }
    EXPECT_TRUE(std::ranges::equal(a->coarse_indices(), b->coarse_indices()));
}

}  // namespace
}  // namespace echoloop
