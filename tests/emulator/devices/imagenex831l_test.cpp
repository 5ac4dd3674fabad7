// An Imagenex 831L on a bench, driven by literal commands and read by the offsets of the specification notes.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/emulator/devices/imagenex_bench.h"
#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
namespace {
using namespace std::chrono_literals;
using testing::ElementsAre;

// 1 m, 20 dB, 0.1 dB/m, all around by 0.9 deg, 10 us, from 1 cm on, pitch and roll read, 2250 kHz.
const std::string plain = "FE44000A000000001400 0A7878030A01000000190801000000 64FD";
enum At {
    id = 2,
    range,
    motion = 5,
    gain = 8,
    absorption = 10,
    train,
    sector,
    step,
    pulse,
    least,
    tilt = 21,
    profile,
    calibrate,
    frequency = 25
};

Bytes command(const Changes& changes = {}) { return changed(plain, changes); }
Bench profiler(const Options& changes = {}) { return Bench(make_device("imagenex-831l", {}, changes)); }
int position(const Bytes& reply) { return u14(reply, 5) & 0x1FFF; }
int profile_of(const Bytes& reply) { return u14(reply, 8); }
/// 14 signed bits, low byte first.
int signed14(const Bytes& reply, std::size_t at) {
    const int bits = (reply.at(at + 1) & 0x3F) << 8 | reply.at(at);
    return bits < 8192 ? bits : bits - 16384;
}
constexpr std::size_t roll_at = 16, pitch_at = 18, roll_g_at = 20, pitch_g_at = 22;

/// The reply to `words` where an echo of `length` bins begins in bin `bin`.
Bytes answer(Bench& bench, const Bytes& words, std::size_t bin, std::size_t length, float power) {
    bench.sent();
    bench.say(words);
    Echogram echogram = echo_of(bench.ping->shot, 0, 0);
    for (std::size_t i = bin; i < std::min(bin + length, echogram.values.size()); ++i)
        echogram.values[i] = power;
    bench.hear(echogram);
    return bench.sent().at(0).bytes;
}

TEST(Imagenex831l, NeverSaysAWordUnasked) {
    Bench bench = profiler();
    bench.run_to(3600s);
    EXPECT_TRUE(bench.sent().empty());
}

TEST(Imagenex831l, AnswersInOnePieceWithPositionRangeAndData) {
    Bench bench = profiler();
    bench.say(command());
    ASSERT_TRUE(bench.ping);
    EXPECT_EQ(bench.ping->due.count(), 3253333) << "2R/c + 1.92 ms: 400 of them in 1.3 s, as the sheet says";
    bench.run_to(1s);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U);
    const Bytes& reply = sent[0].bytes;
    ASSERT_EQ(reply.size(), 283U);
    // IMX, type 0, accepted, 603 = 4 * 128 + 91 clockwise, code 10, no profile, 250 = 1 * 128 + 122
    EXPECT_EQ(to_hex(ByteView(reply).first(16)),
              "494d580080"
              "5b440a00007a0100000000");
    EXPECT_EQ(to_hex(ByteView(reply).subspan(24, 8)), "0000000000000000");
    EXPECT_EQ(reply.back(), 0xFC);
    const Shot& shot = bench.shots.at(0);
    EXPECT_NEAR(shot.pan, deg_to_rad(0.9), 1e-9) << "one step to starboard";
    EXPECT_EQ(shot.bins, 2000U) << "0.5 mm each";
    EXPECT_NEAR(750 * shot.bin_interval * static_cast<double>(shot.bins), 1, 1e-12);
    EXPECT_EQ(shot.frequency, 2250e3);
    EXPECT_DOUBLE_EQ(shot.pulse_length, 10e-6);
    EXPECT_NEAR(rad_to_deg(shot.beam_width), 1.4, 1e-9);
}

TEST(Imagenex831l, ProfileModeHasNoData) {
    Bench bench = profiler();
    const auto reply = ask(bench, command({{profile, 1}}));
    ASSERT_EQ(reply.size(), 33U);
    EXPECT_EQ(reply[1], 'P');
    EXPECT_EQ(u14(reply, 10), 0);
    EXPECT_EQ(reply.back(), 0xFC);
}

TEST(Imagenex831l, EveryRangeCodeIsItsRange) {
    struct Row {
        int code;
        double metres;
        std::size_t bins;
    };
    for (const Row& row : {Row{2, 0.125, 250},
                           {4, 0.25, 500},
                           {6, 0.5, 1000},
                           {8, 0.75, 1500},
                           {10, 1, 2000},
                           {20, 2, 4000},
                           {30, 3, 6000},
                           {40, 4, 8000},
                           {50, 5, 10000},
                           {60, 6, 12000}}) {
        Bench bench = profiler();
        const auto reply = ask(bench, command({{range, row.code}}));
        EXPECT_EQ(reply.at(7), row.code);
        EXPECT_EQ(reply.at(4), 0x80);
        const Shot& shot = bench.shots.at(0);
        EXPECT_EQ(shot.bins, row.bins);
        EXPECT_NEAR(750 * shot.bin_interval * static_cast<double>(shot.bins), row.metres, 1e-12);
        EXPECT_NEAR(to_seconds(bench.now), std::max(3.25e-3, 2 * row.metres / 1500 + 1.92e-3), 1e-6);
    }
}

TEST(Imagenex831l, WhatItCannotDoIsTheNearestAndSaysSo) {
    Bench bench = profiler();
    const auto status = [&](const Changes& changes) { return ask(bench, command(changes)).at(4); };
    EXPECT_EQ(status({}), 0x80);
    EXPECT_EQ(status({{range, 11}}), 0x01) << "range error";
    EXPECT_EQ(status({{frequency, 79}}), 0x02) << "frequency error";
    EXPECT_EQ(status({{frequency, 121}, {range, 0}}), 0x03);
    EXPECT_EQ(status({{gain, 41}}), 0x00) << "not accepted, and no bit for it";
    EXPECT_EQ(bench.shots.at(1).bins, 2000U) << "1 m instead of code 11";
    EXPECT_EQ(bench.shots.at(2).frequency, 2150e3);
    Bench other = profiler({{"status_bits", std::string("accepted_0")}});
    EXPECT_EQ(ask(other, command()).at(4), 0x01);
    EXPECT_EQ(ask(other, command({{range, 11}})).at(4), 0x80);
}

TEST(Imagenex831l, OtherIdsAreNotAnswered) {
    Bench bench = profiler();
    EXPECT_TRUE(ask(bench, command({{id, 0x10}})).empty());
    EXPECT_EQ(bench.device().counters().rejected, 1U);
    EXPECT_EQ(ask(bench, command()).size(), 283U);
}

TEST(Imagenex831l, FrequencyPulseAndGainChangeTheNextPing) {
    Bench bench = profiler();
    ask(bench, command({{frequency, 80}, {pulse, 100}}));
    ask(bench, command({{frequency, 120}}));
    EXPECT_EQ(bench.shots[0].frequency, 2150e3);
    EXPECT_DOUBLE_EQ(bench.shots[0].pulse_length, 100e-6);
    EXPECT_NEAR(rad_to_deg(bench.shots[0].beam_width), 1.4 * 2250 / 2150, 1e-9);
    EXPECT_EQ(bench.shots[1].frequency, 2350e3);
    const auto point = [&](const Changes& changes) {
        return answer(bench, command(changes), 1000, 8, 1.6e15F).at(32 + 125);
    };
    const int at_20 = point({});
    EXPECT_NEAR(double(point({{gain, 14}})) / at_20, 0.5, 0.05) << "6 dB less";
    EXPECT_NEAR(double(point({{absorption, 110}})) / at_20, std::pow(10, 1.0 / 20), 0.05)
        << "1 dB/m more, there and back over half a metre";
    EXPECT_EQ(point({{gain, 40}}), 127);
    Bench full = profiler({{"echo_ceiling", std::string("255")}});
    EXPECT_EQ(answer(full, command({{gain, 40}}), 1000, 8, 1.6e15F).at(32 + 125), 255);
}

TEST(Imagenex831lProfile, IsWhereTheEchoBeginsOrItsMiddleLessThatOfThePulse) {
    Bench bench = profiler();
    // 23 bins of 0.5 mm are one and a half times the 7.5 mm of 10 us: so long is a pulse with its end.
    EXPECT_EQ(profile_of(answer(bench, command(), 600, 23, 1.6e16F)), 600);
    EXPECT_EQ(profile_of(answer(bench, command({{motion, 1}}), 600, 23, 1.6e16F)), 600);
    EXPECT_EQ(profile_of(answer(bench, command(), 600, 29, 1.6e16F)), 603) << "a longer echo: its middle";
    EXPECT_EQ(profile_of(answer(bench, command({{motion, 1}}), 600, 29, 1.6e16F)), 600);
    EXPECT_EQ(profile_of(answer(bench, command(), 600, 15, 1e9F)), 0) << "too weak";
    EXPECT_EQ(profile_of(answer(bench, command(), 50, 15, 1e18F)), 0) << "nearer than 50 mm";
    EXPECT_EQ(profile_of(answer(bench, command({{least, 29}}), 600, 23, 1.6e16F)), 600) << "beyond 29 cm";
    EXPECT_EQ(profile_of(answer(bench, command({{least, 40}}), 600, 15, 1.6e16F)), 0) << "nearer than 40 cm";
}

TEST(Imagenex831lProfile, OptionsChangeItsUnitAndItsDelay) {
    Bench cm = profiler({{"profile_unit", std::string("centimetres")}});
    EXPECT_EQ(profile_of(answer(cm, command(), 600, 23, 1.6e16F)), 30);
    Bench less = profiler({{"filter_delay", std::string("subtracted")}});
    EXPECT_EQ(profile_of(answer(less, command(), 600, 23, 1.6e16F)), 560) << "20 mm at 1 m";
    EXPECT_EQ(profile_of(answer(less, command({{range, 8}}), 600, 23, 1.6e16F)), 568) << "16 mm at 0.75 m";
}

std::vector<int> positions(Bench& bench, const Bytes& words, int count) {
    std::vector<int> found;
    for (int i = 0; i < count; ++i) found.push_back(position(ask(bench, words)));
    return found;
}

TEST(Imagenex831lScan, ATurnHasFourHundredSteps) {
    Bench bench = profiler();
    const auto turn = positions(bench, command(), 400);
    EXPECT_EQ(turn[0], 603);
    EXPECT_EQ(turn[198], 1197);
    EXPECT_EQ(turn[199], 0);
    EXPECT_EQ(turn[399], 600);
    EXPECT_NEAR(to_seconds(bench.now), 1.3, 0.01) << "the sheet's";
    EXPECT_THAT(positions(bench, command({{step, 0}}), 2), ElementsAre(600, 600));
}

TEST(Imagenex831lScan, TheReverseBitTurnsItRoundOnce) {
    Bench bench = profiler();
    EXPECT_THAT(positions(bench, command(), 2), ElementsAre(603, 606));
    EXPECT_THAT(positions(bench, command({{motion, 0x40}}), 1), ElementsAre(603));
    const auto reply = ask(bench, command());
    EXPECT_EQ(position(reply), 600) << "it goes on as it was told once";
    EXPECT_EQ(reply.at(6) & 0x40, 0) << "counter-clockwise";
    EXPECT_THAT(positions(bench, command({{motion, 0x40}}), 3), ElementsAre(603, 606, 609));
    Bench held = profiler({{"reverse_bit", std::string("direction")}});
    EXPECT_THAT(positions(held, command({{motion, 0x40}}), 2), ElementsAre(597, 594));
    EXPECT_THAT(positions(held, command(), 2), ElementsAre(597, 600));
}

TEST(Imagenex831lScan, ASectorIsSweptAboutItsTrainAngle) {
    Bench bench = profiler({{"start_angle", 44.1}});
    const auto words = command({{train, 60}, {sector, 30}});  // 0 deg, 90 deg wide: 450 to 750
    EXPECT_THAT(positions(bench, words, 3), ElementsAre(750, 747, 744));
    const auto way = positions(bench, words, 200);
    EXPECT_EQ(*std::ranges::min_element(way), 450);
}

TEST(Imagenex831lScan, CalibrationMovesToZero) {
    Bench bench = profiler({{"start_angle", 90.0}});
    EXPECT_EQ(position(ask(bench, command({{calibrate, 1}}))), 600);
    EXPECT_NEAR(to_seconds(bench.now), 3.25e-3 + 99 * 3.25e-3, 1e-4) << "a quarter of a turn";
}

/// A head whose tail is astern: its 0 deg looks up.
Located mounted(Time time, double roll, double pitch_up, Vec3 velocity = {}) {
    const Quat body = from_rpy(deg_to_rad(roll), deg_to_rad(-pitch_up), 0.3);
    return {time, {{}, body * from_rpy(0, deg_to_rad(-90), 0)}, {velocity, {}}};
}

TEST(Imagenex831lTilt, IsThatOfTheVehicleWhoseTailHoldsIt) {
    Bench bench = profiler();
    bench.where = [](Time time) { return mounted(time, 12, 0); };
    auto reply = ask(bench, command());
    EXPECT_NEAR(signed14(reply, roll_at) * 0.025, 12, 0.026) << "starboard down";
    EXPECT_NEAR(signed14(reply, pitch_at) * 0.025, 0, 0.026);
    EXPECT_NEAR(signed14(reply, roll_g_at) * 0.24414, 1000 * std::sin(deg_to_rad(12)), 0.3);
    EXPECT_EQ(reply.at(17) & 0xC0, 0x80) << "new, no alarm";
    bench.where = [](Time time) { return mounted(time, 0, -7); };
    reply = ask(bench, command());
    EXPECT_NEAR(signed14(reply, roll_at) * 0.025, 0, 0.026);
    EXPECT_NEAR(signed14(reply, pitch_at) * 0.025, -7, 0.026) << "bow down";
    EXPECT_NEAR(signed14(reply, pitch_g_at) * 0.24414, -1000 * std::sin(deg_to_rad(7)), 0.3);
}

TEST(Imagenex831lTilt, FeelsTheVehiclesAcceleration) {
    Bench bench = profiler();
    // 0.5 m/s^2 to port, of a vehicle whose bow is 0.3 rad from east.
    bench.where = [](Time time) {
        const double v = 0.5 * to_seconds(time);
        return mounted(time, 0, 0, {-v * std::sin(0.3), v * std::cos(0.3), 0});
    };
    bench.run_to(10s);
    const auto reply = ask(bench, command());
    EXPECT_NEAR(signed14(reply, roll_g_at) * 0.24414, 500 / 9.80665, 0.3);
    EXPECT_NEAR(signed14(reply, pitch_g_at) * 0.24414, 0, 0.3);
    EXPECT_NEAR(signed14(reply, roll_at) * 0.025, rad_to_deg(std::asin(0.5 / 9.80665)), 0.026)
        << "an inclinometer cannot tell it from a tilt";
}

TEST(Imagenex831lTilt, IsReadWhenAskedForAndSetToZeroWhenCalibrated) {
    Bench bench = profiler();
    bench.where = [](Time time) { return mounted(time, 5, 0); };
    ask(bench, command());
    bench.where = [](Time time) { return mounted(time, 9, 0); };
    auto reply = ask(bench, command({{tilt, 0}}));
    EXPECT_NEAR(signed14(reply, roll_at) * 0.025, 5, 0.026) << "what it said last";
    EXPECT_EQ(reply.at(17) & 0x80, 0) << "not new";
    reply = ask(bench, command({{tilt, 255}}));
    EXPECT_EQ(signed14(reply, roll_at), 0);
    EXPECT_EQ(signed14(reply, roll_g_at), 0);
    bench.where = [](Time time) { return mounted(time, 12, 0); };
    reply = ask(bench, command());
    EXPECT_NEAR(signed14(reply, roll_at) * 0.025, 3, 0.026) << "from then on";
}

TEST(Imagenex831l, PortIsNotStarboard) {
    Bench bench = profiler();
    ask(bench, command());
    EXPECT_GT(bench.shots.at(0).pan, 0) << "603 is clockwise of 0 deg";
}

TEST(Imagenex831l, LevelsFollowTheSonarEquation) {
    Bench bench = profiler();
    const auto point = [&](std::size_t bin, float power) {
        return answer(bench, command({{absorption, 0}}), bin, 8, power).at(32 + bin / 8);
    };
    EXPECT_NEAR(double(point(800, 6.4e15F)) / point(800, 1.6e15F), 2, 0.1);
    EXPECT_NEAR(double(point(1600, 1.6e15F)) / point(800, 1.6e15F), 2, 0.1) << "20 log R";
}

TEST(Imagenex831l, WhileOneIsServedOnlyTheNewestWaits) {
    Bench bench = profiler();
    bench.say(command());
    bench.say(command({{range, 20}}));
    bench.say(command({{range, 30}}));
    bench.run_to(1s);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 2U);
    EXPECT_EQ(sent[0].bytes.at(7), 10);
    EXPECT_EQ(sent[1].bytes.at(7), 30);
}

TEST(Imagenex831l, ANewHostFindsNothingOfTheOldOne) {
    Bench bench = profiler();
    bench.say(command());
    bench.device().reconnected(0);
    bench.run_to(1s);
    EXPECT_TRUE(bench.sent().empty());
    EXPECT_EQ(ask(bench, command()).size(), 283U);
}

TEST(Imagenex831l, WhateverTheSwitchesOneLegalReplyComes) {
    std::mt19937 random(3);
    Bench bench = profiler();
    bench.echo_bin = 100;
    for (int i = 0; i < 2000; ++i) {
        const Bytes words = with_any_switches(command(), random);
        bench.echo_power = static_cast<float>(random());
        const Time before = bench.now;
        const auto reply = ask(bench, words);
        ASSERT_EQ(reply.size(), words[profile] != 0 ? 33U : 283U) << to_hex(words);
        ASSERT_LT(position(reply), 1200);
        ASSERT_EQ(reply.back(), 0xFC);
        ASSERT_LT(to_seconds(bench.now - before), 0.7);
    }
}

TEST(Imagenex831l, NoNoiseOnTheLineWedgesIt) {
    Bench bench = profiler();
    NoisyHost host;
    host.words = {to_hex(command()), to_hex(command({{range, 60}, {profile, 1}})),
                  to_hex(command({{tilt, 255}}))};
    // The first completes half a command that may wait.
    host.request = std::string(54, '0') + to_hex(command({{range, 4}}));
    host.is_answer = [](const Send& send) { return send.bytes.size() == 283 && send.bytes[7] == 4; };
    host.patience = 2s;
    host.quiet = 1s;
    expect_no_wedge(bench, host, 300);
}

}  // namespace
}  // namespace echoloop::test
