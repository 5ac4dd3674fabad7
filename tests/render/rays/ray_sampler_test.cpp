// Rays as a sampler are checked against the rasteriser: each finds the surfaces in its own way, and what is
// heard must not tell which.
#include "render/rays/ray_sampler.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "render/renderer.h"
#include "tests/render/sampled_pictures.h"
#include "tools/echoloop/bench/scenes.h"

namespace echoloop {
namespace {

using namespace test;

Pixels traced(const std::shared_ptr<const Scene>& scene, const Shot& shot, const gl::Outlook& outlook,
              std::size_t threads = 1) {
    rays::RaySampler sampler(scene, threads);
    return sampled(sampler, shot, outlook);
}

TEST(RaySampler, FindsThePixelsThatAreDrawn) {
    const auto scene = room();
    for (const Pose& box : {Pose{{6, -2, -3}, {}}, Pose{{8, 1, -2}, axis_angle({0, 0.6, 0.8}, 1)}}) {
        const std::array movers{box};
        for (const Shot& shot : {forward_looking(), scanning()}) {
            const auto outlook = outlook_of(shot, {{0, 0, -1}, axis_angle({0, 0, 1}, 0.1)}, movers);
            EXPECT_GT(likeness(by_gl(scene, shot, outlook), traced(scene, shot, outlook)), 0.995);
        }
    }
}

TEST(RaySampler, LooksThroughTheBackOfWhatHasOneSide) {
    const auto scene = room();
    const std::array movers{Pose{{6, -2, -3}, {}}};
    const Shot shot = forward_looking();
    const auto outlook =
        outlook_of(shot, {{-6, 0, -1}, {}}, movers);  // behind a wall that faces the other way
    EXPECT_GT(likeness(by_gl(scene, shot, outlook), traced(scene, shot, outlook)), 0.995);
}

TEST(RaySampler, FindsTheSameWithAnyThreadsAndPast) {
    const auto scene = Scene::from_meshes(bench::scene_meshes("big100k"));
    const Shot shot = forward_looking();
    const auto outlook = outlook_of(shot, {{1, 2, 0}, {}});
    const Pixels alone = traced(scene, shot, outlook);
    EXPECT_TRUE(same(traced(scene, shot, outlook, 3), alone));
    rays::RaySampler sampler(scene, 1);
    for (const double x : {1.3, -20.0}) sampled(sampler, shot, outlook_of(shot, {{x, 2, 0}, {}}));
    EXPECT_TRUE(same(sampled(sampler, shot, outlook), alone));
}

/// uPa^2 by tenths of the range, mean over pings; what fluctuates is left out, and what has rays of its own.
std::array<double, 10> levels(const std::shared_ptr<const Scene>& scene, const std::string& sampler,
                              Shot shot, const std::vector<SoundSpeedPoint>& profile) {
    RendererOptions options{.sampler = sampler};
    for (const Effect effect : {Effect::speckle, Effect::noise, Effect::multipath, Effect::saturation})
        options.effects.set(effect, false);
    options.surface->height = 8;
    Water water = water_of(1500);
    if (!profile.empty()) water.sound_speed.reset(), water.profile = profile;
    Renderer renderer(scene, water, options);
    std::array<double, 10> sums{};
    for (shot.ping = 0; shot.ping < 16; ++shot.ping) {
        shot.random_key = shot.ping;  // moves the samples that side lobes hear, which a sonar at rest keeps
        if (shot.beams() == 1) shot.pan = 0.39 * static_cast<double>(shot.ping);
        const Echogram e = renderer.render(shot, Pose{{0.1 * static_cast<double>(shot.ping), 0, 0}, {}});
        for (std::size_t i = 0; i < e.values.size(); ++i)
            sums[10 * (i % shot.bins) / shot.bins] += static_cast<double>(e.values[i]);
    }
    return sums;
}

class BenchScene : public testing::TestWithParam<const char*> {};

void expect_equal_levels(const std::vector<SoundSpeedPoint>& profile) {
    const auto scene = Scene::from_meshes(bench::scene_meshes(BenchScene::GetParam()));
    // What is drawn of huge triangles strays by up to two bins in the surround: here those are short.
    const bool huge = !profile.empty() && scene->triangles() < 2000;
    for (Shot shot : {forward_looking(), scanning()}) {
        if (huge) shot.bins *= 8, shot.bin_interval /= 8;
        const auto drawn = levels(scene, "raster", shot, profile),
                   traced = levels(scene, "rays", shot, profile);
        const auto sum = [](const auto& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
        EXPECT_NEAR(db(sum(traced) / sum(drawn)), 0, 0.1) << shot.beams() << " beams";
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            if (drawn[i] < 1e-3 * *std::ranges::max_element(drawn)) continue;
            EXPECT_NEAR(db(traced[i] / drawn[i]), 0, huge ? 0.15 : 0.1)
                << shot.beams() << " beams, tenth " << i;
        }
    }
}

TEST_P(BenchScene, IsHeardAsLoudByRays) { expect_equal_levels({}); }

/// Right above V35's thermocline, and in the middle of a steep one, where all rays bend.
TEST_P(BenchScene, IsHeardAsLoudByRaysThatBend) {
    for (const auto& profile : {std::vector<SoundSpeedPoint>{{0, 1515}, {10, 1515}, {20, 1485}},
                                std::vector<SoundSpeedPoint>{{0, 1520}, {6, 1518}, {14, 1490}, {40, 1490}}})
        expect_equal_levels(profile);
}

INSTANTIATE_TEST_SUITE_P(Each, BenchScene, testing::Values("simple", "big100k", "stones", "terrain"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace echoloop
