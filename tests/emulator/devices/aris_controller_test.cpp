// The ARIS sonars on the bench: controllers that are silent, go, and come after others.
#include <functional>

#include "tests/emulator/devices/aris_bench.h"

namespace echoloop::test {
namespace {

namespace words = aris_words;

TEST(ArisController, ThatIsSilentHasGone) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    for (int s = 0; s < 15; ++s) bench.say(words::ping), bench.run_to(bench.now + 1s);
    EXPECT_EQ(bench.frames_within(1s).size(), 15U) << "pings keep it";
    bench.run_to(bench.now + 10s);
    EXPECT_EQ(state(bench.beacons_within(2s).back()), 0U) << "available";
    EXPECT_TRUE(bench.frames_within(1s).empty());
}

TEST(ArisController, ThatIsSilentIsHungUpOn) {
    ArisBench bench;
    bench.say(words::ping);
    bench.run_to(9900ms);
    const auto hung_up = [](const Send& send) { return send.port == 0 && send.hang_up; };
    EXPECT_TRUE(std::ranges::none_of(bench.sent(), hung_up));
    bench.run_to(10s);
    const auto sent = bench.sent();
    EXPECT_EQ(std::ranges::count_if(sent, hung_up), 1);
}

TEST(ArisController, ThatNeverSaysAWordIsHungUpOnToo) {
    ArisBench bench;
    bench.run_to(9900ms);
    const auto hung_up = [](const Send& send) { return send.port == 0 && send.hang_up; };
    EXPECT_TRUE(std::ranges::none_of(bench.sent(), hung_up));
    bench.run_to(10s);
    EXPECT_TRUE(std::ranges::any_of(bench.sent(), hung_up));
    EXPECT_EQ(state(bench.beacons_within(2s).back()), 0U) << "available";
}

TEST(ArisController, ThatLeavesTakesItsFramesAlong) {
    ArisBench bench;
    bench.say(words::receiver);
    bench.say(words::acoustics);
    EXPECT_FALSE(bench.frames_within(1s).empty());
    bench.device().disconnected(0, {}, bench.now);
    bench.frames_within(50ms);
    EXPECT_TRUE(bench.frames_within(1s).empty());
    EXPECT_EQ(state(bench.beacons_within(2s).back()), 0U) << "available";
}

TEST(ArisController, FindsNothingOfTheLastOneAndFramesFromOneOn) {
    ArisBench bench;
    for (int controller = 0; controller < 3; ++controller) {
        EXPECT_TRUE(bench.frames_within(1s).empty());
        bench.say(words::receiver);
        bench.say(words::acoustics);
        const auto frames = bench.frames_within(200ms);
        ASSERT_GE(frames.size(), 2U);
        for (std::uint32_t i = 0; i < 2; ++i) {
            EXPECT_EQ(frames[i].number, i + 1) << "the maker's example ends at a number";
            EXPECT_EQ(frames[i].word(0), i + 1) << "in the header";
        }
        bench.run_to(bench.now + 30ms);
        bench.connect_anew();
    }
}

TEST(ArisController, HearsNoEchoOfThePingsOfTheLastOne) {
    ArisBench bench;
    const auto ping = [&bench] {
        bench.say(words::receiver);
        bench.say(words::acoustics);
        while (!bench.ping) bench.run_to(bench.now + 1ms);
        return *bench.ping;
    };
    const Ping stale = ping();
    bench.connect_anew();
    bench.ping.reset();
    const Ping own = ping();
    const auto sent = [&bench, &own](const Ping& of) {
        return bench.device().heard(echo_of(of.shot, 0, 0), own.due).send.size();
    };
    EXPECT_EQ(sent(stale), 0U);
    EXPECT_GT(sent(own), 0U);
}

TEST(ArisController, ThatGoesTakesPartsAlongHoweverFarApart) {
    const auto parts_within = [](ArisBench& bench, Time time) {
        bench.sent();
        bench.run_to(bench.now + time);
        return std::ranges::count_if(bench.sent(), [](const Send& send) { return send.port == 2; });
    };
    const std::pair<const char*, std::function<void(ArisBench&)>> ends[] = {
        {"stop", [](ArisBench& bench) { bench.say(words::nobody); }},
        {"hang-up", [](ArisBench& bench) { bench.disconnect(0, {}); }},
        {"next controller", [](ArisBench& bench) { bench.connect_anew(); }}};
    for (const auto& [what, end] : ends) {
        ArisBench bench;
        bench.say(words::receiver);
        bench.say("0000000c 0802 2208 0a06 0801 10a08d06");  // 100 000 us
        bench.say(words::acoustics);
        EXPECT_NEAR(static_cast<double>(parts_within(bench, 1050ms)), 10, 1) << "of more than 60";
        end(bench);
        EXPECT_EQ(parts_within(bench, 500ms), 0) << what;
        bench.connect_anew();
        bench.say(words::receiver);
        bench.say(words::acoustics);
        EXPECT_GE(bench.frames_within(300ms).size(), 1U) << what << ": the next does not wait for them";
    }
}

}  // namespace
}  // namespace echoloop::test
