// Our own rasteriser is checked against OpenGL's: it draws the same triangles at the same samples.
#include "render/raster/raster_sampler.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "render/ray_tables.h"
#include "render/renderer.h"
#include "tests/render/sampled_pictures.h"
#include "tools/echoloop/bench/scenes.h"

namespace echoloop {
namespace {

using namespace test;

using Profile = std::vector<SoundSpeedPoint>;

Pixels by_us(const std::shared_ptr<const Scene>& scene, const Shot& shot, const gl::Outlook& outlook,
             std::size_t threads = 1) {
    raster::RasterSampler sampler(scene, threads);
    return sampled(sampler, shot, outlook);
}

TEST(RasterSampler, FindsThePixelsThatOpenGlDraws) {
    const auto scene = room();
    for (const Pose& box : {Pose{{6, -2, -3}, {}}, Pose{{8, 1, -2}, axis_angle({0, 0.6, 0.8}, 1)}}) {
        const std::array movers{box};
        for (const Shot& shot : {forward_looking(), scanning()})
            for (const Vec3 place : {Vec3{0, 0, -1}, Vec3{-6, 0, -1}, Vec3{18, 0, -4.9}, Vec3{9, 4, -3.9}}) {
                const auto outlook = outlook_of(shot, {place, axis_angle({0, 0, 1}, 0.1)}, movers);
                EXPECT_GT(likeness(by_gl(scene, shot, outlook), by_us(scene, shot, outlook)), 0.999)
                    << shot.beams() << " beams at " << place.x;
            }
    }
}

/// From within a closed surface nothing shows between its triangles, whether it is seen from behind or not.
TEST(RasterSampler, LeavesNoGapsBetweenTriangles) {
    Mesh inner = sphere({0, 0, 0}, 20, 200), outer = sphere({0, 0, 0}, 40, 12);
    inner.material.double_sided = outer.material.double_sided = true;
    const auto scene = scene_of({inner, outer});
    const Shot shot = forward_looking();
    for (const double x : {-15.0, -7.3, 1.7}) {
        const auto outlook = outlook_of(shot, {{x, 2, -2}, axis_angle({0, 0.6, 0.8}, x)});
        std::size_t inside = 0;
        const Picture picture = plan_fan(geometry_of(shot, Effects{}), {});
        for (const Pixel& pixel : by_us(scene, shot, outlook)) inside += pixel.surface == 1 ? 1 : 0;
        EXPECT_EQ(inside, picture.pixels()) << x;
    }
}

TEST(RasterSampler, FindsTheSameWithAnyThreadsAndPast) {
    const auto scene = Scene::from_meshes(bench::scene_meshes("big100k"));
    const Shot shot = forward_looking();
    const auto outlook = outlook_of(shot, {{1, 2, 0}, {}});
    const Pixels alone = by_us(scene, shot, outlook);
    EXPECT_TRUE(same(by_us(scene, shot, outlook, 3), alone));
    raster::RasterSampler sampler(scene, 1);
    for (const double x : {1.3, -20.0}) sampled(sampler, shot, outlook_of(shot, {{x, 2, 0}, {}}));
    EXPECT_TRUE(same(sampled(sampler, shot, outlook), alone));
}

/// Layers, a duct, and a shadow that parts what reaches into it.
TEST(RasterSampler, BendsRaysAsOpenGlDoes) {
    const auto scene = room();
    for (const Profile& profile :
         {Profile{{0, 1515}, {3, 1515}, {13, 1485}}, Profile{{0, 1500}, {50, 900}}}) {
        RayTables tables;
        for (const Shot& shot : {forward_looking(), scanning()}) {
            auto outlook = outlook_of(shot, {{0, 0, -1}, axis_angle({0, 0, 1}, 0.1)});
            const std::array movers{Pose{{8, 1, -2}, axis_angle({0, 0.6, 0.8}, 1)}};
            outlook.movers = movers;
            outlook.rays = tables.of(profile, 8, range, true);
            outlook.rays_nearby = tables.nearby(profile, 8, range, true);
            outlook.sag = 0.02;
            EXPECT_GT(likeness(by_gl(scene, shot, outlook), by_us(scene, shot, outlook)), 0.999)
                << shot.beams() << " beams, " << profile.back().depth << " m";
        }
    }
}

/// uPa^2 by tenths of the range, mean over pings; what fluctuates is left out, and what has rays of its own.
std::array<double, 10> levels(const std::shared_ptr<const Scene>& scene, const std::string& sampler,
                              Shot shot, const Profile& profile) {
    RendererOptions options{.sampler = sampler};
    for (const Effect effect : {Effect::speckle, Effect::noise, Effect::multipath, Effect::saturation})
        options.effects.set(effect, false);
    options.surface->height = 8;
    Water water = water_of(1500);
    if (!profile.empty()) water.sound_speed.reset(), water.profile = profile;
    Renderer renderer(scene, water, options);
    std::array<double, 10> sums{};
    for (shot.ping = 0; shot.ping < 4; ++shot.ping) {
        if (shot.beams() == 1) shot.pan = 1.6 * static_cast<double>(shot.ping);
        const Echogram e = renderer.render(shot, Pose{{0.1 * static_cast<double>(shot.ping), 0, 0}, {}});
        for (std::size_t i = 0; i < e.values.size(); ++i)
            sums[10 * (i % shot.bins) / shot.bins] += static_cast<double>(e.values[i]);
    }
    return sums;
}

class NativeBenchScene : public testing::TestWithParam<const char*> {};

TEST_P(NativeBenchScene, IsHeardAsLoudAsDrawnByOpenGl) {
    const auto scene = Scene::from_meshes(bench::scene_meshes(GetParam()));
    for (const Profile& profile : {Profile{}, Profile{{0, 1520}, {6, 1518}, {14, 1490}, {40, 1490}}})
        for (const Shot& shot : {forward_looking(), scanning()}) {
            const auto drawn = levels(scene, "raster", shot, profile),
                       ours = levels(scene, "native", shot, profile);
            for (std::size_t i = 0; i < drawn.size(); ++i) {
                if (drawn[i] < 1e-3 * *std::ranges::max_element(drawn)) continue;
                EXPECT_NEAR(db(ours[i] / drawn[i]), 0, 0.02) << shot.beams() << " beams, tenth " << i;
            }
        }
}

INSTANTIATE_TEST_SUITE_P(Each, NativeBenchScene, testing::Values("simple", "big100k", "stones", "terrain"),
                         [](const auto& one) { return std::string(one.param); });

TEST(Sampler, IsOurOwnRasteriserUnlessThereIsAGpuOrAContextIsNamed) {
    const auto scene = scene_of({floor_at(-5, 60, 4)});
    const auto what = [&](const char* sampler, const char* context) {
        return Renderer(scene, water_of(1500), {.context = context, .sampler = sampler})
            .context_description();
    };
    const bool gpu = gl::may_have_gpu();
    const std::string own = "own rasteriser";
    EXPECT_TRUE(gpu || what("auto", "auto") == own);
    EXPECT_EQ(what("native", "auto"), own);
    EXPECT_NE(what("raster", "auto"), own);
    EXPECT_NE(what("auto", "egl-surfaceless"), own) << "who names a context wants it";
    EXPECT_TRUE(what("rays", "auto").starts_with("Embree"));
    EXPECT_THROW(what("embree", "auto"), std::invalid_argument);

    for (const Profile& profile : {Profile{}, Profile{{0, 1520}, {9, 1520}, {11, 1500}, {40, 1500}}})
        for (const Shot& shot : {forward_looking(), scanning()}) {
            const auto bytes = [&](const char* sampler) {
                Water water;
                water.profile = profile;
                RendererOptions options{.sampler = sampler};
                options.surface->height = 8;
                return Renderer(scene, water, options).render(shot, Pose{}).values;
            };
            EXPECT_TRUE(gpu || bytes("auto") == bytes("native"));
            EXPECT_NE(bytes("native"), bytes("rays"));
        }
}

}  // namespace
}  // namespace echoloop
