// The records of the sensors around a 7k sonar, read by the offsets of the specification notes on survey
// records.
#include <map>

#include "tests/emulator/devices/reson7k_bench.h"

namespace echoloop::test {
namespace {

constexpr std::uint32_t position = 1003, motion = 1012, heading = 1013, attitude = 1016, sound_speed = 7610;

/// On a vessel that heads east and rolls to starboard by a sine of 5 deg and 1 rad/s, and is 2 deg bow up.
Located rolling(Time time) {
    const double roll = deg_to_rad(5) * std::sin(to_seconds(time));
    const Quat vessel = from_rpy(roll, deg_to_rad(-2), 0);
    return {time, {{10, 20, -5}, vessel * from_rpy(0, std::numbers::pi / 2, 0)}, {}};
}

std::map<std::uint32_t, std::vector<Seen>> by_type(const std::vector<Seen>& records) {
    std::map<std::uint32_t, std::vector<Seen>> out;
    for (const Seen& record : records) out[record.type()].push_back(record);
    return out;
}

TEST(Reson7kSensors, TellMotionAtFiftyHertzAndPlaceAtFive) {
    Reson sonar;
    sonar.where = rolling;
    EXPECT_EQ(sonar.answer(control(1051, {5, position, motion, heading, attitude, sound_speed})), 0U);
    auto seen = by_type(sonar.within(2s));
    EXPECT_NEAR(static_cast<double>(seen[motion].size()), 101, 1);
    EXPECT_EQ(seen[heading].size(), seen[motion].size());
    EXPECT_NEAR(static_cast<double>(seen[position].size()), 11, 1);
    EXPECT_EQ(seen[attitude].size(), 10U);
    EXPECT_EQ(seen[sound_speed].size(), 1U);
    ASSERT_FALSE(seen[motion].empty());
    for (const Seen& record : seen[motion]) {
        ASSERT_EQ(record.bytes.size(), 64U + 12 + 4);
        const double t = at<float>(record.bytes, 24);  // seconds of the frame's time; the run began at 1970
        EXPECT_NEAR(record.get<float>(0), deg_to_rad(5) * std::sin(t), 1e-5) << t;
        EXPECT_NEAR(record.get<float>(4), deg_to_rad(2), 1e-6);
    }
    EXPECT_NEAR(seen[heading].front().get<float>(0), std::numbers::pi / 2, 1e-6);
    const Seen& place = seen[position].front();
    EXPECT_EQ(place.bytes.size(), 64U + 37 + 4);
    EXPECT_NEAR(place.get<double>(8), 20 / 6335439.3, 1e-11);   // rad, north, on the meridian's radius
    EXPECT_NEAR(place.get<double>(16), 10 / 6378137.0, 1e-11);  // rad, east
    EXPECT_EQ(place.get<double>(24), -5);
    const Seen& ten = seen[attitude].front();
    ASSERT_EQ(ten.bytes.size(), 64U + 1 + 10 * 18 + 4);
    EXPECT_EQ(ten.get<std::uint8_t>(0), 10);
    EXPECT_EQ(ten.get<std::uint16_t>(1 + 9 * 18), 180);  // ms
    EXPECT_NEAR(ten.get<float>(1 + 9 * 18 + 14), std::numbers::pi / 2, 1e-6);
}

TEST(Reson7kSensors, AreForSubscribersOnly) {
    Reson sonar;
    sonar.run_to(sonar.now + 1s);
    EXPECT_TRUE(sonar.sent().empty());
    EXPECT_EQ(sonar.answer(control(1051, {1, motion})), 0U);
    auto seen = by_type(sonar.within(1s));
    EXPECT_EQ(seen.size(), 1U);
    EXPECT_NEAR(static_cast<double>(seen[motion].size()), 51, 1) << "those of before are not told afterwards";
}

TEST(Reson7kSensors, HeaveIsUp) {
    Reson sonar;
    sonar.where = [](Time time) {
        Located where = rolling({});
        where.time = time;
        where.world_from_device.position.z = -5 + (time > 1s ? 1 : 0);
        return where;
    };
    EXPECT_EQ(sonar.answer(control(1051, {1, motion})), 0U);
    auto seen = by_type(sonar.within(1100ms));
    EXPECT_NEAR(seen[motion].back().get<float>(8), 1, 0.05);
}

TEST(Reson7kSensors, SoundSpeedComesAtOnceAtAChangeAndOnRequest) {
    Reson sonar;
    EXPECT_EQ(sonar.answer(control(1051, {1, sound_speed})), 0U);
    auto seen = by_type(sonar.within(100ms));
    ASSERT_EQ(seen[sound_speed].size(), 1U);
    EXPECT_EQ(seen[sound_speed][0].get<float>(0), 1500);
    const std::uint32_t speed = f32(1480);
    sonar.say(control(7610, {speed << 16, speed >> 16, 0}));  // behind a word of flags
    seen = by_type(sonar.within(100ms));
    ASSERT_EQ(seen[sound_speed].size(), 1U);
    EXPECT_EQ(seen[sound_speed][0].get<float>(0), 1480);
    EXPECT_EQ(by_type(sonar.within(10s))[sound_speed].size(), 1U) << "every ten seconds";
    sonar.say(control(1050, {sound_speed}));
    EXPECT_EQ(by_type(records_of(sonar.sent()))[sound_speed].size(), 1U);
    EXPECT_EQ(sonar.answer(control(1050, {motion})), 0x700AU);
}

TEST(Reson7kSensors, NoneComesBetweenThePacketsOfAnother) {
    Reson sonar;
    sonar.where = rolling;
    const Address host{0x7F000001, 40000};
    EXPECT_EQ(sonar.answer(control(1051, {2, motion, 7018}), 1, host), 0U);
    sonar.run_to(sonar.now + 1s);
    auto sends = sonar.sent();
    std::ranges::stable_sort(sends, {}, &Send::not_before);
    EXPECT_GT(by_type(records_of(sends))[7018].size(),
              1U);  // which says so of a packet that is out of its row
}

}  // namespace
}  // namespace echoloop::test
