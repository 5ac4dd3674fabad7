// The Omniscan 450 on the bench: what hosts set is the next ping, its pace and its profile, read by literal
// offsets.
#include "tests/emulator/devices/cerulean_bench.h"

namespace echoloop::test {
namespace {

constexpr int profile_id = 2198;
// Offsets in a frame with an os_mono_profile.
constexpr std::size_t number = 8, start = 12, length = 16, timestamp = 20, hertz = 24, gain = 28, count = 30,
                      sound = 32, channel = 34, pulse = 36, analog_gain = 40, max_db = 44, min_db = 48,
                      results = 60;

Bench omniscan(const Options& changes = {}) { return cerulean_sonar("omniscan450", changes); }

Shot shot_of(const OmniscanParams& params, const Options& changes = {}) {
    Bench bench = omniscan(changes);
    bench.say(frame(params));
    bench.run_to(bench.now);
    EXPECT_TRUE(bench.ping);
    return bench.ping ? bench.ping->shot : Shot{};
}

/// The first profile after these parameters, with one echo of `power`.
Bytes profile_of(const OmniscanParams& params, std::size_t bin, float power) {
    Bench bench = omniscan();
    bench.echo_bin = bin;
    bench.echo_power = power;
    bench.say(frame(params));
    bench.run_to(100ms);
    const auto profiles = messages(bench.sent(), profile_id);
    EXPECT_FALSE(profiles.empty());
    return profiles.empty() ? Bytes(2600) : profiles.front();
}

TEST(Omniscan450, TellsWhatItIsInBothWaysOfAsking) {
    Bench bench = omniscan({{"device_type", std::int64_t{101}}});
    bench.say("42 52 02 00 06 00 00 00 04 00 a0 00");
    bench.say("42 52 00 00 04 00 00 00 98 00");
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 2U);
    EXPECT_EQ(to_hex(sent[0].bytes),
              "4252060004000000"
              "650101000000"
              "0501");
    EXPECT_EQ(sent[1].bytes, sent[0].bytes);
}

TEST(Omniscan450, IsSilentUntilAHostEnablesItAndAfterItDisablesIt) {
    Bench bench = omniscan();
    bench.run_to(5s);
    EXPECT_TRUE(bench.sent().empty());
    bench.say(frame(OmniscanParams{}));
    bench.run_to(6s);
    EXPECT_GT(messages(bench.sent(), profile_id).size(), 10U);
    bench.say(frame(OmniscanParams{.enable = 0}));
    bench.run_to(8s);
    EXPECT_TRUE(bench.sent().empty()) << "nor is the ping reported that was in the water";
}

TEST(Omniscan450, WhatAHostSetsIsTheNextPing) {
    const Shot shot = shot_of({.start = 1500, .length = 15000, .gain = 4, .results = 1000});
    EXPECT_DOUBLE_EQ(shot.first_bin_time, 2e-3);
    EXPECT_DOUBLE_EQ(shot.bin_interval, 20e-6);
    EXPECT_EQ(shot.bins, 1000U);
    EXPECT_DOUBLE_EQ(shot.frequency, 450e3);
    EXPECT_EQ(shot.bearings, std::vector<double>{0.0});
}

TEST(Omniscan450, PulseAndFilterAreFractionsOfAPing) {
    const Shot typical = shot_of({.length = 15000});
    EXPECT_NEAR(typical.pulse_length, 0.002 * 22e-3, 1e-9) << "44 us at 15 m, as recorded";
    EXPECT_NEAR(typical.receiver.bandwidth, 1 / (0.0015 * 22e-3), 1);
    const Shot longer = shot_of({.length = 15000, .pulse = 0.004F, .filter = 0.003F});
    EXPECT_NEAR(longer.pulse_length, 2 * typical.pulse_length, 1e-9);
    EXPECT_NEAR(longer.receiver.bandwidth, typical.receiver.bandwidth / 2, 1);
    const Shot nonsense = shot_of({.length = 15000, .pulse = std::nanf(""), .filter = -1});
    EXPECT_DOUBLE_EQ(nonsense.pulse_length, typical.pulse_length);
}

TEST(Omniscan450, AWideFilterBlursAnEcho) {
    const auto shown = [](float filter) {
        const Bytes p = profile_of({.filter = filter, .gain = 4}, 300, 1e12F);
        int bins = 0;
        for (std::size_t i = 0; i < 600; ++i) bins += u16(p, results + 2 * i) == 65535;
        return bins;
    };
    EXPECT_EQ(shown(0.0015F), 1);
    EXPECT_EQ(shown(0.015F), 10) << "a seventieth of a ping of 660 bins and a bit";
}

TEST(Omniscan450, PingsAtTheHostsPaceOrAsFastAsTheRangeAllows) {
    Bench bench = omniscan();
    bench.say(frame(OmniscanParams{.length = 15000, .msec = 100}));
    bench.run_to(1050ms);
    EXPECT_EQ(bench.shots.size(), 11U) << "0, 100 .. 1000 ms";
    bench.say(frame(OmniscanParams{.length = 15000, .msec = 0}));
    bench.shots.clear();
    bench.run_to(1050ms + 220ms);
    EXPECT_EQ(bench.shots.size(), 10U) << "20 ms of sound and 2 ms of thought";
}

TEST(Omniscan450, AShorterIntervalDoesNotWaitForTheLongOneToEnd) {
    Bench bench = omniscan();
    bench.say(frame(OmniscanParams{.msec = 60000}));
    bench.run_to(1s);
    bench.say(frame(OmniscanParams{.msec = 50}));
    bench.run_to(1s + 10ms);
    EXPECT_TRUE(bench.ping);
}

TEST(Omniscan450, TheProfileTellsThePing) {
    const Bytes p = profile_of({.start = 750, .length = 15000, .gain = 5, .results = 200}, 70, 1e12F);
    ASSERT_EQ(p.size(), 10U + 52U + 400U);
    EXPECT_EQ(to_hex(ByteView(p).first(8)), "4252c40196080000");
    EXPECT_EQ(u32(p, number), 0U);
    EXPECT_EQ(u32(p, start), 750U);
    EXPECT_EQ(u32(p, length), 15000U);
    EXPECT_EQ(u32(p, timestamp), 0U);
    EXPECT_EQ(u32(p, hertz), 450000U);
    EXPECT_EQ(u16(p, gain), 5);
    EXPECT_EQ(u16(p, count), 200);
    EXPECT_EQ(u16(p, sound), 15000);
    EXPECT_EQ(p[channel], 0);
    EXPECT_NEAR(f32(p, pulse), 0.002 * 23e-3, 1e-8);
    EXPECT_NEAR(f32(p, analog_gain), 142.8, 1e-3);
    for (std::size_t i = 0; i < 200; ++i)
        EXPECT_EQ(u16(p, results + 2 * i), i == 70 ? 65535 : 0) << "bin " << i;
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i + 2 < p.size(); ++i) sum += p[i];
    EXPECT_EQ(u16(p, p.size() - 2), static_cast<int>(sum % 65536));
}

TEST(Omniscan450, ResultsAreDecibelsOfFullScale) {
    // 200 dB fills the input at index 0, whose factor is 6.5; at index 4 it is 74.55.
    const double full_scale = 200 - 20 * std::log10(74.55 / 6.5);
    const Bytes strong = profile_of({.gain = 4}, 70, 1e12F), weak = profile_of({.gain = 4}, 70, 1e10F);
    EXPECT_NEAR(f32(strong, max_db), 120 - full_scale, 1e-3);
    EXPECT_NEAR(f32(weak, max_db), 100 - full_scale, 1e-3);
    EXPECT_NEAR(f32(strong, max_db) - f32(strong, min_db), 90, 1e-3) << "silence is cut at 90 dB";
    const Bytes low_gain = profile_of({.gain = 0}, 70, 1e12F);
    EXPECT_NEAR(f32(low_gain, max_db), 120 - 200, 1e-3);
}

TEST(Omniscan450, ASilentPingHasAProfileWithoutNonsense) {
    const Bytes p = profile_of({}, 9999, 0);
    EXPECT_GT(f32(p, max_db) - f32(p, min_db), 1) << "hosts divide by it";
    EXPECT_EQ(u16(p, results), 0);
}

TEST(Omniscan450, GainIsTheHostsOrFollowsTheEcho) {
    EXPECT_NEAR(shot_of({.gain = 7}).receiver.saturation_level, 200 - 20 * std::log10(464.625 / 6.5), 1e-9);
    Bench bench = omniscan();
    bench.echo_bin = 50;
    bench.echo_power = 1e19F;  // 190 dB: fits index 0 only, with 6 dB to spare
    bench.say(frame(OmniscanParams{}));
    bench.run_to(100ms);
    auto profiles = messages(bench.sent(), profile_id);
    ASSERT_GE(profiles.size(), 3U);
    EXPECT_EQ(u16(profiles[0], gain), 4);
    EXPECT_EQ(u16(profiles[1], gain), 0);
    bench.echo_power = 1e10F;
    bench.run_to(200ms);
    profiles = messages(bench.sent(), profile_id);
    EXPECT_EQ(u16(profiles.back(), gain), 7);
}

const Options lenient{{"speed_of_sound_id", std::string("both")}};

TEST(Omniscan450, SoundSpeedComesUnderTwoIdsAndChangesTheNextPing) {
    for (const int id : {1002, 116}) {
        Bench bench = omniscan(id == 116 ? Options{} : lenient);
        bench.say(frame(id, le(1200000, 4)));
        bench.say(frame(OmniscanParams{.length = 12000}));
        bench.run_to(bench.now);
        EXPECT_DOUBLE_EQ(bench.ping->shot.bin_interval * 600, 20e-3) << id;
        bench.run_to(50ms);
        EXPECT_EQ(u16(messages(bench.sent(), profile_id).at(0), sound), 12000);
    }
    Bench only = omniscan();
    only.say(frame(1002, le(1500000, 4)));
    EXPECT_EQ(u16(only.sent().at(0).bytes, 4), nack) << "as units in the field";
}

TEST(Omniscan450, ASoundSpeedInMetresIsRefusedAndHarmless) {
    Bench bench = omniscan();
    bench.say(frame(116, le(1515, 4)));
    const auto sent = bench.sent();
    EXPECT_EQ(u16(sent.at(0).bytes, 4), nack);
    EXPECT_EQ(u16(sent.at(0).bytes, 8), 116);
    bench.say(frame(OmniscanParams{.length = 15000}));
    bench.run_to(bench.now);
    EXPECT_DOUBLE_EQ(bench.ping->shot.bin_interval * 600, 20e-3);
}

TEST(Omniscan450, TakesTheShortParametersOfTheManual) {
    const Shot shot = shot_of({.length = 50000, .results = 200, .reserved = 1});
    EXPECT_EQ(shot.bins, 200U);
    Bench bench = omniscan();
    bench.say(frame(OmniscanParams{.reserved = 2}));
    EXPECT_EQ(u16(bench.sent().at(0).bytes, 4), nack);
    EXPECT_EQ(bench.wake, Time::max());
}

TEST(Omniscan450, RefusesWhatIsOutOfRangeUnlessItIsToldToTakeIt) {
    for (const auto& params :
         {OmniscanParams{.length = 0}, OmniscanParams{.length = 500001}, OmniscanParams{.gain = 8},
          OmniscanParams{.gain = -2}, OmniscanParams{.results = 199}, OmniscanParams{.results = 1201}}) {
        Bench bench = omniscan();
        bench.say(frame(params));
        const auto sent = bench.sent();
        ASSERT_EQ(u16(sent.at(0).bytes, 4), nack);
        EXPECT_EQ(u16(sent.at(0).bytes, 8), 2197);
        bench.run_to(1s);
        EXPECT_TRUE(bench.shots.empty());
        EXPECT_EQ(shot_of(params, {{"invalid_settings", std::string("accept")}}).bearings.size(), 1U);
    }
    Bench bench = omniscan();
    bench.say(frame(OmniscanParams{.length = 0, .results = 0, .enable = 0}));
    EXPECT_TRUE(bench.sent().empty()) << "what stops the pings is always good";
}

TEST(Omniscan450, AProfileTooLongForADatagramGoesOnInTheNext) {
    Bench bench = omniscan();
    const Address host{0x7F000001, 40000};
    bench.say(frame(OmniscanParams{.results = 1200}), udp, host);
    bench.run_to(40ms);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 2U);
    EXPECT_EQ(sent[0].bytes.size(), 1472U);
    EXPECT_EQ(sent[1].bytes.size(), 2462U - 1472U);
    EXPECT_EQ(sent[0].bytes[0], 'B');
    EXPECT_EQ(u16(joined(sent), count), 1200);
    for (const Send& s : sent) EXPECT_EQ(s.to, host);

    bench.say(frame(OmniscanParams{.results = 1200}), tcp);
    bench.run_to(80ms);
    const auto stream = bench.sent();
    EXPECT_EQ(stream.back().bytes.size(), 2462U) << "one write";
    EXPECT_EQ(stream.back().port, tcp);
}

TEST(Omniscan450, AnswersRequestsForTheLastPingEvenBeforeThereWasOne) {
    Bench bench = omniscan();
    bench.say(frame(6, le(2198, 2)));
    auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U) << "public hosts hang on silence";
    EXPECT_EQ(u16(sent[0].bytes, count), 0);
    bench.say(frame(OmniscanParams{.results = 200}));
    bench.run_to(50ms);
    const auto profiles = messages(bench.sent(), profile_id);
    bench.say(frame(2198));
    EXPECT_EQ(bench.sent().at(0).bytes, profiles.back());
}

TEST(Omniscan450, TellsWhereItLooks) {
    Bench bench = omniscan({{"mount_bearing", 90.0}});
    bench.say(frame(OmniscanParams{.results = 200}));
    bench.run_to(bench.now);
    Echogram echogram = echo_of(bench.ping->shot, 3, 1e10F);
    echogram.world_from_sonar.orientation = from_rpy(0, 0, deg_to_rad(30));  // 30 deg north of east
    const auto heard = bench.device().heard(echogram, bench.ping->due);
    EXPECT_NEAR(f32(heard.send.at(0).bytes, 52), 60, 1e-3);
    EXPECT_NEAR(f32(heard.send.at(0).bytes, 56), 330, 1e-3);
}

TEST(Omniscan450, AcknowledgesOnRequest) {
    Bench quiet = omniscan(lenient);
    Bench talking = omniscan({{"acknowledge", true}, {"speed_of_sound_id", std::string("both")}});
    for (Bench* bench : {&quiet, &talking})
        for (const Bytes& word :
             {frame(116, le(1480000, 4)), frame(1002, le(1480000, 4)), frame(OmniscanParams{})})
            bench->say(word);
    EXPECT_TRUE(quiet.sent().empty());
    std::vector<int> acked;
    for (const Bytes& message : messages(talking.sent(), ack)) acked.push_back(u16(message, 8));
    EXPECT_EQ(acked, (std::vector<int>{116, 1002, 2197}));
}

TEST(Omniscan450, DropsWhatItDoesNotKnowAndNeverAnswersAnswers) {
    Bench bench = omniscan();
    bench.say(frame(4321, "00"));
    bench.say(frame(1, "0600"));
    bench.say(frame(2, "0600"));
    bench.say(frame(10, "7b7d"));
    EXPECT_TRUE(bench.sent().empty());
    bench.say(frame(6, le(1300, 2)));
    EXPECT_EQ(u16(bench.sent().at(0).bytes, 8), 6) << "nack of the request";
}

TEST(Omniscan450, IsFoundWhereItIsToldTo) {
    EXPECT_EQ(omniscan({{"discovery", std::string("off")}}).device().ports().size(), 2U) << "as a Ping360's";
    Bench bench = omniscan({{"discovery", std::string("127.0.0.1")}});
    const auto ports = bench.device().ports();
    ASSERT_EQ(ports.size(), 3U);
    EXPECT_EQ(ports[2].bind, (Address{0x7F000001, 30303}));
    const std::string question = "Discovery";
    bench.say(Bytes(question.begin(), question.end()), 2, host);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_EQ(
        std::string(sent[0].bytes.begin(), sent[0].bytes.end()),
        "SONAR OMNISCAN450\r\nCerulean Sonar\r\nMAC Address:- 54-10-EC-00-00-02\r\nIP Address:- 127.0.0.1\r\n"
        "Port:- 51200\r\n");
    EXPECT_EQ(sent[0].to, host);
    bench.say(Bytes{'h', 'i'}, 2, host);
    EXPECT_TRUE(bench.sent().empty());
}

TEST(Omniscan450, OnANoisyLineServesItsHostAgainWithinOneRequest) {
    Bench bench = omniscan();
    const std::string request = "42520200060000000500a100";
    const NoisyHost noisy{
        .words = {request, to_hex(frame(OmniscanParams{.msec = 50})), to_hex(frame(116, le(1490000, 4))),
                  to_hex(frame(OmniscanParams{.enable = 0})), "42520000040000009800"},
        .request = request,
        .is_answer = [](const Send& send) { return send.bytes.size() == 14 && send.bytes[4] == 5; }};
    expect_no_wedge(bench, noisy, 500);
}

TEST(Omniscan450, OnANoisyLineStillPings) {
    Bench bench = omniscan();
    const NoisyHost noisy{.words = {to_hex(frame(OmniscanParams{.length = 500000, .msec = 60000}))},
                          .request = to_hex(frame(OmniscanParams{.length = 1000, .results = 333})),
                          .is_answer = [](const Send& send) { return send.bytes.size() == 10 + 52 + 666; },
                          .patience = 1s};
    expect_no_wedge(bench, noisy, 100);
}

}  // namespace
}  // namespace echoloop::test
