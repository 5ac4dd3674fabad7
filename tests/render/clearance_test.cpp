// How high a place is over a floor, beside it and under a roof.
#include <gtest/gtest.h>

#include "render/scene/clearance.h"
#include "tests/render/meshes.h"

namespace echoloop::test {
namespace {

TEST(Clearance, IsTheWayStraightDownToWhatFacesUp) {
    const auto scene = scene_of({floor_at(-20, 50), floor_at(-12, 2)});
    EXPECT_NEAR(*clearance_below(*scene, {10, 5, -4}), 16, 1e-5) << "the floor";
    EXPECT_NEAR(*clearance_below(*scene, {0.5, -0.7, -4}), 8, 1e-5) << "what stands on it";
    EXPECT_NEAR(*clearance_below(*scene, {0.5, -0.7, -13}), 7, 1e-5)
        << "from below that, which faces up only";
    EXPECT_FALSE(clearance_below(*scene, {200, 0, -4})) << "beside the floor";
    EXPECT_FALSE(clearance_below(*scene, {0, 0, -21})) << "below everything";
}

}  // namespace
}  // namespace echoloop::test
