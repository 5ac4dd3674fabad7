// The ARIS 1200 on the bench: the one ping mode, the frequencies and the limits that the notes give it.
#include "tests/emulator/devices/aris_bench.h"

namespace echoloop::test {
namespace {

namespace words = aris_words;

/// Cookie 7, 1082 samples from 5408 us on of 25 us, cycle 32818 us, 150 V, 20 dB: the notes' example at 10
/// frames a second
/// ("00002041"), pulse 24 ("18"), mode 1 and the high frequency.
std::string acoustics(const std::string& rate = "00002041", const std::string& pulse = "18",
                      const std::string& mode = "01", const std::string& frequency = "01",
                      const std::string& cycle = "b28002") {
    return "00000026 0803 2a22 0807 15" + rate + "18ba08 20a02a 28" + cycle + "3019 38" + pulse + "40" +
           mode + "4801 50" + frequency + "5801 650000a041";
}

/// The first frame with these settings, and its shot.
std::pair<ArisFrame, Shot> first_frame(const std::string& settings, const Options& options = {}) {
    ArisBench bench(options, "aris-1200");
    bench.say(words::receiver);
    bench.say(settings);
    const auto frames = bench.frames_within(400ms);
    return frames.empty() ? std::pair<ArisFrame, Shot>{} : std::pair(frames[0], bench.shots.at(0));
}

TEST(Aris1200, SaysItsTypeInItsBeacon) {
    Bench bench(make_device("aris-1200"));
    bench.run_to(bench.now);
    EXPECT_EQ(to_hex(ByteView(bench.sent().at(0).bytes).first(5)), "08e9071002") << "serial 1001, type 2";
}

TEST(Aris1200, DoesTheExampleOfTheNotes) {
    const auto [frame, shot] = first_frame(acoustics());
    ASSERT_EQ(frame.header.size(), 744U);
    const std::pair<std::size_t, std::uint32_t> numbers[] = {
        {436, 1},    {440, 1}, {444, 24}, {448, 32818}, {452, 25}, {468, 1082},
        {476, 5408}, {484, 2}, {680, 7},  {684, 0},     {688, 0}};
    for (const auto& [offset, number] : numbers) EXPECT_EQ(frame.word(offset), number) << offset;
    EXPECT_EQ(frame.data.size(), 48U * 1082);
    EXPECT_EQ(shot.frequency, 1.2e6);
    EXPECT_NEAR(shot.pulse_length, 24e-6, 1e-12);
    ASSERT_EQ(shot.bearings.size(), 48U);
    EXPECT_NEAR(rad_to_deg(shot.bearings.front()), -13.57, 0.01);
    EXPECT_NEAR(rad_to_deg(shot.bearings.back()), 13.57, 0.01);
    EXPECT_NEAR(shot.first_bin_time, 5408e-6, 1e-12);
    EXPECT_EQ(first_frame(acoustics("00002041", "18", "01", "00")).second.frequency, 692312.5);
}

TEST(Aris1200, ShortensPulsesToItsLimits) {
    const auto pulse = [](const std::string& unit, const std::string& rate, const std::string& frequency) {
        const Options options{{"pulse_unit", unit}};
        const ArisFrame frame = first_frame(acoustics(rate, "50", "01", frequency), options).first;
        EXPECT_EQ(frame.word(684), frame.word(444) < 80 ? 7U : 0U) << "constrained, as 80 are asked for";
        return frame.word(444);
    };
    EXPECT_EQ(pulse("us", "0000803f", "01"), 60U);
    EXPECT_EQ(pulse("us", "0000803f", "00"), 80U);
    EXPECT_EQ(pulse("us", "00002041", "01"), 40U) << "400 over 10 frames a second";
    EXPECT_EQ(pulse("us", "00002041", "00"), 40U);
    EXPECT_EQ(pulse("cycles", "0000803f", "01"), 72U) << "60 us of 1.2 MHz";
    EXPECT_EQ(pulse("cycles", "0000803f", "00"), 55U) << "80 us of 0.6923125 MHz";
    EXPECT_EQ(pulse("cycles", "00002041", "01"), 48U) << "400 x 1.2 MHz over 10 frames a second";
    EXPECT_EQ(pulse("cycles", "00002041", "00"), 27U);
}

TEST(Aris1200, RefusesWhatItCannotDo) {
    const std::string bad[] = {acoustics("0000803f", "18", "03"),
                               acoustics("0000803f", "18", "06"),
                               acoustics("0000803f", "18", "09"),
                               acoustics("0000803f", "18", "00"),
                               acoustics("00003041"),  // 11 a second, but three cycles take 98 ms
                               acoustics("00002041", "18", "01", "01", "b18002")};  // a cycle 1 us short
    ArisBench bench({}, "aris-1200");
    bench.say(words::receiver);
    for (const auto& settings : bad) bench.say(settings);
    EXPECT_EQ(bench.device().counters().rejected, std::size(bad));
    EXPECT_TRUE(bench.frames_within(1s).empty());
    bench.say(words::telephoto);
    EXPECT_EQ(bench.device().counters().rejected, std::size(bad)) << "a lens for 48 beams there is";
}

}  // namespace
}  // namespace echoloop::test
