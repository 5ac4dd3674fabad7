// Frames of an ARIS on the bench: header, levels and the place of each sample.
#include <cmath>

#include "tests/emulator/devices/aris_bench.h"

namespace echoloop::test {
namespace {

namespace words = aris_words;

/// A frame of an echogram with one strong sample.
ArisFrame frame_of(ArisBench& bench, std::size_t clockwise_beam, std::size_t sample, float power,
                   Pose pose = {{0, 0, -20}, {}}) {
    for (const Time end = bench.now + 2s; !bench.ping && bench.now < end;) bench.run_to(bench.now + 1ms);
    bench.frames();
    Echogram echogram = echo_of(bench.ping->shot, 0, 0);
    echogram.values[clockwise_beam * echogram.shot.bins + sample] = power;
    echogram.world_from_sonar = pose;
    bench.hear(echogram);
    bench.run_to(bench.now + 40ms);
    return bench.frames().at(0);
}

TEST(ArisHeader, SaysWhatTheFrameIs) {
    ArisBench bench({{"temperature", 8.0}, {"voyager", true}});
    bench.say(words::receiver);
    bench.say(words::salt);
    bench.say(words::acoustics);
    const ArisFrame f = frame_of(bench, 0, 0, 0);
    ASSERT_EQ(f.header.size(), 744U);
    EXPECT_EQ(f.word(0), 1U);
    EXPECT_EQ(f.word(12), 0x05464444U);
    const std::pair<std::size_t, std::uint32_t> numbers[] = {
        {68, 18},    {72, 8},     {436, 3},  {440, 1},    {444, 11}, {448, 10500}, {452, 8},
        {456, 1},    {468, 1014}, {472, 1},  {476, 2028}, {480, 0},  {484, 0},     {488, 1001},
        {508, 8883}, {516, 0},    {520, 35}, {680, 7},    {684, 0},  {688, 0},     {732, 2}};
    for (const auto& [offset, number] : numbers) EXPECT_EQ(f.word(offset), number) << offset;
    // 1402.5 + 40 - 3.4816 + 0.1075 + 46.55 - 3.444 + 0.1949 + 0.312
    const float c = f.at<float>(464);
    EXPECT_NEAR(c, 1482.74, 0.02);
    EXPECT_NEAR(f.at<float>(52), c / 2 * 2028e-6F, 1e-4);
    EXPECT_NEAR(f.at<float>(56), c / 2 * 8112e-6F, 1e-4);
    EXPECT_EQ(f.at<float>(224), 8);
    EXPECT_EQ(f.at<float>(420), 125000);
    EXPECT_EQ(f.at<float>(460), 15);
    // 14.6959 + 20 x 1.027 / 0.702398
    EXPECT_NEAR(f.at<float>(524), 43.94, 0.01) << "psi at 20 m";
    EXPECT_EQ(f.data.size(), 96U * 1014);
}

TEST(ArisHeader, HasTheClockThatTheControllerSets) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say("00000018 1216 0a14 323031342d4a616e2d33312032333a35383a3135");
    bench.say(words::acoustics);
    const ArisFrame f = frame_of(bench, 0, 0, 0);
    EXPECT_EQ(f.at<std::uint64_t>(4), 1391212695000000U) << "where the maker's test of the clock looks";
    EXPECT_EQ(f.at<std::uint64_t>(20), 1391212695000000U);
    // The maker's own host does not pad the day: 2014-Jan-5.
    ArisBench other;
    other.say(words::receiver);
    other.say("00000017 1215 0a13 323031342d4a616e2d352032333a35383a3135");
    other.say(words::acoustics);
    EXPECT_EQ(frame_of(other, 0, 0, 0).at<std::uint64_t>(20), 1388966295000000U);
}

TEST(ArisHeader, HasThePressureFromWhichHostsTakeTheDepth) {
    // Psi to metres as the maker's hosts do it at 10 degC.
    for (const auto& [salinity, density] :
         {std::pair{std::string(), 1.0}, std::pair{words::brackish, 1.011}, std::pair{words::salt, 1.027}})
        for (const double depth : {2.0, 100.0}) {
            ArisBench bench;
            bench.say(words::receiver + salinity);
            bench.say(words::acoustics);
            const ArisFrame f = frame_of(bench, 0, 0, 0, {{0, 0, -depth}, {}});
            const double psi = static_cast<double>(f.at<float>(524));
            EXPECT_NEAR((psi - 14.6959) * 0.702398 / density, depth, 0.005 * depth) << salinity;
        }
}

TEST(ArisHeader, HasTheAttitudeInTheSignsOfTheMakersSample) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    // Heading 49.6 deg clockwise from north, bow 2.2 deg down, port 2.7 deg down.
    const Quat tilted = from_rpy(deg_to_rad(-2.7), deg_to_rad(2.2), deg_to_rad(90 - 49.6));
    const ArisFrame f = frame_of(bench, 0, 0, 0, {{}, tilted});
    const std::pair<std::size_t, double> degrees[] = {{160, 49.6}, {164, -2.2}, {168, -2.7}};
    for (const auto& [offset, value] : degrees) EXPECT_NEAR(f.at<float>(offset), value, 1e-3) << offset;
    const std::pair<std::size_t, double> g[] = {
        {424, -0.051}, {428, -0.045}, {432, -1.027}};  // of the sample
    for (const auto& [offset, value] : g) EXPECT_NEAR(f.at<float>(offset), value, 0.03) << offset;
    const ArisFrame west = frame_of(bench, 0, 0, 0, {{}, from_rpy(0, 0, std::numbers::pi)});
    EXPECT_NEAR(west.at<float>(160), 270, 1e-3);
}

TEST(ArisHeader, HasNoClockFromWhatIsNoDate) {
    ArisBench bench;
    bench.say("00000018 1216 0a14 323031342d4a616e2d33322032333a35383a3135");
    EXPECT_EQ(bench.device().counters().rejected, 1U) << "the 32nd of January";
    bench.say("00000017 1215 0a13 323031342d4a616e2d303520333a35383a3135");
    EXPECT_EQ(bench.device().counters().rejected, 2U) << "3:58:15";
}

TEST(ArisSamples, StandWhereTheirPingAndChannelAre) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    // The first beam clockwise is the last of the sonar, 95 = 5 + 15 * 6: ping 5, channel 10 since map[10]
    // = 15.
    const ArisFrame f = frame_of(bench, 0, 700, 1e16F);
    const std::size_t place = 5 * 1014 * 16 + 700 * 16 + 10;
    EXPECT_EQ(f.data.at(place), 255);
    EXPECT_EQ(std::count(f.data.begin(), f.data.end(), 255), 1);
    // Clockwise beam 38 is 57 = 3 + 9 * 6: map[12] = 9.
    const ArisFrame g = frame_of(bench, 38, 0, 1e16F);
    EXPECT_EQ(g.data.at(3 * 1014 * 16 + 12), 255);
}

TEST(ArisSamples, InOrderStandRangeAfterRangeAndSayTheSame) {
    ArisBench bench({{"sample_order", std::string("reordered")}});
    bench.say(words::receiver);
    bench.say(words::acoustics);
    const ArisFrame f = frame_of(bench, 38, 700, 1e16F);
    EXPECT_EQ(f.word(516), 1U);
    EXPECT_EQ(f.data.at(700 * 96 + 57), 255);
}

TEST(ArisSamples, AreDecibelsAndFollowTheGain) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    const auto sample = [&](float power) {
        const ArisFrame f = frame_of(bench, 95, 10, power);  // beam 0: ping 0, channel 5
        return static_cast<int>(f.data.at(10 * 16 + 5));
    };
    const float power = 1e8F;
    const int low = sample(power), high = sample(power * 100);
    EXPECT_GT(low, 20);
    EXPECT_LT(high, 255);
    EXPECT_NEAR(high - low, 20 * 255 / 80.0, 1.1);
    EXPECT_EQ(sample(0), 0);
    EXPECT_EQ(sample(1e20F), 255);
    bench.say(
        "00000025 0803 2a21 0808 1500007041 18f607 20ec0f 288452 3008 380b 4003 4801 5001 5801 6500004041");
    sample(0);  // of the frame under way
    EXPECT_NEAR(low - sample(power), 6 * 255 / 80.0, 1.1) << "12 dB instead of 18";
}

TEST(ArisBearings, AreClockwiseAndOfTheLens) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    bench.run_to(100ms);
    ASSERT_FALSE(bench.shots.empty());
    const auto edges = [&] {
        const auto& bearings = bench.shots.back().bearings;
        return std::pair(rad_to_deg(bearings.front()), rad_to_deg(bearings.back()));
    };
    EXPECT_NEAR(edges().first, -13.88, 0.01) << "port: the last beam";
    EXPECT_NEAR(edges().second, 13.75, 0.01) << "starboard: beam 0";
    bench.say(words::telephoto);
    bench.run_to(bench.now + 200ms);
    EXPECT_NEAR(edges().second, 7.42, 0.01);
    EXPECT_EQ(bench.frames().back().word(480), 1U);
    ArisBench other({}, "aris-3000");
    other.say(words::telephoto);
    EXPECT_EQ(other.device().counters().rejected, 1U);
}

TEST(ArisShot, ListensFromTheDelayOn) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    bench.run_to(bench.now);
    const Shot& shot = bench.ping->shot;
    EXPECT_DOUBLE_EQ(shot.first_bin_time, 2028e-6);
    EXPECT_DOUBLE_EQ(shot.bin_interval, 8e-6);
    EXPECT_EQ(shot.bins, 1014U);
    EXPECT_NEAR(shot.pulse_length, 11e-6, 1e-12);
    EXPECT_DOUBLE_EQ(shot.interval, 1 / 15.0);
}

TEST(ArisShot, HasItsPulseInCyclesOfTheCarrierByOption) {
    ArisBench bench({{"pulse_unit", std::string("cycles")}});
    bench.say(words::receiver);
    bench.say(words::acoustics);
    bench.run_to(bench.now);
    EXPECT_NEAR(bench.ping->shot.pulse_length, 11 / 1.8e6, 1e-12);
}

/// When the next ping goes out, and how long after it the one behind, as it says.
std::pair<Time, double> next_ping(ArisBench& bench) {
    const auto last = bench.ping ? bench.ping->shot.ping : 0;
    while (!bench.ping || bench.ping->shot.ping == last)
        bench.run_to(std::min(bench.wake, bench.ping ? bench.ping->due : Time::max()));
    return {bench.now, bench.ping->shot.interval};
}

TEST(ArisShot, SaysWhenTheNextOneGoesOutAlsoWherePartsHoldItUp) {
    for (const bool slow : {false, true}) {
        ArisBench bench;
        bench.say(words::receiver);
        if (slow) bench.say("0000000b 0802 2207 0a05 0801 10d00f");  // 2000 us between parts
        bench.say(words::acoustics);
        auto before = next_ping(bench);
        for (int i = 0; i < 5; ++i) {
            const auto ping = next_ping(bench);
            EXPECT_NEAR(to_seconds(ping.first - before.first), before.second, 2e-9);
            before = ping;
        }
        EXPECT_EQ(before.second > 0.1, slow) << "they take longer than a period";
    }
}

}  // namespace
}  // namespace echoloop::test
