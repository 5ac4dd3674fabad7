// The pings and records of the 7k multibeam, by the offsets of the specification.
#include <cmath>

#include "tests/emulator/devices/reson7k_bench.h"

namespace echoloop::test {
namespace {

TEST(Reson7k, SaysNothingUnasked) {
    Reson sonar;
    EXPECT_TRUE(sonar.within(1s).empty());
    EXPECT_GT(sonar.shots.size(), 5U) << "but pings";
}

TEST(Reson7k, ASubscriptionGetsItsRecordsWithEveryPing) {
    Reson sonar;
    EXPECT_EQ(sonar.answer(control(1051, {3, 7027, 7000, 7610})), 0U);
    sonar.next(7027);
    const auto records = sonar.within(1s);
    ASSERT_GT(records.size(), 10U);
    for (std::size_t i = 1; i < records.size(); ++i) {
        EXPECT_EQ(records[i].type(), records[i - 1].type() == 7000 ? 7027U : 7000U);
        const std::size_t ping = 8;
        EXPECT_EQ(records[i].get<std::uint32_t>(ping) - records[i - 1].get<std::uint32_t>(ping),
                  records[i].type() == 7000 ? 1U : 0U);
    }
    EXPECT_EQ(sonar.answer(control(1056, {1, 7000})), 0U);
    for (const Seen& record : sonar.within(500ms)) EXPECT_EQ(record.type(), 7027U);
    EXPECT_EQ(sonar.answer(control(1052)), 0U);
    EXPECT_TRUE(sonar.within(500ms).empty());
}

TEST(Reson7k, ClosingTheConnectionEndsIt) {
    Reson sonar;
    EXPECT_EQ(sonar.answer(control(1055, {7000, 7030})), 0U);
    EXPECT_FALSE(sonar.within(500ms).empty());
    sonar.disconnect(0, {});
    EXPECT_TRUE(sonar.within(500ms).empty());
}

TEST(Reson7k, SettingsChangeTheNextPingAndStandInItsRecord) {
    Reson sonar;
    sonar.answer(control(1051, {1, 7000}));
    const struct {
        std::uint32_t command;
        double value;
        std::size_t offset;
    } rows[] = {{1003, 30, 54}, {1004, 8, 46}, {1005, 200, 58}, {1006, 1e-4, 26}, {1008, 41, 62}};
    for (const auto& row : rows) {
        EXPECT_EQ(sonar.answer(control(row.command, {f32(row.value)})), 0U) << row.command;
        sonar.next(7000);
        EXPECT_FLOAT_EQ(sonar.next(7000).get<float>(row.offset), static_cast<float>(row.value));
    }
    const Shot& shot = sonar.shots.back();
    EXPECT_DOUBLE_EQ(shot.source_level, 200);
    EXPECT_NEAR(shot.pulse_length, 1e-4, 1e-9);
    EXPECT_NEAR(static_cast<double>(shot.bins) * shot.bin_interval, 2 * 30 / 1500.0, 1e-4);
    const Seen settings = sonar.next(7000);
    EXPECT_EQ(settings.bytes.size(), 64U + 156 + 4);
    EXPECT_NEAR(settings.get<float>(50), 1.0 / 8, 1e-6) << "period";
    EXPECT_FLOAT_EQ(settings.get<float>(14), 400e3F);
    EXPECT_FLOAT_EQ(settings.get<float>(146), 1500);
}

TEST(Reson7k, RemoteSettingsHaveFieldsOfTheirOwnBehindTheReceiveFlags) {
    Reson sonar;
    sonar.answer(control(1051, {1, 7503}));
    EXPECT_EQ(sonar.answer(control(1010, {f32(3), f32(31), f32(4), f32(42), f32(0.25)})), 0U);
    sonar.next(7503);
    const Seen record = sonar.next(7503);
    ASSERT_EQ(record.bytes.size(), 64U + 260 + 4);
    EXPECT_GT(record.get<std::uint32_t>(8), 0U) << "ping";
    const float expected[] = {3, 31, 4, 42, 110, 1500, 30};  // filter; absorption, sound speed, spreading
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(record.get<float>(120 + 4 * i), expected[i]) << i;
    EXPECT_EQ(record.get<std::uint8_t>(148), 0U) << "vernier mode";
    EXPECT_EQ(record.get<std::uint32_t>(174), 1U) << "pings";
    EXPECT_EQ(record.get<std::uint16_t>(178), 1U) << "equi-angle";
    EXPECT_EQ(record.get<std::uint16_t>(222), 256U) << "beams";
    EXPECT_NEAR(record.get<float>(224), 140 * M_PI / 180, 1e-6) << "coverage";
    EXPECT_EQ(record.get<float>(248), 0.25F) << "tilt of the depth gate";
    EXPECT_EQ(record.get<float>(252), 400e3F) << "frequency";
    sonar.answer(control(1101));
    sonar.say(control(1050, {7503}));
    EXPECT_EQ(records_of(sonar.sent()).back().get<std::uint32_t>(174), 0U) << "stopped";
}

TEST(Reson7k, TheGainIsFixedOnlyWithoutTimeVariedGain) {
    const auto settings = [](bool tvg) {
        DeviceConfig config = make_config(*find_model("reson-7k"));
        config.effects.set(Effect::tvg, tvg);
        Bench sonar(find_model("reson-7k")->make(config));
        sonar.say(control(1051, {2, 7000, 7503}));
        sonar.sent();
        sonar.run_to(100ms);
        return records_of(sonar.sent());
    };
    const auto with = settings(true), without = settings(false);
    ASSERT_EQ(with.size(), 2U);
    ASSERT_EQ(without.size(), 2U);
    for (const std::size_t i : {0U, 1U}) {
        const std::size_t control_flags = i == 0 ? 66 : 64, absorption = i == 0 ? 142 : 136;
        EXPECT_EQ(with[i].get<std::uint32_t>(control_flags) >> 10 & 7, 0U) << "time-varied";
        EXPECT_EQ(with[i].get<float>(absorption), 110);
        EXPECT_EQ(with[i].get<float>(absorption + 8), 30) << "spreading";
        EXPECT_EQ(without[i].get<std::uint32_t>(control_flags) >> 10 & 7, 2U) << "fixed";
        EXPECT_EQ(without[i].get<float>(absorption), 0);
        EXPECT_EQ(without[i].get<float>(absorption + 8), 0);
    }
}

TEST(Reson7k, AnotherFrequencyNarrowsTheBeams) {
    Reson sonar;
    sonar.answer(control(1051, {3, 7000, 7503, 7004}));
    const float width = sonar.next(7000).get<float>(122);
    EXPECT_EQ(sonar.answer(control(1026, {f32(440e3)})), 0U);
    sonar.next(7000);
    const Seen settings = sonar.next(7000);
    EXPECT_EQ(settings.get<float>(14), 440e3F);
    EXPECT_NEAR(settings.get<float>(122), width / 1.1, 1e-6);
    EXPECT_EQ(sonar.next(7503).get<float>(12), 440e3F);
    EXPECT_NEAR(sonar.next(7004).get<float>(12 + 12 * 256), width / 1.1, 1e-6);
    const Shot &first = sonar.shots.front(), &last = sonar.shots.back();
    EXPECT_EQ(last.frequency, 440e3F);
    EXPECT_NEAR(last.beam_width, first.beam_width / 1.1, 1e-9);
    EXPECT_NEAR(last.fan_height, first.fan_height / 1.1, 1e-9);
    EXPECT_NEAR(last.receiver.directivity_index - first.receiver.directivity_index, 20 * std::log10(1.1),
                1e-9);
    EXPECT_EQ(sonar.answer(control(1026, {f32(200e3)})), 0x7001U);
    EXPECT_EQ(sonar.answer(control(1026)), 0x7008U);
}

/// w16 flags, f32 m/s, u8 filter, three bytes.
Bytes manual_speed(std::uint16_t flags, double speed, std::uint8_t filter = 0) {
    Bytes b(10);
    put(b, 0, flags, 2), put(b, 2, f32(speed)), put(b, 6, filter, 1);
    return control_of_bytes(7610, b);
}

TEST(Reson7k, AManualSoundSpeedIsWhatTheHeadReckonsWith) {
    Reson sonar;  // of the water: 1500
    sonar.answer(control(1051, {3, 7000, 7503, 7027}));
    EXPECT_EQ(sonar.answer(control(1010, {f32(8), f32(20), f32(0), f32(50), f32(0)})), 0U);
    EXPECT_EQ(sonar.answer(control(1009, {1U << 8})), 0U);
    sonar.next(7027);
    const Seen before = sonar.next(7027);
    ASSERT_EQ(before.get<std::uint32_t>(14), 256U) << "at 8.7 m";
    EXPECT_EQ(sonar.answer(manual_speed(1, 1350)), 0U);
    sonar.next(7000);
    EXPECT_EQ(sonar.next(7000).get<float>(146), 1350);
    EXPECT_EQ(sonar.next(7503).get<float>(140), 1350);
    const Shot& shot = sonar.shots.back();
    EXPECT_NEAR(static_cast<double>(shot.bins) * shot.bin_interval, 2 * 50 / 1350.0, 1e-4)
        << "it waits longer";
    const Seen slower = sonar.next(7027);
    ASSERT_EQ(slower.get<std::uint32_t>(14), 0U) << "the same echo is 7.8 m away";
    EXPECT_EQ(sonar.answer(control(1009, {0})), 0U);
    sonar.next(7027);
    const Seen after = sonar.next(7027);
    ASSERT_EQ(after.get<std::uint32_t>(14), 256U);
    EXPECT_EQ(after.get<float>(99 + 2), before.get<float>(99 + 2)) << "times are times";
    EXPECT_EQ(sonar.answer(manual_speed(2, 1)), 0U) << "settings only";
    EXPECT_EQ(sonar.answer(manual_speed(6, 0, 4)), 0U) << "a filter";
    sonar.next(7000);
    EXPECT_EQ(sonar.next(7000).get<float>(146), 1350);
    EXPECT_EQ(sonar.answer(manual_speed(4, 1450, 9)), 0x7001U) << "no such filter";
    EXPECT_EQ(sonar.answer(manual_speed(0, 900)), 0x7001U);
    EXPECT_EQ(sonar.answer(control(7610, {0, 0})), 0x7008U) << "too short";
}

TEST(Reson7k, PingsComeAtTheRateOrAsFastAsSoundGoes) {
    Reson sonar;
    const auto pings_in_10_s = [&](double range, double rate) {
        sonar.answer(control(1003, {f32(range)}));
        sonar.answer(control(1004, {f32(rate)}));
        sonar.run_to(sonar.now + 1s);
        sonar.shots.clear();
        sonar.run_to(sonar.now + 10s);
        return static_cast<double>(sonar.shots.size());
    };
    EXPECT_NEAR(pings_in_10_s(20, 5), 50, 1);
    EXPECT_NEAR(pings_in_10_s(75, 50), 10 / 0.105, 1) << "2R/c + 5 ms";
    EXPECT_EQ(sonar.answer(control(1101)), 0U);
    sonar.run_to(sonar.now + 1s);
    sonar.shots.clear();
    sonar.run_to(sonar.now + 1s);
    EXPECT_TRUE(sonar.shots.empty());
    EXPECT_EQ(sonar.answer(control(1100)), 0U);
    sonar.run_to(sonar.now + 1s);
    EXPECT_FALSE(sonar.shots.empty());
}

TEST(Reson7k, DetectionsTellTheTwoWayTimeInSamples) {
    Reson sonar;
    sonar.answer(control(1051, {1, 7027}));
    const Seen record = sonar.next(7027);
    const auto points = record.get<std::uint32_t>(14), size = record.get<std::uint32_t>(18);
    ASSERT_EQ(points, 256U);
    ASSERT_EQ(size, 34U);
    EXPECT_EQ(record.bytes.size(), 64U + 99 + points * 34 + 4);
    EXPECT_FLOAT_EQ(record.get<float>(27), 34500);
    for (std::uint32_t i = 0; i < points; ++i) {
        const std::size_t p = 99 + 34 * i;
        EXPECT_EQ(record.get<std::uint16_t>(p), i);
        // An echo of one bin; the detection takes off what the pulse and the receiver add, about 0.7 of 60
        // us.
        EXPECT_NEAR(record.get<float>(p + 2), 400.5, 2.5);
        const double angle = (-70 + 140.0 * i / 255) * M_PI / 180;
        EXPECT_NEAR(record.get<float>(p + 6), angle, 1e-6);
        EXPECT_EQ(record.get<std::uint32_t>(p + 10) >> 2 & 0x7F, 1U) << "quality type";
    }
}

TEST(Reson7k, TheFilterExcludesWhatLiesOutside) {
    Reson sonar;  // the echo is at 400.5 / 34500 s, 8.7 m
    sonar.answer(control(1051, {1, 7027}));
    EXPECT_EQ(sonar.answer(control(1010, {f32(10), f32(20), f32(0), f32(50), f32(0)})), 0U);
    EXPECT_EQ(sonar.answer(control(1009, {1U << 8})), 0U);
    sonar.next(7027);
    EXPECT_EQ(sonar.next(7027).get<std::uint32_t>(14), 0U);
    EXPECT_EQ(sonar.answer(control(1009, {0})), 0U);
    sonar.next(7027);
    EXPECT_EQ(sonar.next(7027).get<std::uint32_t>(14), 256U);
}

TEST(Reson7k, TheDepthFilterIsALayerThatItsTiltTurns) {
    Reson sonar;  // echoes at 8.7 m of slant range all around: 8.7 m x cos(angle) deep
    sonar.answer(control(1051, {1, 7027}));
    const auto found = [&](double least, double most, double tilt) {
        EXPECT_EQ(sonar.answer(control(1010, {f32(0), f32(50), f32(least), f32(most), f32(tilt)})), 0U);
        EXPECT_EQ(sonar.answer(control(1009, {1U << 9})), 0U);
        sonar.next(7027);
        const Seen record = sonar.next(7027);
        std::pair<double, double> outer{1e3, -1e3};
        for (std::uint32_t i = 0; i < record.get<std::uint32_t>(14); ++i) {
            const double angle = record.get<float>(99 + 34 * i + 6) * 180 / M_PI;
            outer = {std::min(outer.first, angle), std::max(outer.second, angle)};
        }
        return outer;
    };
    const double edge = std::acos(6 / 8.705) * 180 / M_PI;  // where they lie 6 m deep
    const auto level = found(6, 20, 0), tilted = found(6, 20, 0.2);
    EXPECT_NEAR(level.first, -edge, 1.2);
    EXPECT_NEAR(level.second, edge, 1.2);
    // A plane 6 m below that is shallower to starboard by 0.2 rad lies at 6 cos(0.2) / cos(angle - 0.2).
    const double lean = 0.2 * 180 / M_PI, half = std::acos(6 * std::cos(0.2) / 8.705) * 180 / M_PI;
    EXPECT_NEAR(tilted.first, lean - half, 1.2);
    EXPECT_NEAR(tilted.second, lean + half, 1.2);
}

TEST(Reson7k, AReceiveBeamIsWideAlongTheTrackTheProjectorNarrow) {
    Reson sonar;
    sonar.answer(control(1051, {2, 7000, 7004}));
    EXPECT_NEAR(sonar.next(7000).get<float>(82), M_PI / 180, 1e-6) << "projector";
    const Seen geometry = sonar.next(7004);
    EXPECT_NEAR(geometry.get<float>(12 + 8 * 256), 0.471238898, 1e-6);
    EXPECT_NEAR(geometry.get<float>(12 + 12 * 256), 0.5 * M_PI / 180, 1e-6) << "across";
}

TEST(Reson7k, ARateOfZeroStopsPingsUntilThereIsAnother) {
    Reson sonar;
    const Address host{0x7F000001, 40000};
    ASSERT_EQ(sonar.answer(control(1051, {1, 7000}), 1, host), 0U);
    sonar.next(7000);
    EXPECT_EQ(sonar.answer(control(1004, {f32(0)})), 0U);
    sonar.run_to(sonar.now + 1s);
    sonar.shots.clear();
    EXPECT_EQ(sonar.answer(control(1100)), 0U);
    EXPECT_EQ(sonar.answer(control(1003, {f32(30)})), 0U);
    sonar.run_to(sonar.now + 20s);
    EXPECT_TRUE(sonar.shots.empty());
    EXPECT_EQ(sonar.answer(control(1004, {f32(10)})), 0U);
    sonar.run_to(sonar.now + 1s);
    EXPECT_NEAR(static_cast<double>(sonar.shots.size()), 10, 1);
    for (const double rate : {-1.0, 1e-30, 1e9})
        EXPECT_EQ(sonar.answer(control(1004, {f32(rate)})), 0x7001U) << rate;
}

TEST(Reson7k, TheFirstPingTellsThePeriodOfTheNext) {
    Reson sonar(Options{{"pinging", false}, {"max_ping_rate", 8.0}});
    sonar.answer(control(1051, {1, 7000}));
    sonar.say(control(1050, {7503}));
    EXPECT_NEAR(records_of(sonar.sent()).back().get<float>(48), 1.0 / 8, 1e-6) << "before any ping";
    sonar.answer(control(1100));
    const Seen first = sonar.next(7000);
    EXPECT_EQ(first.get<std::uint32_t>(8), 1U);
    EXPECT_NEAR(first.get<float>(50), 1.0 / 8, 1e-6);
}

}  // namespace
}  // namespace echoloop::test
