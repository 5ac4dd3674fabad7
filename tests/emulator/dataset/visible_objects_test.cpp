// Which objects the main lobes of a ping see, and how much of each, against angles known by construction.
#include <gtest/gtest.h>

#include "render/fan/visible_objects.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using namespace test;

/// A wall 10 m ahead, and a box in the middle, 0.4 m wide and taller than a fan, whose face is 5 m ahead.
VisibleObjects wall_and_box() {
    return VisibleObjects(scene_of({wall_at(10, 30, -20, 20), box("box", {5.1, 0, 0}, {0.2, 0.4, 30})}));
}

const ObjectInView* find(const Look& look, std::uint32_t object) {
    for (const ObjectInView& one : look.objects)
        if (one.object == object) return &one;
    return nullptr;
}

TEST(VisibleObjects, MeasuresWhatIsHiddenAsSolidAngle) {
    const Shot shot = fan(60, 10, 60, 100, 20);
    const Look look = wall_and_box().look(shot, {}, {}, 20, 0);
    const ObjectInView *wall = find(look, 0), *in_front = find(look, 1);
    ASSERT_TRUE(wall != nullptr && in_front != nullptr);
    EXPECT_DOUBLE_EQ(in_front->seen, in_front->whole) << "nothing is before it";
    const double height = 2 * std::sin(shot.fan_height), width = 2 * std::atan(0.2 / 5);
    EXPECT_NEAR(in_front->whole, width * height, 0.06 * width * height);
    EXPECT_NEAR(wall->whole - wall->seen, in_front->whole, 1e-9) << "it hides just that of the wall";
}

TEST(VisibleObjects, TellsEachBeamWhatItLooksAtAndWhere) {
    const Shot shot = fan(61, 4, 60, 100, 20);
    const Look look = wall_and_box().look(shot, {}, {}, 20, 0);
    for (std::size_t beam = 0; beam < shot.beams(); ++beam) {
        const double off = std::abs(shot.bearings[beam]);
        const double lobe = shot.beam_width, edge = std::atan(0.2 / 5);
        bool box_seen = false, wall_seen = false;
        for (const BeamSight& sight : look.sights[beam]) {
            const bool is_box = sight.object == 1;
            (is_box ? box_seen : wall_seen) = true;
            EXPECT_NEAR(sight.near, is_box ? 5 : 10 / std::cos(off), is_box ? 0.2 : 0.3);
        }
        if (off > lobe + edge + 0.01 || off < edge) {
            EXPECT_EQ(box_seen, off < edge) << beam;
        }
        EXPECT_EQ(wall_seen, off + lobe > edge) << beam;
    }
}

TEST(VisibleObjects, SeesNothingBeyondTheRangeNorWhatHasMovedAway) {
    const std::vector<Mesh> meshes{wall_at(10, 30, -20, 20), box("box", {0, 0, 0}, {0.2, 0.4, 30})};
    const std::vector<std::string> movers{"box"};
    VisibleObjects eyes(Scene::from_meshes(meshes, {}, movers));
    const Shot shot = fan(60, 10, 60, 100, 20);
    const std::vector<Pose> ahead{{{5.1, 0, 0}, {}}}, behind{{{-5, 0, 0}, {}}};
    EXPECT_NE(find(eyes.look(shot, {}, ahead, 8, 0), 1), nullptr);
    EXPECT_EQ(find(eyes.look(shot, {}, ahead, 8, 0), 0), nullptr) << "the wall is at 10 m";
    EXPECT_EQ(find(eyes.look(shot, {}, behind, 8, 0), 1), nullptr);
}

}  // namespace
}  // namespace echoloop
