// What a recording says of a ping's place is read back as it was.
#include <gtest/gtest.h>

#include "emulator/truth/remark.h"

namespace echoloop {
namespace {

Transmission ping() {
    Transmission t;
    t.time = from_seconds(12.5);
    t.world_from_sonar = {{1.25, -3.5, -20}, axis_angle({0, 0, 1}, 0.5)};
    return t;
}

TEST(Remark, IsReadBackAsItWas) {
    const Surroundings around{.place = GeoPlace{59.400012345, 10.500067891, 0}, .altitude = 4.02};
    // Other remarks stand in lines of their own.
    const auto remark = read_remark("fault 3: bit flip\n" + remark_of(ping(), 7, around) + "\nfault 4: loss");
    ASSERT_TRUE(remark);
    EXPECT_EQ(remark->time, 12.5);
    EXPECT_EQ(remark->world_from_sonar.position, (Vec3{1.25, -3.5, -20}));
    EXPECT_NEAR(remark->world_from_sonar.orientation.z, std::sin(0.25), 1e-5);
    ASSERT_TRUE(remark->around.place && remark->around.altitude);
    EXPECT_NEAR(remark->around.place->latitude, 59.400012345, 1e-9);
    EXPECT_NEAR(remark->around.place->longitude, 10.500067891, 1e-9);
    EXPECT_NEAR(*remark->around.altitude, 4.02, 1e-9);
}

TEST(Remark, SaysNothingOfWhatIsNotKnown) {
    const auto text = remark_of(ping(), 7);
    EXPECT_EQ(text,
              "ping 7: t 12.500000 s, sonar at 1.250 -3.500 -20.000 m, orientation w 0.96891 x 0.00000 y "
              "0.00000 z 0.24740");
    const auto remark = read_remark(text);
    ASSERT_TRUE(remark);
    EXPECT_FALSE(remark->around.place || remark->around.altitude);
}

TEST(Remark, OtherCommentsAreNone) {
    for (const char* text : {"", "ping", "ping 7", "fault 3: bit flip", "ping 7: t 1 s, sonar at 1 2 m"})
        EXPECT_FALSE(read_remark(text)) << text;
}

}  // namespace
}  // namespace echoloop
