// Coarse stand-ins: what is drawn instead of many small triangles must sound as they do, leave no gaps, and
// cost little.
#include <gtest/gtest.h>

#include <random>

#include "render/fan/plan.h"
#include "render/gl/drawing_crew.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

/// Two million triangles, made once.
std::shared_ptr<const Scene> fine_seabed() {
    static const std::shared_ptr<const Scene> scene = test::scene_of({test::seabed(1000)});
    return scene;
}

Shot shallow_fan() {
    Shot shot = test::fan(120, 20, 256, 500, 50);
    shot.tilt = deg_to_rad(-20);
    return shot;
}

/// Mean levels in dB of regions of 16 beams by 50 bins that are full of seabed.
std::vector<double> levels_of_regions(const std::shared_ptr<const Scene>& scene, double pixel_density = 1,
                                      double density = 1) {
    RendererOptions options;
    options.pixel_density = pixel_density;
    options.effects = Effects::none().set(Effect::spreading);
    Renderer renderer(scene, test::water_of(1500), options);
    const std::size_t beams = 16, first_bin = 70, bins = 50;
    std::vector<double> power(256 / beams * 4);
    for (std::uint64_t ping = 0; ping < 6; ++ping) {
        Shot shot = shallow_fan();
        shot.ping = ping;
        Situation situation({0, 0, -2}, axis_angle({0, 0, 1}, 0.7 * static_cast<double>(ping)));
        situation.density = density;
        const Echogram e = renderer.render(shot, situation);
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
    const auto coarse = levels_of_regions(test::scene_of({test::seabed(500)}));
    const auto fine = levels_of_regions(fine_seabed());
    for (std::size_t region = 0; region < fine.size(); ++region)
        EXPECT_NEAR(fine[region], coarse[region], 0.2) << "region " << region;
}

// A run that does not keep up draws a quarter of the pixels: more scatter, the same mean.
TEST(Detail, FewerPixelsKeepTheLevelOfEveryRegion) {
    const auto all = levels_of_regions(fine_seabed()), fewer = levels_of_regions(fine_seabed(), 1, 0.25);
    double sum = 0;
    for (std::size_t region = 0; region < all.size(); ++region) {
        EXPECT_NEAR(fewer[region], all[region], 0.4) << "region " << region;
        sum += fewer[region] - all[region];
    }
    EXPECT_NEAR(sum / static_cast<double>(all.size()), 0, 0.1);
}

// The same scene with sixteen times as many pixels, which leave hardly anything to stand-ins; once with
// grains of 1 cm on top, that at grazing incidence are half of the echo.
TEST(Detail, StandInsKeepTheLevelOfEveryRegion) {
    for (const double grain : {0.0, 0.01}) {
        Mesh mesh = test::seabed(1000);
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
        gl::DrawingCrew coarse(make_context, test::scene_of({test::seabed(250)}), 1);
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

/// Mean levels in dB of 16 regions, each 8 beams by 25 bins of the window of a late echo, 30 to 50 m, over a
/// bumpy seabed.
std::vector<double> late_levels(Renderer& renderer, double detail) {
    std::vector<double> power(16);
    for (std::uint64_t ping = 0; ping < 16; ++ping) {
        Shot shot = test::fan(120, 20, 128, 200, 20);
        shot.tilt = deg_to_rad(-5);
        shot.first_bin_time = 2 * 30 / 1500.0;
        shot.ping = ping;
        Situation situation{{0, 0, -2}, axis_angle({0, 0, 1}, 0.7 * static_cast<double>(ping))};
        situation.detail = detail;
        const Echogram e = renderer.render(shot, situation);
        for (std::size_t beam = 0; beam < 128; ++beam)
            for (std::size_t bin = 0; bin < 200; ++bin) power[beam / 64 * 8 + bin / 25] += e.beam(beam)[bin];
    }
    for (double& p : power) p = test::db(p);
    return power;
}

// Where the bottom is seen at less than 6 degrees, over bumps that leave half of it in shadow.
TEST(Detail, KeepsTheLevelOfABackground) {
    RendererOptions options;
    options.effects.set(Effect::speckle, false).set(Effect::noise, false);
    Renderer renderer(fine_seabed(), test::water_of(1500), options);
    const auto coarse = late_levels(renderer, 0.25), fine = late_levels(renderer, 1);
    for (std::size_t i = 0; i < fine.size(); ++i) EXPECT_NEAR(coarse[i], fine[i], 1.1) << "region " << i;
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
    gl::DrawingCrew drawer(make_context, test::scene_of({test::seabed(1000), test::wall_at(12, 3, -8, 0)}),
                           1);
    const Pose pose{{0, 0, -2}, axis_angle({0, 0, 1}, 0.5)};
    const Drawn whole = draw(drawer, {}, pose, 0), background = draw(drawer, {}, pose, 30);
    EXPECT_NEAR(beyond(background).pixels / beyond(whole).pixels, 1, 0.02);
    EXPECT_NEAR(beyond(background).mean_range / beyond(whole).mean_range, 1, 0.005);
    EXPECT_LT(2 * background.profile.triangles, whole.profile.triangles);
    const Drawn nothing = draw(drawer, {}, pose, 200);
    EXPECT_EQ(nothing.profile.triangles, 0U) << "the scene ends at 85 m";
    for (const Pixel& pixel : nothing.pixels) EXPECT_EQ(pixel.surface, 0);
}

}  // namespace
}  // namespace echoloop
