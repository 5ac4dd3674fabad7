// The Oculus sonars on the bench: status, standby, results, timing, and fires that make no sense.
#include <cmath>
#include <random>

#include "tests/emulator/devices/oculus_bench.h"

namespace echoloop::test {
namespace {

TEST(OculusStatus, ComesOnceASecondAndHas142Bytes) {
    OculusBench bench({{"status_bits", std::int64_t{0x4003}}});
    bench.run_to(3500ms);
    std::vector<Send> status;
    for (const Send& send : bench.sent())
        if (send.port == 1) status.push_back(send);
    ASSERT_EQ(status.size(), 4U) << "at 0, 1, 2 and 3 s";
    EXPECT_EQ(status[0].to, (Address{0x7FFFFFFF, 52102})) << "loopback's broadcast";
    const Bytes& s = status.back().bytes;
    ASSERT_EQ(s.size(), 142U);
    EXPECT_EQ(at<std::uint16_t>(s, 0), 0x4F53);
    EXPECT_EQ(at<std::uint16_t>(s, 2), 1001);
    EXPECT_EQ(at<std::uint32_t>(s, 10), 126U);
    EXPECT_EQ(at<std::uint32_t>(s, 16), 1001U) << "the source of its header, too";
    EXPECT_EQ(at<std::uint16_t>(s, 20), 1);
    EXPECT_EQ(at<std::uint16_t>(s, 22), 1042);
    EXPECT_EQ(at<std::uint32_t>(s, 24), 0x4003U);
    EXPECT_EQ(to_hex(ByteView(s).subspan(52, 12)), "7f000001ffffff007f000001");
    EXPECT_EQ(at<double>(s, 70), 10);
}

TEST(OculusStatus, TellsTheModelTheAddressAndTheClient) {
    const std::pair<const char*, int> models[] = {
        {"oculus-m370s", 1041}, {"oculus-m750d", 1032}, {"oculus-m1200d", 1042}, {"oculus-m3000d", 2203}};
    for (const auto& [model, part] : models) {
        Bench bench(make_device(model, {"tcp-listen://192.168.2.4:52100", "udp://192.168.2.255:52102"}));
        bench.run_to(100ms);
        const auto first = bench.sent();
        ASSERT_FALSE(first.empty());
        EXPECT_EQ(first[0].to, (Address{0xC0A802FF, 52102}));
        EXPECT_EQ(at<std::uint16_t>(first[0].bytes, 22), part) << model;
        EXPECT_EQ(to_hex(ByteView(first[0].bytes).subspan(52, 12)), "c0a80204ffffff0000000000");
        const auto client_at = [&bench](Time time) {
            bench.run_to(time);
            std::string client;
            for (const Send& send : bench.sent())
                if (send.port == 1) client = to_hex(ByteView(send.bytes).subspan(60, 4));
            return client;
        };
        bench.device().connected(0, {0xC0A80207, 40000}, bench.now);
        EXPECT_EQ(client_at(1100ms), "c0a80207") << "before it has said anything";
        bench.device().disconnected(0, {}, bench.now);
        EXPECT_EQ(client_at(2100ms), "00000000");
    }
}

TEST(OculusEndpoints, ThatLeadNowhereAreRefused) {
    const auto refused = [](std::vector<std::string> endpoints) {
        EXPECT_THROW(make_device("oculus-m750d", std::move(endpoints)), std::invalid_argument);
    };
    refused({"tcp-listen://0.0.0.0:52100", "udp://192.168.2.255:52102"});
    refused({"tcp-listen://192.168.2.4:52100"});
    refused({"tcp-listen://127.0.0.1:52100", "udp-listen://127.0.0.1:52102"});
}

TEST(OculusOptions, AMaskThatIsNoneIsRefused) {
    EXPECT_THROW(make_device("oculus-m750d", {}, {{"mask", std::string("255.255")}}), std::invalid_argument);
}

TEST(OculusStandby, IsTheStateBeforeTheFirstFireAndKeepsADummyASecond) {
    OculusBench bench;
    auto sends = bench.sent_within(3500ms);
    EXPECT_EQ(count(sends, is_dummy), 4U);
    EXPECT_EQ(count(sends, is_result), 0U);
    bench.say(fire({}));
    sends = bench.sent_within(3s);
    EXPECT_EQ(count(sends, is_dummy), 0U);
    EXPECT_EQ(count(sends, is_result), 30U) << "one fire, free running at 10 Hz";
    bench.say(fire({.rate = 5}));
    bench.sent_within(100ms);
    sends = bench.sent_within(3s);
    EXPECT_EQ(count(sends, is_dummy), 3U);
    EXPECT_EQ(count(sends, is_result), 0U);
    bench.say(fire({.rate = 3}));
    EXPECT_EQ(count(bench.sent_within(2s), is_result), 10U);
}

TEST(OculusStandby, IsForcedByOverTemperature) {
    OculusBench bench({{"status_bits", std::int64_t{0x8003}}});
    bench.say(fire({}));
    const auto sends = bench.sent_within(3500ms);
    EXPECT_EQ(count(sends, is_result), 0U);
    EXPECT_EQ(count(sends, is_dummy), 4U);
}

TEST(OculusStandby, IsForcedByEveryStateButTheMainProgram) {
    for (const std::int64_t state : {0, 1, 2}) {
        OculusBench bench({{"status_bits", state}});
        bench.say(fire({}));
        EXPECT_EQ(count(bench.sent_within(3500ms), is_result), 0U) << state;
    }
}

TEST(OculusResult, OfVersion1EchoesTheFireAndStandsWhereItShould) {
    OculusBench bench({{"rate_echo", std::string("requested")}});
    const Bytes request =
        fire({.mode = 1, .flags = 0x0D, .range = 12.34, .gain = 61.5, .sound_speed = 1480.25});
    const Seen first = bench.next_after(request);
    EXPECT_EQ(to_hex(ByteView(first.bytes).first(10)), "534fe903000023000000");
    EXPECT_EQ(at<std::uint32_t>(first.bytes, 10) + 16, first.bytes.size());
    EXPECT_EQ(to_hex(ByteView(first.bytes).subspan(16, 37)), to_hex(ByteView(request).subspan(16)));
    EXPECT_EQ(first.sound_speed(), 1480.25);
    EXPECT_EQ(at<double>(first.bytes, 61), 281.25e6 / 234);
    EXPECT_EQ(at<double>(first.bytes, 69), 10);
    EXPECT_EQ(at<std::uint32_t>(first.bytes, 57), 0U) << "status";
    EXPECT_EQ(first.beams(), 256U);
    EXPECT_EQ(first.image_size(), first.ranges() * (256 + 4));
    EXPECT_EQ(first.image_offset() + first.image_size(), first.bytes.size());
    EXPECT_EQ(at<std::uint32_t>(first.bytes, 118), first.bytes.size());
    EXPECT_EQ(first.image_offset(), 2048U);
    const Seen second = bench.next();
    EXPECT_EQ(second.ping(), first.ping() + 1);
    EXPECT_EQ(at<std::uint32_t>(second.bytes, 93) - at<std::uint32_t>(first.bytes, 93), 100'000'000U) << "ns";
}

TEST(OculusResult, OfVersion2HasItsOwnPlacesAndAnAttitude) {
    OculusBench bench({{"rate_echo", std::string("requested")}});
    const Bytes request = fire({.flags = 0x4D, .range = 5}, true);
    bench.say(request);
    bench.run_to(bench.now);
    ASSERT_TRUE(bench.ping);
    Echogram echogram = echo_of(bench.ping->shot, 3, 1e12F);
    // Looks south of east, 20 deg down, at 4 m depth.
    echogram.world_from_sonar = {{0, 0, -4}, from_rpy(deg_to_rad(5), deg_to_rad(20), deg_to_rad(-30))};
    const auto actions = bench.device().heard(echogram, bench.ping->due);
    ASSERT_EQ(actions.send.size(), 1U);
    const Seen seen(actions.send[0].bytes);
    EXPECT_EQ(at<std::uint16_t>(seen.bytes, 8), 2);
    EXPECT_EQ(to_hex(ByteView(seen.bytes).subspan(16, 73)), to_hex(ByteView(request).subspan(16)));
    EXPECT_EQ(seen.beams(), 512U);
    EXPECT_EQ(seen.image_size(), seen.ranges() * (512 + 4));
    EXPECT_EQ(at<std::uint32_t>(seen.bytes, 198), seen.bytes.size());
    EXPECT_NEAR(at<double>(seen.bytes, 113), 0.402, 0.001) << "bar at 4 m";
    EXPECT_NEAR(at<double>(seen.bytes, 121), 120, 1e-9) << "compass heading";
    EXPECT_NEAR(at<double>(seen.bytes, 129), -20, 1e-9) << "nose down";
    EXPECT_NEAR(at<double>(seen.bytes, 137), 5, 1e-9) << "starboard down";
    EXPECT_EQ(at<double>(seen.bytes, 153), 0) << "fired at power-up";
}

TEST(OculusTiming, FollowsRangeAndRate) {
    struct Row {
        const char* model;
        int mode, rate;
        double range, period;
    };
    // Longest of 1 / rate and 2 R / c + 8 ms, at 1500 m/s.
    const Row rows[] = {{"oculus-m1200d", 2, 0, 2, 0.1},
                        {"oculus-m1200d", 2, 1, 2, 1 / 15.0},
                        {"oculus-m1200d", 2, 2, 2, 0.025},
                        {"oculus-m1200d", 1, 3, 40, 0.2},
                        {"oculus-m1200d", 1, 4, 40, 0.5},
                        {"oculus-m1200d", 1, 2, 40, 80 / 1500.0 + 0.008},
                        {"oculus-m370s", 1, 0, 200, 400 / 1500.0 + 0.008}};
    for (const Row& row : rows) {
        OculusBench bench({}, row.model);
        bench.say(fire({.mode = row.mode, .rate = row.rate, .range = row.range}));
        bench.run_to(bench.now);
        ASSERT_TRUE(bench.ping) << "at once";
        EXPECT_NEAR(to_seconds(bench.ping->due), 2 * row.range / 1500 + 0.008, 1e-6) << row.model << row.rate;
        const Time before = bench.ping->due;
        bench.next();
        bench.next();
        EXPECT_NEAR(to_seconds(bench.now - before), row.period, 0.0021) << row.model << row.rate;
    }
}

TEST(OculusTiming, ANewFireTakesEffectWithTheNextPing) {
    OculusBench bench;
    bench.say(fire({.rate = 2, .range = 30}));
    bench.run_to(10ms);
    bench.say(fire({.rate = 2, .range = 5}));
    EXPECT_EQ(at<double>(bench.next().bytes, 21), 30) << "the ping that was under way";
    const Seen second = bench.next();
    EXPECT_EQ(at<double>(second.bytes, 21), 5);
    EXPECT_NEAR(static_cast<double>(second.ranges()) * second.resolution(), 5, second.resolution());
    for (int i = 0; i < 20; ++i) bench.say(fire({.rate = 2, .range = 5})), bench.run_to(bench.now + 5ms);
    EXPECT_LE(count(bench.sent(), is_result), 4U) << "a fire for each picture does not raise the rate";
}

TEST(OculusFire, OfHeaderVersion1IsObeyedAsOneOf0) {
    OculusBench bench({{"rate_echo", std::string("requested")}});
    Bytes request = fire({.flags = 0x0D, .range = 6.5});
    request.at(8) = 1;
    const Seen seen = bench.next_after(request);
    EXPECT_FALSE(seen.v2);
    EXPECT_EQ(to_hex(ByteView(seen.bytes).subspan(16, 37)), to_hex(ByteView(request).subspan(16)));
    EXPECT_EQ(seen.image_size(), seen.ranges() * (256 + 4));
    EXPECT_EQ(bench.device().counters().rejected, 0U);
}

TEST(OculusFire, ThatMakesNoSenseIsRefusedAndChangesNothing) {
    OculusBench bench;
    bench.say(fire({.range = 7}));
    for (const Wish& wish : {Wish{.mode = 0}, Wish{.mode = 3}, Wish{.range = std::nan("")},
                             Wish{.gain = INFINITY}, Wish{.sound_speed = -INFINITY}})
        bench.say(fire(wish));
    EXPECT_EQ(at<double>(bench.next().bytes, 21), 7);
    EXPECT_EQ(at<double>(bench.next().bytes, 21), 7);
    EXPECT_EQ(bench.device().counters().rejected, 5U);
    EXPECT_EQ(bench.next_after(fire({.rate = 77, .gain = 1e300, .sound_speed = 1e9})).sound_speed(), 1700);
}

TEST(OculusFire, OnANoisyLineIsObeyedAgainWithinOneMessage) {
    std::mt19937 random(7);
    OculusBench bench;
    for (int round = 0; round < 300; ++round) {
        for (int i = 0; i < 5; ++i) {
            Bytes bytes = fire({.mode = 1 + i % 2, .range = 2.0 + i}, i % 3 == 0);
            for (std::uint8_t& byte : bytes)
                if (random() % 20 == 0) byte ^= static_cast<std::uint8_t>(1 + random() % 255);
            bench.say(bytes);
            bench.run_to(bench.now + std::chrono::milliseconds(random() % 20));
        }
        const double range = 3 + round / 1000.0;
        bench.sent();
        bench.say(fire({.rate = 2, .range = range}));
        bool obeyed = false;
        for (int pings = 0; pings < 2 && !obeyed; ++pings)
            obeyed = at<double>(bench.next().bytes, 21) == range;
        ASSERT_TRUE(obeyed) << "round " << round;
        bench.shots.clear();
    }
}

}  // namespace
}  // namespace echoloop::test
