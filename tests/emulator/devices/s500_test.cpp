// The S500 on the bench: depth and profile by literal offsets, single pings, automatic range and gain.
#include "tests/emulator/devices/cerulean_bench.h"

namespace echoloop::test {
namespace {

constexpr int distance_id = 1223, profile_id = 1308;
// Offsets in a frame with a profile6_t.
constexpr std::size_t number = 8, length = 16, first_hertz = 20, last_hertz = 24, timestamp = 32, max_db = 48,
                      min_db = 52, depth = 56, smooth = 60, confidence = 68, gain = 69, decimation = 70,
                      count = 72, results = 74;

Bench s500(const Options& changes = {}) { return cerulean_sonar("s500", changes); }

/// A bottom so many metres away by 1500 m/s, in every ping of this range.
void place_bottom(Bench& bench, double metres, double range, std::size_t bins = 1024) {
    bench.echo_bin = static_cast<std::size_t>(metres / range * static_cast<double>(bins));
    bench.echo_power = 1e13F;
}

TEST(S500, ReportsDepthAndProfileAfterEveryPing) {
    Bench bench = s500();
    place_bottom(bench, 3.0, 7.5);
    bench.say(frame(S500Params{.length = 7500, .gain = 5, .msec = 200}));
    bench.run_to(450ms);
    const auto profiles = messages(bench.sent(), profile_id);
    ASSERT_EQ(profiles.size(), 3U) << "0, 200 and 400 ms";
    const Bytes& p = profiles[1];
    EXPECT_EQ(p.size(), 10U + 66U + 2048U);
    EXPECT_EQ(u32(p, number), 1U);
    EXPECT_EQ(u32(p, length), 7500U);
    EXPECT_EQ(u32(p, first_hertz), 500000U);
    EXPECT_EQ(u32(p, last_hertz), 500000U);
    EXPECT_EQ(u32(p, timestamp), 200U);
    EXPECT_NEAR(f32(p, depth), 3.0, 7.5 / 1024);
    EXPECT_NEAR(f32(p, smooth), 3.0, 7.5 / 1024);
    EXPECT_EQ(p[confidence], 100);
    EXPECT_EQ(p[gain], 5);
    EXPECT_EQ(p[decimation], 0);
    EXPECT_EQ(u16(p, count), 1024);
    EXPECT_NEAR(f32(p, max_db) - f32(p, min_db), 90, 1e-3);
    for (std::size_t i = 0; i < 1024; ++i)
        EXPECT_EQ(u16(p, results + 2 * i), i == bench.echo_bin ? 65535 : 0) << "bin " << i;
}

TEST(S500, ResultsAreDecibelsOfFullScale) {
    Bench bench = s500();
    place_bottom(bench, 3.0, 7.5);  // 130 dB
    bench.say(frame(S500Params{.gain = 10}));
    bench.run_to(50ms);
    // 207 dB fill the input at index 0; every index is 4 dB.
    EXPECT_NEAR(f32(messages(bench.sent(), profile_id).at(0), max_db), 130 - (207 - 40), 1e-3);
}

TEST(S500, Distance2AveragesTwentyPings) {
    Bench bench = s500();
    place_bottom(bench, 2.0, 7.5);
    bench.say(frame(S500Params{.msec = 50, .report = 1223}));
    bench.run_to(995ms);  // 20 pings
    place_bottom(bench, 4.0, 7.5);
    bench.run_to(1495ms);  // 10 more
    const auto distances = messages(bench.sent(), distance_id);
    ASSERT_EQ(distances.size(), 30U);
    EXPECT_NEAR(u32(distances[19], 8), 2000, 8);
    EXPECT_NEAR(u32(distances[19], 12), 2000, 8);
    EXPECT_NEAR(u32(distances[29], 8), 4000, 8);
    EXPECT_NEAR(u32(distances[29], 12), 3000, 8);
    EXPECT_EQ(distances[29][18], 100);
    EXPECT_EQ(distances[29][19], 100);
    EXPECT_EQ(u32(distances[29], 20), 1450U);
}

TEST(S500, WithoutABottomThereIsNoConfidence) {
    Bench bench = s500();
    bench.say(frame(S500Params{.report = 1223}));
    bench.run_to(50ms);
    const auto distances = messages(bench.sent(), distance_id);
    ASSERT_EQ(distances.size(), 1U);
    EXPECT_EQ(u32(distances[0], 8), 0U);
    EXPECT_EQ(distances[0][18], 0);
    EXPECT_EQ(distances[0][19], 0);
}

TEST(S500, TheBottomIsTheStrongestEchoOnceWhatTheWaterTookIsGivenBack) {
    Bench bench = s500();
    bench.say(frame(S500Params{.length = 150000, .report = 1223}));
    bench.run_to(bench.now);
    // A fish at 50 m, 8 dB louder than the bottom at 100 m, which lost 6 dB by spreading and 14 dB more on
    // its way.
    Echogram echogram = echo_of(bench.ping->shot, 683, 1e9F);
    echogram.values[341] = 6.3e9F;
    const auto heard = bench.device().heard(echogram, bench.ping->due);
    EXPECT_NEAR(u32(heard.send.at(0).bytes, 8), 100000, 150);
}

TEST(S500, DepthFollowsTheHostsSpeedOfSound) {
    Bench bench = s500();
    bench.say(frame(1002, le(1450000, 4)));
    bench.say(frame(S500Params{.length = 7250}));
    bench.run_to(bench.now);
    EXPECT_DOUBLE_EQ(bench.ping->shot.bin_interval * 1024, 10e-3);
    bench.echo_bin = 512;
    bench.echo_power = 1e13F;
    bench.run_to(50ms);
    EXPECT_NEAR(f32(messages(bench.sent(), profile_id).at(0), depth), 3.625, 7.25 / 1024);
}

TEST(S500, ASinglePingIsOneAndNoMore) {
    Bench bench = s500();
    bench.say(frame(S500Params{.msec = -1}));
    bench.run_to(5s);
    EXPECT_EQ(messages(bench.sent(), profile_id).size(), 1U);
    bench.say(frame(S500Params{.msec = -1, .report = 1223}));
    bench.run_to(5s + 50ms);
    EXPECT_EQ(messages(bench.sent(), distance_id).size(), 1U);
    bench.run_to(9s);
    EXPECT_TRUE(bench.sent().empty());
}

TEST(S500, ASinglePingEndsARow) {
    Bench bench = s500();
    bench.say(frame(S500Params{.msec = 50}));
    bench.run_to(1s + 5ms);  // one is in the water
    bench.sent();
    bench.say(frame(S500Params{.msec = -1}));
    bench.run_to(5s);
    EXPECT_EQ(messages(bench.sent(), profile_id).size(), 2U) << "the one in the water and the one asked for";
}

TEST(S500, ReportZeroEndsThePings) {
    Bench bench = s500();
    bench.say(frame(S500Params{.msec = 0}));
    bench.run_to(1s);
    EXPECT_NEAR(static_cast<double>(bench.shots.size()), 1000.0 / 12, 1) << "10 ms of sound, 2 ms of thought";
    bench.say(frame(S500Params{.length = 0, .report = 0}));
    bench.sent();
    bench.run_to(3s);
    EXPECT_TRUE(bench.sent().empty());
}

TEST(S500, AChirpIsFinerWithinSixThousandResults) {
    const auto shot_of = [](const S500Params& params) {
        Bench bench = s500();
        bench.say(frame(params));
        bench.run_to(bench.now);
        return bench.ping->shot;
    };
    // 7.5 m are 10 ms, or 10000 samples of 1 MHz.
    const Shot automatic = shot_of({.length = 7500, .chirp = 1});
    EXPECT_EQ(automatic.bins, 2000U);
    EXPECT_DOUBLE_EQ(automatic.bandwidth, 100e3);
    EXPECT_NEAR(automatic.bin_interval, 5e-6, 1e-12);
    EXPECT_EQ(shot_of({.length = 7500, .chirp = 1, .decimation = 10}).bins, 1000U);
    EXPECT_EQ(shot_of({.length = 3750, .chirp = 1, .decimation = 1}).bins, 5000U) << "every sample fits";
    EXPECT_EQ(shot_of({.length = 1200, .chirp = 1}).bins, 1600U) << "every sample";
    for (const int mm : {1500, 7500, 20000, 150000})
        EXPECT_LT(10 + 66 + 2 * shot_of({.length = mm, .chirp = 1}).bins, 4096U) << "hosts' buffers";
    EXPECT_LE(shot_of({.length = 500000, .chirp = 1}).bins, 6000U);
    EXPECT_EQ(shot_of({.length = 7500}).bandwidth, 0);
    Bench bench = s500();
    bench.say(frame(S500Params{.length = 7500, .chirp = 1}));
    bench.run_to(50ms);
    const Bytes p = messages(bench.sent(), profile_id).at(0);
    EXPECT_EQ(p.size(), 10U + 66U + 4000U);
    EXPECT_EQ(p[decimation], 5);
    EXPECT_EQ(u32(p, first_hertz), 450000U);
    EXPECT_EQ(u32(p, last_hertz), 550000U);
}

TEST(S500, NoProfileFillsAReadOf4096BytesExactly) {
    for (const int mm : {1507, 1508, 1509, 3043, 3044, 3045}) {  // 2010 and 4058 samples of 1 MHz
        Bench bench = s500();
        bench.say(frame(S500Params{.length = mm, .chirp = 1, .decimation = 1}));
        bench.run_to(bench.now);
        EXPECT_NE((10 + 66 + 2 * bench.ping->shot.bins) % 4096, 0U) << mm;
    }
}

TEST(S500, LengthZeroFollowsTheBottom) {
    Bench bench = s500();
    bench.say(frame(S500Params{.length = 0, .report = 1223}));
    bench.run_to(2s);
    const auto range = [&] {
        bench.sent();
        bench.say(frame(1204));
        return u32(bench.sent().at(0).bytes, 12);
    };
    EXPECT_EQ(range(), 150000U) << "doubled while there is no bottom";
    place_bottom(bench, 9.9, 150.0);
    for (const auto heard = bench.shots.size(); bench.shots.size() == heard;) bench.run_to(bench.now + 1ms);
    EXPECT_EQ(range(), 15000U) << "half as far again, in whole metres";
}

TEST(S500, GainFollowsTheEcho) {
    Bench bench = s500();
    place_bottom(bench, 3.0, 7.5);  // 130 dB: 6 dB below 136
    bench.say(frame(S500Params{}));
    bench.run_to(250ms);
    const auto profiles = messages(bench.sent(), profile_id);
    ASSERT_EQ(profiles.size(), 3U);
    EXPECT_EQ(profiles[0][gain], 6);
    EXPECT_EQ(profiles[1][gain], 13) << "207 - 13 x 4 = 155 dB, far above";
    bench.echo_power = 1e19F;
    bench.run_to(450ms);
    EXPECT_EQ(messages(bench.sent(), profile_id).back()[gain], 2) << "207 - 2 x 4 - 6 = 193 dB holds 190";
}

TEST(S500, ASlowLineSlowsThePingsDownInsteadOfQueueing) {
    Bench bench(make_device("s500", {"pty:/tmp/echoloop/s500"}, {{"baud", 115200.0}}));
    bench.say(frame(S500Params{.msec = 50}));
    bench.run_to(1s + 20ms);
    // 2124 bytes take 184.4 ms, 2R/c and thought 12 ms.
    EXPECT_EQ(messages(bench.sent(), profile_id).size(), 6U) << "12, 208, 405, 601, 798 and 994 ms";
}

TEST(S500, OnUdpALongProfileGoesOnInTheNextDatagram) {
    Bench bench = s500();
    bench.say(frame(S500Params{.length = 7500, .chirp = 1, .decimation = 2}), udp, host);
    bench.sent();
    bench.run_to(20ms);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 7U) << "10076 bytes";
    EXPECT_EQ(joined(sent).size(), 10076U);
    for (const Send& s : sent) EXPECT_EQ(s.to, host);
}

TEST(S500, OnANoisyLineServesItsHostAgainWithinOneRequest) {
    Bench bench = s500();
    const std::string request = "42520200060000000500a100";
    const NoisyHost noisy{
        .words = {request, to_hex(frame(S500Params{})), to_hex(frame(S500Params{.msec = -1})),
                  to_hex(frame(1002, le(1490000, 4))), to_hex(frame(1203))},
        .request = request,
        .is_answer = [](const Send& send) { return send.bytes.size() == 14 && send.bytes[4] == 5; }};
    expect_no_wedge(bench, noisy, 500);
}

}  // namespace
}  // namespace echoloop::test
