// What a Surveyor 240-16 says beside its points: attitude, time of day, sensors in the water, and to whom.
#include <map>

#include "tests/emulator/devices/surveyor240_bench.h"

namespace echoloop::test {
namespace {

using testing::ElementsAre;
using testing::FloatNear;

/// Delivers the echogram of the pending ping as if the head hung so: a mount that looks down on a vehicle of
/// this attitude (rad; body forward-left-up), at this depth.
std::vector<Send> hear(Bench& bench, double roll, double pitch, double yaw = 0, double depth = 0) {
    Echogram echogram = echo_of(bench.ping->shot, 0, 0);
    echogram.world_from_sonar = {{3, 4, -depth}, from_rpy(roll, pitch, yaw) * from_rpy(0, deg_to_rad(90), 0)};
    bench.now = std::max(bench.now, bench.ping->due);
    bench.ping.reset();
    return bench.device().heard(echogram, bench.now).send;
}

std::vector<float> up_vector(const Bytes& report) {
    return {f32(report, 8), f32(report, 12), f32(report, 16)};
}

std::vector<float> asked_up_vector(Bench& bench) {
    bench.sent();
    bench.say(frame(attitude_report));
    return up_vector(of_id(bench.sent(), attitude_report).at(0).bytes);
}

TEST(Surveyor240Attitude, IsLevelUntilThePoseIsKnownAndThenThatOfTheLastLook) {
    Bench bench = surveyor();
    EXPECT_THAT(asked_up_vector(bench),
                ElementsAre(FloatNear(0, 1e-6F), FloatNear(0, 1e-6F), FloatNear(1, 1e-6F)));
    hear(bench, 0, deg_to_rad(-20), 1.0);  // in a forward-left-up body a negative pitch raises the bow
    const auto up = asked_up_vector(bench);
    EXPECT_NEAR(std::asin(up[0]), deg_to_rad(20), 1e-6) << "ping-python: asin(x), positive with the bow up";
    EXPECT_NEAR(up[1], 0, 1e-6);
    EXPECT_NEAR(up[2], std::cos(deg_to_rad(20)), 1e-6);
}

TEST(Surveyor240Attitude, RollIsPositiveWithPortUp) {
    Bench bench = surveyor();
    hear(bench, deg_to_rad(15), 0, 2.5);  // a positive roll about the forward axis raises the port side
    const auto up = asked_up_vector(bench);
    EXPECT_NEAR(std::atan2(up[1], up[2]), deg_to_rad(15), 1e-6);
}

TEST(Surveyor240Attitude, TheSignOfPitchIsAnOption) {
    Bench bench = surveyor({{"pitch_sign", std::string("bow-down")}});
    hear(bench, 0, deg_to_rad(-20));
    EXPECT_NEAR(std::asin(-asked_up_vector(bench)[0]), deg_to_rad(20), 1e-6);
}

TEST(Surveyor240Attitude, IsReportedTenTimesASecondToEveryHostThatHasSpoken) {
    Bench bench = surveyor();
    bench.run_to(2s);
    EXPECT_TRUE(bench.sent().empty()) << "nobody is there";
    bench.say(frame(6, "0500"), udp, host);
    bench.run_to(3s + 60ms);
    auto reports = of_id(bench.sent(), attitude_report);
    EXPECT_EQ(reports.size(), 10U);
    for (const Send& report : reports) EXPECT_EQ(report.to, host);
    EXPECT_EQ(u32(reports.back().bytes, 40), 3000U) << "ms of the look";
    bench.say(frame(6, "0500"), tcp);
    bench.sent();
    bench.run_to(4s + 60ms);
    reports = of_id(bench.sent(), attitude_report);
    EXPECT_EQ(reports.size(), 20U);
    for (const Shot& shot : bench.shots) {
        EXPECT_EQ(shot.bearings.size(), 1U);
        EXPECT_LT(shot.source_level, -200) << "a look sends nothing into the water";
    }
}

TEST(Surveyor240Attitude, ALookThatComesLateIsToldWithItsOwnTime) {
    Bench bench = surveyor();
    bench.say(frame(6, "0500"));
    bench.run_to(1s + 100ms);  // a look has just begun
    bench.ping->due = 1s + 320ms;
    bench.sent();
    bench.run_to(1s + 330ms);
    const auto reports = of_id(bench.sent(), attitude_report);
    ASSERT_EQ(reports.size(), 1U);
    EXPECT_EQ(u32(reports[0].bytes, 40), 1100U);
    bench.run_to(2s + 60ms);
    EXPECT_EQ(u32(of_id(bench.sent(), attitude_report).back().bytes, 40), 2000U) << "then it goes on";
}

TEST(Surveyor240Attitude, WhilePingingItIsThatOfTheLastPing) {
    Bench bench = surveyor();
    Set set;
    set.yz = true;
    bench.say(frame(set));
    bench.run_to(bench.now);
    const auto sent = hear(bench, 0, deg_to_rad(-10));
    EXPECT_NEAR(f32(of_id(sent, yz_points).at(0).bytes, 20), std::sin(deg_to_rad(10)), 1e-6)
        << "up_vec of the points";
    EXPECT_NEAR(asked_up_vector(bench)[0], std::sin(deg_to_rad(10)), 1e-6);
}

TEST(Surveyor240Attitude, BetweenRarePingsItIsLookedAt) {
    Bench bench = surveyor();
    Set rare;
    rare.period = 1000;
    bench.say(frame(rare));
    bench.run_to(5s + 60ms);
    std::vector<std::uint32_t> times;
    for (const Send& report : of_id(bench.sent(), attitude_report)) times.push_back(u32(report.bytes, 40));
    EXPECT_GE(times.size(), 45U);
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
    times.erase(std::unique(times.begin(), times.end()), times.end());
    EXPECT_GE(times.size(), 40U);
    EXPECT_EQ(bench.device().counters().pings, 6U);
}

TEST(Surveyor240Attitude, IsNotReportedBeforeItIsKnown) {
    Bench bench = surveyor();
    bench.ping->due = 10s;  // a renderer that is slow to start
    bench.say(frame(6, "0500"));
    for (int i = 0; i < 20; ++i) {
        bench.run_to(bench.wake);
        bench.ping.reset();
    }
    EXPECT_TRUE(of_id(bench.sent(), attitude_report).empty());
}

TEST(Surveyor240Attitude, CanBeLeftToRequests) {
    Bench bench = surveyor({{"attitude_period", 0.0}});
    bench.say(frame(6, "0500"));
    bench.run_to(5s);
    EXPECT_TRUE(of_id(bench.sent(), attitude_report).empty());
}

TEST(Surveyor240Time, IsAskedForAndThenTold) {
    Bench bench = surveyor();
    bench.run_to(1s);
    EXPECT_TRUE(bench.sent().empty());
    bench.say(frame(6, "0500"));
    bench.run_to(1s);
    const auto asked = of_id(bench.sent(), utc_request);
    ASSERT_EQ(asked.size(), 1U);
    EXPECT_EQ(to_hex(asked[0].bytes),
              "425200000e000000"
              "a200");
    bench.say(frame(attitude_report));
    EXPECT_EQ(number_at(bench.sent().at(0).bytes, 32, 8), 0U) << "not known yet";
    bench.say(frame(15, le(1700000000000, 8) + le(2500, 4)));
    bench.say(frame(Set{}));
    bench.run_to(1s + 50ms);
    const auto points = of_id(bench.sent(), atof_points);
    EXPECT_EQ(number_at(points.at(0).bytes, 12, 8), 1700000000000U);
    bench.run_to(10s + 999ms);
    EXPECT_TRUE(of_id(bench.sent(), utc_request).empty());
    bench.run_to(11s + 50ms);
    const auto sent = bench.sent();
    EXPECT_EQ(of_id(sent, utc_request).size(), 1U) << "again after ten seconds";
    const Bytes last = of_id(sent, atof_points).back().bytes;
    EXPECT_EQ(number_at(last, 12, 8) - 1700000000000U, u32(last, 8) - 1000U);
}

TEST(Surveyor240Water, HasNoSensorsUnlessTheOptionsSaySo) {
    Bench bench = surveyor();
    bench.say(frame(6, le(water_stats, 2)));
    const Bytes none = bench.sent().at(0).bytes;
    EXPECT_EQ(f32(none, 8), -1000);
    EXPECT_EQ(f32(none, 12), -1000);
    bench.run_to(3s);
    EXPECT_TRUE(of_id(bench.sent(), water_stats).empty());
    Bench with = surveyor({{"temperature", 12.5}, {"pressure_sensor", true}, {"attitude_period", 0.0}});
    hear(with, 0, 0, 0, 20);
    with.say(frame(6, "0500"));
    with.run_to(with.now + 999ms);
    EXPECT_TRUE(of_id(with.sent(), water_stats).empty());
    with.run_to(with.now + 1ms);
    const Bytes stats = of_id(with.sent(), water_stats).at(0).bytes;
    EXPECT_EQ(f32(stats, 8), 12.5);
    EXPECT_NEAR(f32(stats, 12), 1.013 + 2.01, 0.01) << "bar under 20 m of sea";
}

TEST(Surveyor240Hosts, ANewHostOnTheStreamHearsNothingBeforeItsFirstWord) {
    Bench bench = surveyor();
    bench.say(frame(Set{}), tcp);
    bench.run_to(500ms);
    EXPECT_FALSE(bench.sent().empty());
    bench.device().reconnected(tcp);
    bench.run_to(1500ms);
    EXPECT_TRUE(bench.sent().empty());
    bench.say("42 52 02 00 06 00 00 00 04 00 a0 00", tcp);
    bench.run_to(1999ms);
    const auto sent = bench.sent();
    EXPECT_EQ(u16(sent.at(0).bytes, 4), 4);
    EXPECT_EQ(of_id(sent, utc_request).size(), 1U);
    EXPECT_EQ(of_id(sent, atof_points).size(), 5U) << "the pings have gone on";
    EXPECT_EQ(of_id(sent, attitude_report).size(), 4U);
}

TEST(Surveyor240Hosts, MessagesOfOneMomentKeepApartButNotForLong) {
    Bench bench = surveyor({{"temperature", 11.5}});
    Set set;
    set.yz = true;
    set.period = 0;
    set.end = 1000;
    bench.say(frame(set));
    std::map<std::size_t, Time> last;
    for (int step = 0; step < 2000; ++step) {
        const Time before = bench.now;
        bench.run_to(bench.now + 1ms);
        for (const Send& send : bench.sent()) {
            EXPECT_GE(send.not_before, last[send.port]) << "in order";
            EXPECT_LE(send.not_before, before + 1ms + 40ms) << "never later than that";
            last[send.port] = send.not_before;
        }
    }
    Bench calm = surveyor();
    calm.say(frame(6, "0500"));
    set.period = 100;
    calm.say(frame(set));
    calm.run_to(1s);
    const auto sent = calm.sent();
    for (std::size_t n = 1; n < sent.size(); ++n)
        EXPECT_GE(sent[n].not_before - sent[n - 1].not_before, 10ms) << n;
}

TEST(Surveyor240Hosts, OnDatagramsTheLastSenderIsTheHost) {
    Bench bench = surveyor();
    bench.say(frame(Set{}), udp, host);
    const Address other{0x7F000001, 40001};
    bench.say(frame(6, "0500"), udp, other);
    bench.say(Bytes{}, udp, host);
    bench.sent();
    bench.run_to(50ms);
    const auto sent = bench.sent();
    EXPECT_EQ(of_id(sent, atof_points).at(0).to, other) << "an empty datagram is no word";
}

}  // namespace
}  // namespace echoloop::test
