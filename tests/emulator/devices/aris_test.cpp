// The ARIS sonars on the bench: beacon, what a controller may set, and timing.
#include "tests/emulator/devices/aris_bench.h"
#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
namespace {

namespace words = aris_words;

TEST(ArisBeacon, ComesOnceASecondAndTellsTheSonarAndItsState) {
    Bench bench(make_device("aris-3000", {}, {{"serial", std::int64_t{1234}}}));
    bench.run_to(3500ms);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 4U) << "at 0, 1, 2 and 3 s";
    EXPECT_EQ(sent[0].port, 1U);
    EXPECT_EQ(sent[0].to, (Address{0x7FFFFFFF, 56124})) << "loopback's broadcast";
    EXPECT_EQ(to_hex(ByteView(sent[0].bytes).first(5)), "08d2091001");
    const Bytes& bytes = sent[0].bytes;
    const Bytes free = from_hex("2000");
    EXPECT_NE(std::search(bytes.begin(), bytes.end(), free.begin(), free.end()), bytes.end())
        << "older readers want the zero";
    bench.device().reconnected(0);
    bench.run_to(4100ms);
    EXPECT_EQ(state(bench.sent().at(0)), 1U) << "busy";
}

TEST(ArisEndpoints, ThatLeadNowhereAreRefused) {
    const auto refused = [](std::vector<std::string> endpoints) {
        EXPECT_THROW(make_device("aris-1800", std::move(endpoints)), std::invalid_argument);
    };
    refused({"tcp-listen://0.0.0.0:56888", "udp://192.168.1.255:56124"});
    refused({"tcp-listen://192.168.1.4:56888"});
    refused({"udp-listen://127.0.0.1:56888", "udp://127.255.255.255:56124"});
    EXPECT_THROW(make_device("aris-1800", {}, {{"controller", std::string("here")}}), std::invalid_argument);
}

TEST(ArisFrames, ComeOnceThereAreAReceiverAndSettings) {
    ArisBench bench;
    EXPECT_TRUE(bench.frames_within(1s).empty());
    bench.say(words::receiver);
    EXPECT_TRUE(bench.frames_within(1s).empty());
    bench.say(words::acoustics);
    ASSERT_EQ(bench.frames_within(1s).size(), 15U);
    bench.say(words::nobody);
    bench.frames_within(100ms);
    EXPECT_TRUE(bench.frames_within(1s).empty());
}

TEST(ArisFrames, GoWhereTheReceiverIs) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    EXPECT_EQ(bench.frames_within(100ms).at(0).to, (Address{0x7F000001, 56444}));
    bench.say("00000013 0801 1a0f 08fcb803 1209 3132372e302e302e35");
    bench.frames_within(70ms);
    EXPECT_EQ(bench.frames_within(100ms).at(0).to, (Address{0x7F000005, 56444}));
    // Not out of loopback, not to port 0, not to a name.
    for (const char* word : {"00000011 0801 1a0d 08fcb803 1207 382e382e382e38", "00000004 0801 1a00",
                             "0000000d 0801 1a09 08fcb803 1203 686579"})
        bench.say(word);
    EXPECT_EQ(bench.device().counters().rejected, 3U);
    EXPECT_EQ(bench.frames_within(100ms).at(0).to, (Address{0x7F000005, 56444}));
}

TEST(ArisFrames, OnARealNetworkGoToTheControllerUnlessItOrTheOptionNamesAnother) {
    const std::vector<std::string> lan{"tcp-listen://192.168.1.4:56888", "udp://192.168.1.255:56124"};
    const auto destination = [&lan](const Options& options, const std::string& receiver) {
        ArisBench bench(options, "aris-1800", lan);
        bench.connect_anew({0xC0A80109, 40000});  // 192.168.1.9
        bench.say(receiver);
        bench.say(words::acoustics);
        return bench.frames_within(100ms).at(0).to;
    };
    const std::string multicast = "00000013 0801 1a0f 08fcb803 1209 3233392e312e322e33";  // 239.1.2.3
    const Options option{{"controller", std::string("192.168.1.7")}};
    EXPECT_EQ(destination({}, words::receiver), (Address{0xC0A80109, 56444}));
    EXPECT_EQ(destination(option, words::receiver), (Address{0xC0A80107, 56444}));
    EXPECT_EQ(destination({}, multicast), (Address{0xEF010203, 56444}));
    EXPECT_EQ(destination(option, multicast), (Address{0xEF010203, 56444}));
}

TEST(ArisTiming, FollowsTheFrameRateAndTheCycle) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    bench.run_to(bench.now);
    ASSERT_TRUE(bench.ping) << "at once";
    EXPECT_NEAR(to_seconds(bench.ping->due), 6 * 0.0105 + 0.002, 1e-9) << "six pings, then 2 ms";
    const auto frames = bench.frames_within(1s);
    ASSERT_GE(frames.size(), 2U);
    EXPECT_EQ(frames[1].number, frames[0].number + 1);
    for (const std::size_t clock : {4U, 708U})  // hosts take the frame rate from the first
        EXPECT_NEAR(
            static_cast<double>(frames[1].at<std::uint64_t>(clock) - frames[0].at<std::uint64_t>(clock)),
            1e6 / 15, 2)
            << clock;
    const auto& times = frames[1].times;
    ASSERT_GT(times.size(), 60U);
    for (std::size_t i = 1; i < times.size(); ++i) EXPECT_EQ(times[i] - times[i - 1], 300us);
}

TEST(ArisTiming, OfPartsIsTheControllersAndSlowsFramesThatDoNotFit) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    bench.say("0000000b 0802 2207 0a05 0801 10d00f");  // 2000 us
    const auto frames = bench.frames_within(2s);
    ASSERT_GE(frames.size(), 3U);
    EXPECT_EQ(frames[1].times[1] - frames[1].times[0], 2ms);
    EXPECT_EQ(frames[1].word(692), 1U);
    EXPECT_EQ(frames[1].word(696), 2000U);
    EXPECT_GE(frames[2].times.front() - frames[1].times.back(), 2ms) << "no frame overtakes another";
    EXPECT_NEAR(to_seconds(frames[2].times[0] - frames[1].times[0]),
                0.002 * static_cast<double>(frames[1].times.size()), 0.003);
}

TEST(ArisSettings, ThatCannotBeAreRefusedAndTheLastOnesStay) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::too_long);
    EXPECT_TRUE(bench.frames_within(500ms).empty()) << "never valid ones so far";
    bench.say(words::acoustics);
    bench.say(words::too_long);
    const auto frame = bench.frames_within(200ms).at(0);
    EXPECT_EQ(frame.word(680), 7U) << "applied";
    EXPECT_EQ(frame.word(688), 10U) << "invalid";
    EXPECT_EQ(frame.word(468), 1014U);
    // Cookie 0, rate 16, rate NaN, sample period 3, gain 25, mode 9 of another model, no time for 15 a
    // second.
    const char* bad[] = {
        "00000023 0803 2a1f 1500007041 18f607 20ec0f 288452 3008 380b 4003 4801 5001 5801 6500009041",
        "00000025 0803 2a21 0807 1500008041 18f607 20ec0f 288452 3008 380b 4003 4801 5001 5801 6500009041",
        "00000025 0803 2a21 0807 150000c07f 18f607 20ec0f 288452 3008 380b 4003 4801 5001 5801 6500009041",
        "00000025 0803 2a21 0807 1500007041 18f607 20ec0f 288452 3003 380b 4003 4801 5001 5801 6500009041",
        "00000025 0803 2a21 0807 1500007041 18f607 20ec0f 288452 3008 380b 4003 4801 5001 5801 650000c841",
        "00000025 0803 2a21 0807 1500007041 18f607 20ec0f 288452 3008 380b 4009 4801 5001 5801 6500009041",
        "00000025 0803 2a21 0807 1500007041 18f607 20ec0f 28f857 3008 380b 4003 4801 5001 5801 6500009041"};
    const auto before = bench.device().counters().rejected;
    for (const char* word : bad) bench.say(word);
    EXPECT_EQ(bench.device().counters().rejected - before, 7U);
}

TEST(ArisSettings, WithTooLongAPulseAreMadeToFit) {
    // floor(300 x 1.8 / 10) = 54 cycles, floor(30 x 1.8) = 54; in us 30 of both.
    for (const auto& [unit, pulse] : {std::pair{"cycles", 54U}, std::pair{"us", 30U}, std::pair{"", 30U}}) {
        ArisBench bench(*unit ? Options{{"pulse_unit", std::string(unit)}} : Options{});
        bench.say(words::receiver);
        bench.say(words::long_pulse);
        const auto frame = bench.frames_within(200ms).at(0);
        EXPECT_EQ(frame.word(444), pulse) << unit;
        EXPECT_EQ(frame.word(680), 0U) << "the maker's .NET host refuses frames that say both";
        EXPECT_EQ(frame.word(684), 9U) << "constrained";
        EXPECT_NEAR(bench.shots.at(0).pulse_length, 30e-6, 1e-9);
    }
}

TEST(ArisSettings, AreToldByTheLargestOfThreeCookies) {
    ArisBench bench;
    bench.say(words::receiver);
    const auto told = [&bench](const std::string& settings) {
        bench.say(settings);
        const auto frame = bench.frames_within(400ms).back();
        return std::array{frame.word(680), frame.word(684), frame.word(688)};
    };
    EXPECT_EQ(told(words::acoustics), (std::array{7U, 0U, 0U})) << "applied";
    EXPECT_EQ(told(words::long_pulse), (std::array{7U, 9U, 0U})) << "constrained";
    EXPECT_EQ(told(words::too_long), (std::array{7U, 9U, 10U})) << "invalid";
    std::string next = words::acoustics;
    next.replace(next.find("0807"), 4, "080b");
    EXPECT_EQ(told(next), (std::array{11U, 9U, 10U})) << "applied again";
}

TEST(ArisSettings, ChangeTheNextFrame) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    bench.run_to(10ms);
    bench.say(words::mode_1);
    const auto frames = bench.frames_within(500ms);
    ASSERT_GE(frames.size(), 2U);
    EXPECT_EQ(frames[0].word(436), 3U) << "the frame that was under way";
    EXPECT_EQ(frames[0].data.size(), 96U * 1014);
    EXPECT_EQ(frames[1].word(436), 1U);
    EXPECT_EQ(frames[1].word(680), 8U);
    EXPECT_EQ(frames[1].data.size(), 48U * 1014);
    EXPECT_EQ(bench.shots.at(0).frequency, 1.8e6);
    EXPECT_EQ(bench.shots.at(1).frequency, 1107700);
    EXPECT_EQ(bench.shots.at(0).source_level - bench.shots.at(1).source_level, 204 - 206 + 20)
        << "and no 150 V";
}

TEST(ArisController, OnANoisyLineIsServedAgainWithinOneCommand) {
    ArisBench bench({{"silence_limit", 0.0}});
    bench.say(words::receiver);
    // What must be answered: settings with a cookie that no other has; the answer is a frame that has it.
    NoisyHost host;
    host.words = {words::acoustics, words::mode_1, words::long_pulse,
                  words::too_long,  words::salt,   words::ping};
    host.request =
        words::receiver +
        "00000025 0803 2a21 080f 1500007041 18800120ec0f 288452 3008 380b 4003 4801 5001 5801 6500009041";
    host.is_answer = [](const Send& send) {
        if (send.port != 2) return false;
        Fields part(send.bytes);
        return part.numbers[5] == 0 && part.blocks[3].at(680) == 15;
    };
    host.patience = 1200ms;
    host.longest_pause = 20ms;
    expect_no_wedge(bench, host, 200);
}

/// Until nothing moves, with frames at 15 a second.
ArisFrame focused(ArisBench& bench, const std::string& word) {
    bench.say(word);
    return bench.frames_within(1500ms).back();
}

TEST(ArisFocus, MovesToItsRangeWithinASecond) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    EXPECT_EQ(bench.frames_within(200ms).back().word(604), 0U) << "at home after power-up";
    bench.say(words::focus_4_m);
    const auto frames = bench.frames_within(1500ms);
    ASSERT_GT(frames.size(), 20U);
    EXPECT_LT(frames[3].word(604), frames[4].word(604)) << "what the maker's test looks for";
    EXPECT_EQ(frames[4].word(540), 1U) << "on its way";
    EXPECT_NEAR(frames[4].word(84), 768, 10) << "what is asked for; 768 in the maker's map";
    EXPECT_EQ(frames[20].word(604), frames[20].word(84));
    EXPECT_EQ(frames[20].word(540), 0U);
    bench.connect_anew();
    bench.say(words::receiver);
    bench.say(words::acoustics);
    EXPECT_EQ(bench.frames_within(200ms).back().word(604), frames[20].word(604)) << "the lens stays there";
    EXPECT_EQ(focused(bench, words::home_focus).word(604), 0U);
}

TEST(ArisFocus, IsThatOfTheLensAndTheWater) {
    const auto position = [](const std::string& before, const std::string& model) {
        ArisBench bench({}, model);
        bench.say(words::receiver);
        bench.say(before);
        bench.say(model == "aris-3000" ? words::mode_6 : words::acoustics);
        return focused(bench, words::focus_10_m).word(604);
    };
    // The maker's map at 15 degC and 10 m.
    EXPECT_NEAR(position(words::ping, "aris-1800"), 863, 15);
    EXPECT_NEAR(position(words::salt, "aris-1800"), 834, 15);
    EXPECT_NEAR(position(words::telephoto, "aris-1800"), 781, 15);
    EXPECT_NEAR(position(words::salt + words::telephoto, "aris-1800"), 719, 15);
    EXPECT_NEAR(position(words::ping, "aris-3000"), 193, 15);
}

TEST(ArisFocus, TakesThePositionOfOlderHostsAndNoNonsense) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    EXPECT_EQ(focused(bench, "00000007 0806 4203 08f403").word(604), 500U);
    EXPECT_EQ(focused(bench, "00000007 0806 4203 08d00f").word(604), 1000U) << "2000";
    for (const char* word : {"00000009 0806 4205 150000c07f", "00000009 0806 4205 15000080bf"})  // NaN, -1 m
        EXPECT_EQ(focused(bench, word).word(604), 1000U);
    EXPECT_EQ(bench.device().counters().rejected, 2U);
}

TEST(ArisAcks, ChangeNothing) {
    ArisBench bench;
    bench.say("0805 1064", 2);
    bench.say("0805 10", 2);
    EXPECT_EQ(bench.device().counters().messages, 1U);
    EXPECT_EQ(bench.device().counters().rejected, 1U);
}

}  // namespace
}  // namespace echoloop::test
