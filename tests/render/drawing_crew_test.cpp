// Several threads that draw one picture: it is the picture of one.
#include "render/gl/drawing_crew.h"

#include <gtest/gtest.h>

#include <cstring>

#include "render/fan/plan.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"
#include "tests/render/software_contexts.h"
#include "tools/echoloop/bench/scenes.h"

namespace echoloop {
namespace {

class DrawingCrew : public test::SoftwareContext {
  protected:
    static std::vector<Pixel> draw(std::size_t threads, const std::shared_ptr<const Scene>& scene,
                                   const Shot& shot, const Pose& pose, gl::DrawProfile* profile = nullptr) {
        const FanPlan plan = plan_fan(geometry_of(shot, Effects{}), {});
        gl::DrawingCrew crew([] { return gl::make_context(GetParam()); }, scene, threads);
        std::vector<Pixel> pixels;
        for (int ping = 0; ping < 2; ++ping)
            crew.draw(
                plan,
                {pose * Pose{{}, sonar_from_fan(shot.pan, shot.tilt)}, {}, 50, 0, {{0.2, -0.3}, {-0.1, 0.4}}},
                pixels);
        if (profile != nullptr) *profile = crew.profile();
        return pixels;
    }
};

bool same(const std::vector<Pixel>& a, const std::vector<Pixel>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Pixel)) == 0;
}

TEST_P(DrawingCrew, DrawsThePictureOfOneThreadWithAnyNumber) {
    const auto scene = Scene::from_meshes(bench::scene_meshes("big100k"));
    gl::DrawProfile one, three;
    const auto alone = draw(1, scene, test::forward_looking(), {}, &one);
    std::size_t shown = 0;
    for (const Pixel& pixel : alone) shown += pixel.surface != 0;
    EXPECT_GT(shown, alone.size() / 4);
    EXPECT_TRUE(same(draw(2, scene, test::forward_looking(), {}), alone));
    EXPECT_TRUE(same(draw(3, scene, test::forward_looking(), {}, &three), alone));
    EXPECT_TRUE(same(draw(12, scene, test::forward_looking(), {}), alone)) << "more than there are views";
    EXPECT_EQ(one.triangles, three.triangles);
    EXPECT_EQ(one.pixels, three.pixels);
}

TEST_P(DrawingCrew, DrawsASmallPictureAlone) {
    const auto scene = test::scene_of({test::floor_at(-5, 60)});
    const Shot beam = test::fan(3, 35, 1, 500, 50);
    EXPECT_TRUE(same(draw(2, scene, beam, {}), draw(1, scene, beam, {})));
}

INSTANTIATE_TEST_SUITE_P(Each, DrawingCrew, test::software_contexts, test::context_test_name);

}  // namespace
}  // namespace echoloop
