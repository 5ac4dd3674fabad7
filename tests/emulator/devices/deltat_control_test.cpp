// External control of a Delta T: what each byte of an EC does to the next ping, its pace and its 83P.
#include <functional>

#include "tests/emulator/devices/deltat_bench.h"
#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
namespace {

/// The shot of the first ping after an EC.
Shot shot_after(const std::map<std::size_t, std::uint8_t>& changes) {
    Bench bench = delta_t();
    bench.say(control(changes));
    next_83p(bench);
    while (!bench.ping) bench.run_to(bench.now + 1ms);
    return bench.ping->shot;
}

TEST(DeltaTControl, RangesAreThoseOfTheTable) {
    const unsigned metres[] = {5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 250, 300};
    Bench bench = delta_t();
    for (std::uint8_t code = 2; code <= 14; ++code) {
        const Bytes b = answer(bench, control({{7, code}}));
        EXPECT_EQ(be(b, 79), metres[code - 2]);
        EXPECT_EQ(be(b, 85), metres[code - 2] / 5);
        const double needed = metres[code - 2] / 0.75 + 10;
        EXPECT_NEAR(be(b, 91), std::max(50.0, needed), 0.51);
    }
    for (const std::uint8_t none : Bytes{0, 1, 15, 255})
        EXPECT_EQ(be(answer(bench, control({{7, none}})), 79), 300U) << int{none};
}

TEST(DeltaTControl, TheRangeChangesTheWindowAndThePulse) {
    const Shot near = shot_after({{7, 2}}), far = shot_after({{7, 10}});
    EXPECT_NEAR(near.pulse_length, 30e-6, 1e-12);
    EXPECT_NEAR(far.pulse_length, 600e-6, 1e-12);
    const auto window = [](const Shot& s) { return static_cast<double>(s.bins) * s.bin_interval; };
    EXPECT_NEAR(window(near), 2 * 5 / 1500.0, 0.1e-3);
    EXPECT_NEAR(window(far), 2 * 100 / 1500.0, 2e-3);
}

TEST(DeltaTControl, SectorAndBeamsMakeTheFanThatIsTold) {
    const unsigned sectors[] = {30, 60, 90, 120}, counts[] = {480, 240, 120};
    for (std::uint8_t sector = 0; sector < 4; ++sector)
        for (std::uint8_t beams = 0; beams < 3; ++beams) {
            Bench bench = delta_t();
            const Bytes b = answer(bench, control({{11, sector}, {13, beams}}));
            ASSERT_EQ(be(b, 70), counts[beams]);
            ASSERT_EQ(b.size(), 256U + 4 * counts[beams]);
            EXPECT_EQ(be(b, 74), sectors[sector]);
            const Shot shot = bench.shots.back();
            ASSERT_EQ(shot.bearings.size(), counts[beams]);
            for (std::size_t n = 0; n < counts[beams]; ++n)
                ASSERT_NEAR(shot.bearings[n], angle_of(b, n), 1e-9) << "a beam is where the header says";
            const double width = rad_to_deg(shot.bearings.back() - shot.bearings.front());
            EXPECT_LE(width, sectors[sector]);
            EXPECT_GT(width, 0.93 * sectors[sector]) << "but for what hundredths of a degree cannot say";
            const double middle = rad_to_deg(shot.bearings.back() + shot.bearings.front()) / 2;
            EXPECT_NEAR(middle, 0, 0.51);
        }
}

TEST(DeltaTControl, BeamWidthGainAndReceiveOnlyChangeTheShot) {
    EXPECT_NEAR(shot_after({{12, 0}}).beam_width, deg_to_rad(3), 1e-9);
    EXPECT_NEAR(shot_after({{12, 1}}).beam_width, deg_to_rad(1.5), 1e-9);
    EXPECT_NEAR(shot_after({{12, 2}}).beam_width, deg_to_rad(0.75), 1e-9);
    const double low = shot_after({{8, 0}}).receiver.saturation_level;
    EXPECT_NEAR(low - shot_after({{8, 20}}).receiver.saturation_level, 20, 1e-9);
    EXPECT_GT(shot_after({}).source_level, 180);
    EXPECT_LT(shot_after({{4, 1}}).source_level, -200);
}

TEST(DeltaTControl, GainRaisesTheIntensityByItsDecibels) {
    const auto intensity = [](std::uint8_t gain) {
        Bench bench = delta_t();
        bench.echo_bin = 400;
        bench.echo_power = 1e13F;
        const Bytes b = answer(bench, control({{8, gain}}));
        return static_cast<double>(be(b, 256 + 2 * 240 + 2 * 120));
    };
    const double at0 = intensity(0);
    EXPECT_GT(at0, 100);
    EXPECT_NEAR(intensity(6) / at0, std::pow(10, 6 / 20.0), 0.02);
}

TEST(DeltaTControl, SoundSpeedIsToldInEitherOrder) {
    const auto told = [](const char* order, std::uint8_t high, std::uint8_t low) {
        Bench bench = delta_t({{"ec_sound_speed", std::string(order)}});
        return be(answer(bench, control({{17, high}, {18, low}})), 83) & 0x7FFF;
    };
    EXPECT_EQ(told("auto", 0x39, 0xD0), 14800U);
    EXPECT_EQ(told("auto", 0xD0, 0x39), 14800U) << "a PC's order";
    EXPECT_EQ(told("big", 0x39, 0xD0), 14800U);
    EXPECT_EQ(told("big", 0xD0, 0x39), 15000U) << "no sound speed: nothing changes";
    EXPECT_EQ(told("little", 0xD0, 0x39), 14800U);
    EXPECT_EQ(told("little", 0x39, 0xD0), 15000U);
    EXPECT_EQ(told("auto", 0, 0), 15000U);
}

TEST(DeltaTControl, SoundSpeedMovesNoRangeSinceTheyHoldAt1500) {
    const auto range = [](std::uint8_t high, std::uint8_t low) {
        Bench bench = delta_t();
        bench.echo_bin = 400;
        bench.echo_power = 1e13F;
        return range_of(answer(bench, control({{17, high}, {18, low}})), 120);
    };
    EXPECT_EQ(range(0x39, 0xD0), range(0x3A, 0x98));
    EXPECT_NEAR(range(0x3A, 0x98), 8, 0.1);
}

TEST(DeltaTControl, MinimumRangeGatesTheBottom) {
    const auto range = [](std::uint8_t least) {
        Bench bench = delta_t();
        bench.echo_bin = 400;  // 8 m of 20
        bench.echo_power = 1e13F;
        return range_of(answer(bench, control({{22, least}})), 120);
    };
    EXPECT_NEAR(range(7), 8, 0.1);
    EXPECT_EQ(range(9), 0);
}

/// Seconds of the minute that an 83P tells, with its milliseconds.
double second_of(const Bytes& b) {
    return std::stod(text_at(b, 26, 2)) + std::stod("0" + text_at(b, 112, 4));
}

TEST(DeltaTControl, AveragingMakesOne83POfSeveralPings) {
    Bench bench = delta_t();
    Bytes b = answer(bench, control({{14, 5}}));
    EXPECT_EQ(b[125], 5);
    EXPECT_EQ(be(b, 126), 1000U) << "two periods of 50 ms, in 100 us";
    const Time before = bench.now;
    const unsigned number = be(b, 93, 4);
    const double told = second_of(b);
    b = next_83p(bench);
    EXPECT_NEAR(second_of(b) - told, 0.25, 2e-3);
    const double last = to_seconds(bench.now) - 0.1e-3 * be(b, 120);
    EXPECT_NEAR(second_of(b), last, 3e-3) << "the last transmission; the offset leads back to the middle";
    EXPECT_NEAR(to_seconds(bench.now - before), 0.25, 2e-3);
    EXPECT_EQ(be(b, 93, 4), number + 5);
    b = answer(bench, control({{14, 1}}));
    EXPECT_EQ(b[125], 0);
}

TEST(DeltaTControl, TheMeanIsThatOfThePings) {
    Bench bench = delta_t();
    bench.echo_bin = 400;
    bench.echo_power = 1e13F;
    const auto intensity = [](const Bytes& b) { return static_cast<double>(be(b, 256 + 2 * 240 + 2 * 120)); };
    const double steady = intensity(answer(bench, control({{14, 2}})));
    for (int i = 0; i < 4; ++i) {
        bench.echo_power = i % 2 == 0 ? 2e13F : 0;
        while (!bench.ping) bench.run_to(bench.now + 1ms);
        bench.hear();
    }
    EXPECT_NEAR(intensity(bench.sent().back().bytes) / steady, 1, 0.01) << "of power, not of amplitude";
}

/// The 83Ps of 3 pings each that 39 pings make, with a host that says something else behind every ping.
std::vector<Bytes> averages(const std::function<Bytes(int)>& word) {
    Bench bench = delta_t();
    bench.echo_bin = 400;  // 8 m of 20
    bench.echo_power = 1e13F;
    answer(bench, control({{14, 3}}));
    std::vector<Bytes> found;
    for (int i = 0; i < 39; ++i) {
        const std::size_t heard = bench.shots.size();
        while (bench.shots.size() == heard) bench.run_to(bench.now + 1ms);
        for (const Send& send : bench.sent()) found.push_back(send.bytes);
        bench.say(word(i));
    }
    return found;
}

TEST(DeltaTControl, WhatIsToldOnlyStopsNoAverage) {
    const auto code = [](int value) { return static_cast<std::uint8_t>(value); };
    const auto told = averages([&code](int i) {
        return control({{14, 3}, {18, code(0x98 + i % 8)}, {22, code(i % 2)}, {25, code(180 + i % 5)}});
    });
    EXPECT_NEAR(static_cast<double>(told.size()), 13, 1);
    for (const Bytes& b : told) {
        EXPECT_EQ(b[125], 3);
        EXPECT_NEAR(range_of(b, 120), 8, 0.1);
    }
    EXPECT_NE(be(told.at(0), 83), be(told.at(1), 83)) << "the sound speed is told as it is";
    const auto louder = averages([&code](int i) { return control({{14, 3}, {8, code(i % 2)}}); });
    EXPECT_TRUE(louder.empty()) << "pings of two gains make no mean";
}

TEST(DeltaTControl, RollCompensationKeepsTheFanOverTheBottom) {
    Bench bench = delta_t();
    bench.say(control({{26, 1}}));
    const auto rolled = [&] {
        while (!bench.ping) bench.run_to(bench.now + 1ms);
        const Ping ping = *bench.ping;
        Echogram echogram = echo_of(ping.shot, 0, 0);
        const Quat body = from_rpy(deg_to_rad(10), 0, 0);  // port side up: the axis looks to port of down
        echogram.world_from_sonar.orientation = body * from_rpy(0, deg_to_rad(90), 0);
        bench.ping.reset();
        bench.now = ping.due;
        const Actions actions = bench.device().heard(echogram, ping.due);
        bench.wake = actions.wake.value();
        return std::pair(ping.shot, actions.send.at(0).bytes);
    };
    rolled();
    const auto [shot, b] = rolled();
    EXPECT_EQ(b[123] & 1, 1);
    EXPECT_EQ(be(b, 76), 12000U) << "angles are from straight down";
    // Straight down is the direction whose world z is least.
    const Quat head = from_rpy(deg_to_rad(10), 0, 0) * from_rpy(0, deg_to_rad(90), 0);
    const double at = shot.bearings[120];
    EXPECT_NEAR(rotate(head, {std::cos(at), -std::sin(at), 0}).z, -1, 1e-9);
}

TEST(DeltaTControl, LocalControlBringsTheProgramsOwnSettingsBack) {
    Bench bench = delta_t();
    EXPECT_EQ(be(answer(bench, control({{7, 8}, {25, 200}})), 79), 60U);
    const Bytes b = answer(bench, control({{3, 0}, {7, 8}}));
    EXPECT_EQ(be(b, 79), 20U);
    EXPECT_EQ(be(b, 89), 180U);
}

TEST(DeltaTControl, ThePingUnderWayIsToldAsItWentOut) {
    Bench bench = delta_t();
    next_83p(bench);
    while (!bench.ping) bench.run_to(bench.now + 1ms);
    bench.say(control({{7, 6}, {13, 2}}));
    const Bytes b = next_83p(bench);
    EXPECT_EQ(be(b, 79), 20U);
    EXPECT_EQ(be(b, 70), 240U);
    EXPECT_EQ(be(next_83p(bench), 79), 40U);
}

TEST(DeltaTControl, OtherDatagramsAreCountedAndChangeNothing) {
    Bench bench = delta_t();
    Bytes cut = control({{7, 8}});
    cut.pop_back();
    Bytes other = control({{7, 8}});
    other[1] = 'D';
    for (const Bytes& word : {cut, other, Bytes{}, next_83p(bench)})
        EXPECT_EQ(be(answer(bench, word), 79), 20U);
    EXPECT_EQ(bench.device().counters().rejected, 4U);
    EXPECT_EQ(bench.device().counters().messages, 0U);
}

TEST(DeltaTControl, ANoisyLineWedgesNothing) {
    Bench bench = delta_t();
    NoisyHost host;
    for (const std::uint8_t code : Bytes{2, 4, 6})
        host.words.push_back(to_hex(control({{7, code}, {14, 2}, {13, code}})));
    host.request = to_hex(control({{7, 3}, {11, 1}}));
    host.is_answer = [](const Send& send) {
        return be(send.bytes, 79) == 10 && be(send.bytes, 74) == 60 && be(send.bytes, 70) == 240;
    };
    host.patience = 1s;
    expect_no_wedge(bench, host, 100);
}

}  // namespace
}  // namespace echoloop::test
