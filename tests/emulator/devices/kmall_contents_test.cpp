// What an #MRZ tells beside the places of its soundings, against figures of an EM 2040P's and an EM 2042's
// datagrams; sound speed texts, and parts.
#include <array>
#include <cmath>
#include <set>

#include "protocols/kmall/codec.h"
#include "tests/emulator/devices/kmall_bench.h"

namespace echoloop::test {
namespace {

/// The first #MRZ of a floor 8 m below with speckle, and what followed.
std::vector<Send> over_floor(const Options& changes = {}, const std::vector<std::string>& texts = {}) {
    Bench bench = sounder(changes);
    bench.run_to(0ns);
    Echogram echo = bottom_echo(bench.ping->shot, flat(8), {});
    echo.world_from_sonar = {{0, 0, -12}, from_rpy(0, deg_to_rad(90), 0)};
    bench.hear(echo);
    for (const auto& said : texts) bench.say(text(said));
    return bench.sent();
}

struct Column {
    double least, most;
    std::size_t distinct;
};
Column column(const Bytes& b, std::size_t offset) {
    std::set<float> values;
    for (std::size_t n = 0; n < 400; ++n)
        if (b[first + n * 120 + 3] == 0) values.insert(f32(b, first + n * 120 + offset));
    return {*values.begin(), *values.rbegin(), values.size()};
}

TEST(KmallContents, QualitiesAndUncertaintiesVaryAsRealOnesDo) {
    const Bytes b = over_floor().at(0).bytes;
    const Column quality = column(b, 16);
    EXPECT_GT(quality.distinct, 100U);
    EXPECT_GE(quality.least, 0.04);
    EXPECT_LE(quality.most, 0.46);
    for (std::size_t n = 0; n < 400; ++n) {
        const std::size_t s = first + n * 120;
        if (b[s + 3] != 0) continue;
        const double q = f32(b, s + 16) / 100, range = f32(b, s + 80) * 750,
                     angle = deg_to_rad(f32(b, s + 40));
        EXPECT_NEAR(f32(b, s + 20), q * range * std::cos(angle), 1e-5) << "exact in the 2040P";
        EXPECT_NEAR(f32(b, s + 24), std::hypot(q * range * std::sin(angle), 0.078), 1e-5);
        EXPECT_EQ(b[s + 5], 0) << "rejection info 1";
        EXPECT_EQ(b[s + 6], b[s + 4] == 2 ? 99 : 88) << "rejection info 2";
        EXPECT_EQ(b[s + 9], 12) << "confidence";
    }
}

/// x and y offset of a head whose water line lies so far below it, m, turned so, above a bottom or with
/// nothing to hear.
std::array<float, 2> offsets(double water_line, double roll_deg, double pitch_deg, bool bottom = true) {
    Bench bench = sounder();
    bench.run_to(0ns);
    const Shot& shot = bench.ping->shot;
    Echogram echo = bottom ? bottom_echo(shot, flat(8), {}) : echo_of(shot, 0, 0);
    const Quat vessel = from_rpy(deg_to_rad(roll_deg), -deg_to_rad(pitch_deg), 0);
    echo.world_from_sonar = {{0, 0, water_line}, vessel * from_rpy(0, deg_to_rad(90), 0)};
    bench.hear(echo);
    const Bytes b = bench.sent().at(0).bytes;
    return {f32(b, ping + 112), f32(b, ping + 116)};
}

// What two of 25 pings of an EM 2040P say whose water line lies 0.33 m below its reference point, at the roll
// (port up) and the pitch (bow up) of its motion sensor.
TEST(KmallContents, TheWaterLinesOffsetTurnsWithTheVessel) {
    const auto first_ping = offsets(0.33, 4.684, 1.018), later = offsets(0.33, 3.051, 1.124);
    EXPECT_NEAR(first_ping[0], 0.00584, 3e-5);
    EXPECT_NEAR(first_ping[1], -0.02695, 3e-5);
    EXPECT_NEAR(later[0], 0.00646, 3e-5);
    EXPECT_NEAR(later[1], -0.01757, 3e-5);
    EXPECT_NEAR(offsets(-12, 0, 1)[0], -0.2094, 1e-4);
    EXPECT_EQ(offsets(0.33, 4.684, 1.018, false), (std::array<float, 2>{0, 0})) << "no valid sounding";
}

// 25 pings of an EM 2040: source levels from 198.9755 to 198.9788 dB, absorption from 90.598 to 90.604 dB/km.
TEST(KmallContents, EachPingTellsItsSourceLevelAndAbsorptionAnew) {
    const Model& model = *find_model("kongsberg-kmall");
    DeviceConfig config = make_config(model);
    config.effects.set(Effect::sensor_noise);
    Bench bench(model.make(config));
    bench.run_to(0ns);
    std::set<float> levels, absorptions;
    for (int n = 0; n < 25; ++n) {
        while (!bench.ping) bench.run_to(bench.wake);
        Echogram echo = bottom_echo(bench.ping->shot, flat(8), {});
        echo.world_from_sonar = {{0, 0, -12}, from_rpy(0, deg_to_rad(90), 0)};
        bench.hear(echo);
        for (const Send& send : of_type(bench.sent(), "#MRZ")) {
            levels.insert(f32(send.bytes, first + 60));
            absorptions.insert(f32(send.bytes, first + 44));
            EXPECT_EQ(f32(send.bytes, first + 60), f32(send.bytes, ping + 152 + 12)) << "that of its sector";
        }
    }
    EXPECT_GT(levels.size(), 10U);
    EXPECT_LT(*levels.rbegin() - *levels.begin(), 0.01);
    EXPECT_GT(absorptions.size(), 10U);
    EXPECT_LT(*absorptions.rbegin() - *absorptions.begin(), 0.02);
}

TEST(KmallContents, ReflectivitiesDifferAndHaveTheirMeans) {
    const Bytes b = over_floor().at(0).bytes;
    EXPECT_GT(column(b, 48).distinct, 100U);
    for (std::size_t n = 0; n < 400; ++n) {
        const std::size_t s = first + n * 120;
        if (b[s + 3] != 0) continue;
        const double apart = f32(b, s + 52) - f32(b, s + 48);
        EXPECT_GE(apart, 13.7);
        EXPECT_LE(apart, 34.1) << "34 dB at the nadir of an EM 2040P";
        EXPECT_GE(f32(b, s + 56), -210) << "sensitivity";
        EXPECT_LE(f32(b, s + 56), -184);
    }
    EXPECT_NE(f32(b, rx + 16), 0) << "BS normal";
    EXPECT_NE(f32(b, rx + 20), 0) << "BS oblique";
    EXPECT_EQ(f32(b, rx + 8), f32(b, rx + 12)) << "rates of water column and seabed image";
    const std::size_t sector = ping + 152;
    EXPECT_NEAR(f32(b, sector + 16), 8, 0.1) << "focus range";
}

TEST(KmallContents, TheSeabedImageLiesAroundEachSoundingWithItsReflectivity) {
    const Bytes b = over_floor().at(0).bytes;
    const double rate = f32(b, rx + 12);
    std::size_t at = first + 400 * 120;
    for (std::size_t n = 0; n < 400; ++n) {
        const std::size_t s = first + n * 120, count = u16(b, s + 118);
        if (b[s + 3] == 0) {
            ASSERT_GE(count, 3U);
            ASSERT_LE(count, 37U);
            EXPECT_NEAR(u16(b, s + 114) + u16(b, s + 116), f32(b, s + 80) * rate + 0.2e-3 * rate, 1.6) << n;
            double sum = 0;
            for (std::size_t i = 0; i < count; ++i)
                sum += std::pow(10, test::at<std::int16_t>(b, at + 2 * i) / 100.0);
            EXPECT_NEAR(10 * std::log10(sum / static_cast<double>(count)), f32(b, s + 48), 0.2) << n;
        }
        at += 2 * count;
    }
    EXPECT_EQ(at + 4, b.size());
    const Bytes bare = over_floor({{"seabed_image", false}}).at(0).bytes;
    EXPECT_EQ(bare.size(), first + 400 * 120 + 4);
}

/// Where the classes of extra detections, 7 and the rest, and the extra detections stand.
constexpr std::size_t class_size = 4, classes = first, extras = first + 8 * class_size + 400 * 120;

/// An #MRZ of a floor 8 m below, in whose beams from `from` on, as many as `beams`, something stands at
/// `share` of the floor's time.
struct Thing {
    std::size_t from, beams;
    double share;
};
Bytes over_things(const std::vector<Thing>& things) {
    Bench bench = sounder({{"extra_detections", std::int64_t{90}}});
    bench.run_to(0ns);
    Echogram echo = bottom_echo(bench.ping->shot, flat(8), {.noise = 1e4, .echo = 1e11});
    echo.world_from_sonar = {{0, 0, -12}, from_rpy(0, deg_to_rad(90), 0)};
    const Shot& shot = echo.shot;
    for (const Thing& thing : things)
        for (std::size_t n = thing.from; n < thing.from + thing.beams; ++n) {
            const double floor = 2 * 8 / std::cos(shot.bearings[n]) / 1500;
            const auto bin = static_cast<std::size_t>(thing.share * floor / shot.bin_interval);
            const auto beam = std::span(echo.values).subspan(n * shot.bins, shot.bins);
            const float loudest = *std::ranges::max_element(beam);
            for (std::size_t i = 0; i < 4; ++i) beam[bin + i] = loudest;
        }
    bench.hear(echo);
    return bench.sent().at(0).bytes;
}

// 2384 extra detections of an EM 2040P: classes by the range in % of the bottom's (60 to 90, 90 to 100, ...),
// one more for the rest; five of a class ring its alarm. Rejected ones have no method and no quality.
TEST(KmallContents, ExtraDetectionsHaveTheClassesOfTheirRanges) {
    const Bytes b = over_things({{100, 6, 0.5}, {200, 3, 0.75}, {300, 1, 0.75}});
    const std::size_t extra = u16(b, rx + 26);
    EXPECT_EQ(u16(b, rx + 2), 400);
    EXPECT_EQ(u16(b, rx + 28), 8) << "classes";
    ASSERT_GT(extra, 10U);
    EXPECT_LE(extra, 90U);
    EXPECT_EQ(u16(b, classes + 2 * class_size), 6) << "30 to 60 %";
    EXPECT_EQ(u16(b, classes + 3 * class_size), 3) << "60 to 90 %: the one that stands alone is rejected";
    EXPECT_EQ(u16(b, classes + 7 * class_size), extra - 9);
    EXPECT_EQ(b[classes + 2 * class_size + 3], 1) << "its alarm";
    EXPECT_EQ(b[classes + 3 * class_size + 3], 0);
    EXPECT_EQ(u16(b, rx + 24), 2) << "classes with an alarm, the rest among them";
    std::size_t alone = 0;
    for (std::size_t n = 0; n < extra; ++n) {
        const std::size_t s = extras + n * 120;
        EXPECT_EQ(u16(b, s), 400 + n);
        const float factor = f32(b, s + 12);
        if (b[s + 3] == 1) {
            EXPECT_EQ(b[s + 6], 80);
            EXPECT_EQ(b[s + 4], 1) << "method";
            EXPECT_EQ(b[s + 8], factor < 60 ? 102 : 103);
            EXPECT_NEAR(factor, factor < 60 ? 50 : 75, 1);
            EXPECT_GE(b[s + 9], 10) << "confidence";
        } else {
            EXPECT_EQ(b[s + 3], 2);
            EXPECT_EQ(b[s + 8], 107);
            EXPECT_TRUE(b[s + 4] == 0 && f32(b, s + 16) == 0 && f32(b, s + 48) == -100);
            alone += b[s + 6] == 12 && u16(b, s + 36) == 300;
        }
    }
    EXPECT_EQ(alone, 1U);
}

TEST(KmallContents, TheRuntimeParametersHaveTheTableOfClasses) {
    for (const std::int64_t most : {0, 90}) {
        const auto sent = of_type(over_floor({{"extra_detections", most}}, {"$KSSIS,454,2040"}), "#IOP");
        ASSERT_EQ(sent.size(), 1U);
        const std::string said(sent[0].bytes.begin(), sent[0].bytes.end());
        EXPECT_NE(said.find(most > 0 ? "Extra detection: On" : "Extra detection: Off"), said.npos);
        const bool row = said.find("7  Off   110.0   200.0   1.0   -60.0   10.0   5\n") != said.npos;
        EXPECT_EQ(row, most > 0) << "as an EM 2040P's";
    }
}

TEST(KmallContents, WithoutExtraDetectionsThereAreNoClasses) {
    const Bytes b = over_floor().at(0).bytes;
    EXPECT_EQ(u16(b, rx + 28), 0);
    EXPECT_EQ(u16(b, rx + 24), 1) << "alarm, as in 60 of 60 real ones";
}

TEST(KmallContents, ALongOneIsSplit) {
    const auto sent = of_type(over_floor({{"largest_part", std::int64_t{20000}}}), "#MRZ");
    ASSERT_GE(sent.size(), 3U);
    Bytes whole;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        EXPECT_EQ(u16(sent[i].bytes, 20), sent.size());
        EXPECT_EQ(u16(sent[i].bytes, 22), i + 1);
        EXPECT_EQ(kmall::join(whole, sent[i].bytes), i + 1 == sent.size());
    }
    EXPECT_TRUE(kmall::parse(whole));
}

TEST(KmallContents, ALongOneIsNotParted) {
    Time before{};
    const auto sent = over_floor({{"largest_part", std::int64_t{20000}}, {"water_column", true}});
    for (const Send& send : sent) {
        EXPECT_GE(send.not_before, before) << "the water column comes behind the soundings";
        before = send.not_before;
    }
    EXPECT_GT(of_type(sent, "#MWC").size(), 3U);
    EXPECT_GT(of_type(sent, "#MWC").front().not_before, of_type(sent, "#MRZ").back().not_before);
}

const std::string profile =
    "$MVS01,00000,0003,221320,14,11,2023,0.00,1500.0,10.00,35.00,\r\n10.00,1498.0,9.50,35.00,\r\n"
    "12000.00,1700.0,2.00,34.70,\r\n5924.00,N,1030.00,E,0.0,,Source: echoloop,*57\\\r\n";

TEST(KmallSound, ATextBecomesTheProfile) {
    for (const bool unused : {true, false}) {
        const auto sent =
            of_type(over_floor({{"unused_point", unused}}, {profile, "$KSSIS,454,2040"}), "#SVP");
        ASSERT_EQ(sent.size(), 2U) << "at once, and whenever it is asked for";
        const Bytes& b = sent[0].bytes;
        EXPECT_EQ(b.size(), 48 + 3 * 20 + (unused ? 20 : 0) + 4U) << "one point more in 22 of 22 real ones";
        EXPECT_EQ(u16(b, 22), 3);
        EXPECT_EQ(at<std::uint32_t>(b, 28), 1700000000U);
        EXPECT_NEAR(at<double>(b, 32), 59.4, 1e-9);
        EXPECT_NEAR(at<double>(b, 40), 10.5, 1e-9);
        EXPECT_EQ(f32(b, 68), 10);
        EXPECT_EQ(f32(b, 72), 1498);
        EXPECT_EQ(f32(b, 80), 9.5F);
        EXPECT_EQ(f32(b, 84), 35);
    }
}

TEST(KmallSound, LaterAndWrongTextsDoNot) {
    std::string later = profile;
    later.replace(4, 2, "12");
    later.replace(later.rfind('*') + 1, 2, "55");
    EXPECT_TRUE(of_type(over_floor({}, {later}), "#SVP").empty()) << "waits for the operator";
    EXPECT_EQ(of_type(over_floor({{"later_profiles", std::string("used")}}, {later}), "#SVP").size(), 1U);
    std::string wrong = profile;
    wrong.replace(wrong.rfind('*') + 1, 2, "58");
    EXPECT_TRUE(of_type(over_floor({}, {wrong}), "#SVP").empty());
    Bench bench = sounder();
    bench.say(text(wrong));
    EXPECT_EQ(bench.device().counters().rejected, 1U);
}

}  // namespace
}  // namespace echoloop::test
