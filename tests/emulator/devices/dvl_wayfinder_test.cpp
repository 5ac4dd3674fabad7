// A Wayfinder on the bench: commands are literal bytes, and what it says is read at the offsets of the
// maker's public driver, never by the project's codec.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/emulator/devices/doppler_echo.h"
#include "tests/emulator/devices/noisy_line.h"
#include "tests/emulator/devices/wayfinder_words.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;

using namespace wayfinder;

struct Log {
    explicit Log(const Options& changes = {}) : bench(make_device("dvl-wayfinder", {}, changes)) {}

    std::vector<Data> data(Time end) {
        bench.sent();
        bottom.run(bench, end);
        return read_data(bench.sent());
    }
    /// The answer's payload, empty without one.
    Bytes ask(const Bytes& words) {
        bench.sent();
        bench.say(words);
        const auto found = payloads(bench.sent(), 4);
        return found.empty() ? Bytes{} : found.back();
    }
    /// How it went, and for a refusal the parameter.
    std::array<int, 2> outcome(const Bytes& words) {
        const Bytes answer = ask(words);
        return {answer.size() > 4 ? answer[4] : -1, answer.size() > 5 ? answer[5] : 0};
    }

    Bench bench;
    OverBottom bottom;
};

using Outcome = std::array<int, 2>;

/// Turned to port from east by `yaw`, deg.
Quat lying(double yaw) { return axis_angle({0, 0, 1}, deg_to_rad(yaw)); }

TEST(Wayfinder, AnswersAsTheMakersDriverHasIt) {
    Log log({{"pings_at_start", false}, {"serial_number", std::int64_t{4711}}});
    log.bench.say("aa10010f0002030800010000815901");
    const auto sent = log.bench.sent();
    ASSERT_EQ(sent.size(), 1U);
    const Bytes system = payloads(sent, 4).at(0);
    ASSERT_EQ(system.size(), 141U) << "the driver wants all of it";
    EXPECT_EQ(to_hex(Bytes(system.begin(), system.begin() + 12)),
              "010000810100"
              "211087000000");
    EXPECT_FLOAT_EQ(f32(system, 12), 614400);
    EXPECT_EQ(system[24], 0x67) << "its number";
    EXPECT_NEAR(f32(system, 33), 30, 1e-4);
    EXPECT_EQ(system[139], 76);

    log.bench.say("aa10010f000203080010000000e700");
    EXPECT_EQ(to_hex(log.bench.sent().at(0).bytes), "aa10011000020409001000000001eb00")
        << "of the specification";
    EXPECT_EQ(to_hex(log.ask(command(stop))), "0f00000001");

    const Bytes set_up = log.ask(command(get_setup));
    EXPECT_EQ(to_hex(set_up),
              "010000850100"
              "221114000000"
              "0007"
              "0080bb44"
              "00007042"
              "00000000");
    EXPECT_EQ(to_hex(log.ask(command(get_features))),
              "010000100100"
              "261007000000"
              "01");
    EXPECT_EQ(to_hex(log.ask(command(get_tests))),
              "010000190100"
              "24100c000000"
              "010101010101");
    const Bytes boards = log.ask(command(get_components));
    ASSERT_EQ(boards.size(), 141U);
    EXPECT_EQ(to_hex(Bytes(boards.begin() + 6, boards.begin() + 13)), "29108700000004");
    std::string seen;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::string text(boards.begin() + 13 + static_cast<std::ptrdiff_t>(32 * i),
                               boards.begin() + 45 + static_cast<std::ptrdiff_t>(32 * i));
        seen += text.substr(0, 3);
        EXPECT_EQ(text.substr(text.find('\0') + 1, 9), std::string("A\0"
                                                                   "004711\0",
                                                                   9));
    }
    EXPECT_EQ(seen, "CPUXDRDSCSYS") << "by which the driver finds them";
}

TEST(Wayfinder, VelocityIsTheVehiclesAlongItsBeams) {
    // It looks north and goes 0.5 m/s ahead, 0.2 to starboard, 0.1 down.
    Log log;
    log.bottom.velocity = {0.2, 0.5, -0.1};
    log.bottom.orientation = lying(90);
    const auto data = log.data(3s);
    ASSERT_GT(data.size(), 10U);
    const Data& last = data.back();
    EXPECT_NEAR(last.velocity[0], 0.2, 0.002);
    EXPECT_NEAR(last.velocity[1], 0.5, 0.002);
    EXPECT_NEAR(last.velocity[2], -0.1, 0.002);
    EXPECT_NEAR(last.velocity[3], 0, 0.002);
    EXPECT_EQ(last.bytes[20], 1) << "axes of the instrument";
    EXPECT_FLOAT_EQ(last.speed, 1500);

    Log beams({{"frame", std::string("beam")}});
    beams.bottom = log.bottom;
    const Data along = beams.data(beams.bench.now + 3s).back();
    const double b = std::sin(deg_to_rad(30)), c = std::cos(deg_to_rad(30));
    const std::array<double, 4> wanted{-0.2 * b + 0.1 * c, 0.2 * b + 0.1 * c, 0.5 * b + 0.1 * c,
                                       -0.5 * b + 0.1 * c};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(along.velocity[i], wanted[i], 0.002) << i;
    EXPECT_EQ(along.bytes[20], 0);
}

TEST(Wayfinder, RangesAreVerticalUnlessTheOptionSaysSlant) {
    for (const double altitude : {0.6, 3.0, 9.0, 25.0, 55.0})
        for (const bool slant : {false, true}) {
            Log log({{"ranges", std::string(slant ? "slant" : "vertical")}});
            log.bottom.altitude = altitude;
            const auto data = log.data(15s);
            ASSERT_FALSE(data.empty());
            const double wanted = slant ? altitude / std::cos(deg_to_rad(30)) : altitude;
            for (const float range : data.back().range) EXPECT_NEAR(range, wanted, 0.005 * wanted + 0.006);
            EXPECT_NEAR(data.back().mean, wanted, 0.005 * wanted + 0.006);
        }
}

TEST(Wayfinder, PortIsNotStarboardAndABeamWithoutAnEchoIsNoNumber) {
    for (const auto& [bearing, beam] : {std::pair{-90.0, 0U}, {90.0, 1U}, {0.0, 2U}, {-180.0, 3U}}) {
        Log log({{"frame", std::string("beam")}});
        log.bottom.deaf = bearing;
        const Data data = log.data(3s).back();
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(std::isnan(data.velocity[i]), i == beam) << bearing;
            EXPECT_EQ(std::isnan(data.range[i]), i == beam) << bearing;
        }
        EXPECT_NEAR(data.mean, 5, 0.03) << "of the others";
        Log three;
        three.bottom.deaf = bearing;
        const Data solved = three.data(3s).back();
        EXPECT_FALSE(std::isnan(solved.velocity[0]));
        EXPECT_TRUE(std::isnan(solved.velocity[3])) << "three beams have no error velocity";
    }
    Log lost;
    lost.bottom.altitude = 0;
    const auto data = lost.data(5s);
    ASSERT_FALSE(data.empty());
    for (const float value : data.back().velocity) EXPECT_TRUE(std::isnan(value));
    for (const float value : data.back().range) EXPECT_TRUE(std::isnan(value));
    EXPECT_TRUE(std::isnan(data.back().mean));
}

TEST(Wayfinder, PingsAsOftenAsTheAltitudeAndTheLineAllow) {
    Log log;
    log.bottom.altitude = 8;
    log.data(5s);
    EXPECT_NEAR(static_cast<double>(log.data(15s).size()), 10 / (0.03 + 4.2e-3 * 8), 5);
    // 98 bytes at 9600 bit/s take 102 ms, and the answer itself comes at the old rate.
    log.bench.sent();
    log.bench.say(command(set_setup, setup(0, 3, 1500, 60)));
    const auto answer = log.bench.sent();
    ASSERT_EQ(answer.size(), 1U);
    EXPECT_EQ(answer[0].line_rate, 0);
    log.bottom.run(log.bench, log.bench.now + 10s);
    const auto sent = log.bench.sent();
    EXPECT_NEAR(static_cast<double>(sent.size()), 93, 5);
    EXPECT_EQ(sent.back().line_rate, 9600);
}

TEST(Wayfinder, WithoutABottomItLooksAsFarAsItsSetupSays) {
    const auto farthest = [](float range) {
        Log log({{"pings_at_start", false}});
        log.bottom.altitude = 0;
        EXPECT_EQ(log.outcome(command(set_setup, setup(0, 7, 1500, range))), (Outcome{1, 0}));
        log.ask(command(start));
        log.data(10s);
        double most = 0;
        for (const Shot& shot : log.bench.shots)
            most = std::max(most, static_cast<double>(shot.bins) * shot.bin_interval);
        return 1500 / 2 * most * std::cos(deg_to_rad(30));
    };
    EXPECT_NEAR(farthest(60), 1.15 * 60, 0.5);
    EXPECT_NEAR(farthest(10), 1.15 * 10, 0.5);
}

TEST(Wayfinder, SpeedOfSoundCountsFromTheNextPingOn) {
    Log log;
    log.bottom.velocity = {0.5, 0, 0};
    log.data(3s);
    for (Time end = 3s; !log.bench.ping && end < 4s; end += 1ms) log.data(end);
    ASSERT_TRUE(log.bench.ping) << "one is under way";
    EXPECT_EQ(log.outcome(command(set_speed, number(1400))), (Outcome{1, 0}));
    const auto data = log.data(log.bench.now + 1s);
    ASSERT_GT(data.size(), 3U);
    EXPECT_FLOAT_EQ(data[0].speed, 1500) << "of the ping that was under way";
    EXPECT_NEAR(data[0].mean, 5, 0.03);
    EXPECT_FLOAT_EQ(data[1].speed, 1400);
    EXPECT_NEAR(data[1].mean, 5 * 1400 / 1500.0, 0.03) << "the water has 1500 m/s";
    EXPECT_NEAR(data[1].velocity[1], 0.5 * 1400 / 1500.0, 0.003);
    EXPECT_FLOAT_EQ(f32(log.ask(command(get_setup)), 14), 1400);
}

TEST(Wayfinder, TriggersMakeOnePingEach) {
    Log log;
    EXPECT_EQ(log.outcome(command(trigger)), (Outcome{4, 0})) << "it pings by itself";
    log.data(1s);
    EXPECT_EQ(log.outcome(command(set_setup, setup(1, 7, 1500, 60))), (Outcome{1, 0}));
    EXPECT_LE(log.data(2s).size(), 1U) << "the one under way";
    EXPECT_EQ(log.data(30s).size(), 0U);
    for (int i = 0; i < 40; ++i) {
        EXPECT_EQ(log.outcome(command(trigger)), (Outcome{1, 0}));
        EXPECT_EQ(log.data(log.bench.now + 1s).size(), 1U)
            << i << ": no look at nearer depths takes one away";
    }
    for (int i = 0; i < 5; ++i) log.ask(command(trigger));
    EXPECT_EQ(log.data(log.bench.now + 2s).size(), 2U) << "one under way, one that waits";
    log.ask(command(stop));
    EXPECT_EQ(log.outcome(command(trigger)), (Outcome{4, 0})) << "it is stopped";
    EXPECT_EQ(log.data(log.bench.now + 2s).size(), 0U);
    log.ask(command(start));
    EXPECT_EQ(log.data(log.bench.now + 2s).size(), 0U) << "it waits again";
    log.ask(command(set_setup, setup(0, 7, 1500, 60)));
    EXPECT_GT(log.data(log.bench.now + 2s).size(), 10U);
}

TEST(Wayfinder, StopsAndStarts) {
    Log log;
    EXPECT_GT(log.data(1s).size(), 3U);
    EXPECT_EQ(log.outcome(command(stop)), (Outcome{1, 0}));
    EXPECT_EQ(log.outcome(command(stop)), (Outcome{1, 0})) << "once more";
    EXPECT_EQ(log.data(log.bench.now + 5s).size(), 0U);
    EXPECT_EQ(log.outcome(command(start)), (Outcome{1, 0}));
    EXPECT_GT(log.data(log.bench.now + 1s).size(), 3U);
}

TEST(Wayfinder, RefusesWhatItCannotDo) {
    Log log;
    log.data(1s);
    EXPECT_EQ(log.outcome(command(get_tests)), (Outcome{7, 0})) << "not while pinging";
    EXPECT_EQ(log.outcome(command(defaults)), (Outcome{7, 0}));
    EXPECT_EQ(log.outcome(command(0x12345678)), (Outcome{2, 0})) << "unknown";
    EXPECT_EQ(log.outcome(command(0x1B000002)), (Outcome{7, 0})) << "the spectrum";
    for (const auto& [values, wrong] : {std::pair{setup(0, 8, 1500, 60), 1},
                                        {setup(2, 7, 1500, 60), 2},
                                        {setup(0, 7, 1399, 60), 3},
                                        {setup(0, 7, std::nanf(""), 60), 3},
                                        {setup(0, 7, 1500, 60.5F), 4},
                                        {setup(0, 7, 1500, 0), 4}})
        EXPECT_EQ(log.outcome(command(set_setup, values)), (Outcome{3, wrong}));
    EXPECT_EQ(log.outcome(command(set_setup, {1, 2, 3})), (Outcome{3, 0})) << "no setup at all";
    EXPECT_EQ(log.outcome(command(set_speed, number(1700))), (Outcome{3, 3}));
    EXPECT_EQ(log.outcome(command(set_speed)), (Outcome{3, 3}));
    const Bytes thirteenth_month{0x23, 0x10, 12, 0, 0, 0, 26, 13, 1, 0, 0, 0};
    EXPECT_EQ(log.outcome(command(set_time, thirteenth_month)), (Outcome{3, 5}));
    const Bytes as_it_was = log.ask(command(get_setup));
    EXPECT_EQ(to_hex(Bytes(as_it_was.begin() + 12, as_it_was.end())),
              "0007"
              "0080bb44"
              "00007042"
              "00000000");
    log.ask(command(stop));
    EXPECT_EQ(log.outcome(command(get_tests))[0], 1);
    EXPECT_EQ(log.outcome(command(0x1B000002)), (Outcome{6, 0}));
    EXPECT_TRUE(log.ask(packet(5, {1, 2, 3})).empty()) << "no command";
    EXPECT_TRUE(log.ask(packet(3, {1, 2, 3})).empty()) << "no number";
    const auto counters = log.bench.device().counters();
    EXPECT_GT(counters.rejected, 10U);
    EXPECT_GT(counters.messages, 2U);
}

TEST(Wayfinder, FactoryDefaultsAndBothVersionsOfASetup) {
    Log log({{"pings_at_start", false}, {"max_range", 20.0}, {"speed_of_sound", 1490.0}});
    EXPECT_FLOAT_EQ(f32(log.ask(command(get_setup)), 18), 20);
    Bytes older{0x22, 0x10, 16, 0, 0, 0, 1, 7};
    append(older, number(1480));
    append(older, number(30));
    EXPECT_EQ(log.outcome(command(set_setup, older)), (Outcome{1, 0}));
    EXPECT_FLOAT_EQ(f32(log.ask(command(get_setup)), 14), 1480);
    Bytes of_the_driver = setup(1, 7, 1470, 40);
    of_the_driver[2] = 16;  // which it says of a setup that it has not read before
    EXPECT_EQ(log.outcome(command(set_setup, of_the_driver)), (Outcome{1, 0}));
    EXPECT_FLOAT_EQ(f32(log.ask(command(get_setup)), 18), 40);
    EXPECT_EQ(log.outcome(command(defaults)), (Outcome{1, 0}));
    const Bytes fresh = log.ask(command(get_setup));
    EXPECT_EQ(to_hex(Bytes(fresh.begin() + 6, fresh.end())),
              "221114000000"
              "0007"
              "0080bb44"
              "00007042"
              "00000000");
}

TEST(Wayfinder, ItsClockIsSetAndTimesPingsInHundredths) {
    Log log;
    EXPECT_EQ(log.outcome(command(set_time, {0x23, 0x10, 12, 0, 0, 0, 26, 11, 27, 12, 30, 15})),
              (Outcome{1, 0}));
    const auto data = log.data(2s);
    ASSERT_FALSE(data.empty());
    const Bytes& b = data.back().bytes;
    EXPECT_EQ(to_hex(Bytes(b.begin() + 12, b.begin() + 17)), "1a0b1b0c1e");
    EXPECT_NEAR(b[17] + 0.001 * u16(b, 18), 17, 0.2);
    EXPECT_EQ(u16(b, 18) % 10, 0U);
    const Bytes answer = log.ask(command(get_time));
    EXPECT_EQ(to_hex(answer),
              "0100001d0100"
              "23100c000000"
              "1a0b1b0c1e11");
}

TEST(Wayfinder, NoiseOnTheLineCannotWedgeIt) {
    Bench bench(make_device("dvl-wayfinder", {}, {{"pings_at_start", false}}));
    NoisyHost host;
    for (const Bytes& words :
         {command(get_system), command(get_setup), command(set_setup, setup(0, 7, 1480, 40)), command(start),
          command(stop), command(get_time), command(get_components)})
        host.words.push_back(to_hex(words));
    host.request = to_hex(command(get_features));
    host.is_answer = [](const Send& send) { return send.bytes.size() == 24 && send.bytes[6] == 4; };
    host.patience = 10ms;
    expect_no_wedge(bench, host);
}

}  // namespace
}  // namespace echoloop::test
