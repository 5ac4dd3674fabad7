// The host of an Oculus: when it is hung up on, what it gets over a slow network, and what the next one
// finds.
#include "tests/emulator/devices/oculus_bench.h"

namespace echoloop::test {
namespace {

constexpr Address first_host{0x7F000001, 40000}, second_host{0x7F000001, 40001};

bool hangs_up(const Send& send) { return send.port == 0 && send.hang_up; }

TEST(OculusStandby, IsTheStateThatAnotherHostFinds) {
    OculusBench bench;
    bench.next_after(fire({}));
    bench.disconnect(0, first_host);
    bench.connect(0, second_host);
    bench.sent();
    const auto sends = bench.sent_within(3s);
    EXPECT_EQ(count(sends, is_result), 0U);
    EXPECT_EQ(count(sends, is_dummy), 3U);
}

TEST(OculusStandby, BeginsWhenTheHostLeaves) {
    OculusBench bench;
    bench.next_after(fire({}));
    bench.disconnect(0, first_host);
    bench.sent_within(100ms);
    EXPECT_EQ(count(bench.sent_within(3s), is_result), 0U);
}

TEST(OculusHost, GetsNoPingThatWasForTheOneBefore) {
    OculusBench bench;
    bench.say(fire({.rate = 2, .range = 30}));
    bench.run_to(10ms);
    ASSERT_TRUE(bench.ping);
    const auto under_way = bench.ping->shot.ping;
    bench.disconnect(0, first_host);
    bench.connect(0, second_host);
    bench.say(fire({.rate = 2, .range = 5}));
    bench.run_to(40ms);
    EXPECT_EQ(bench.ping->shot.ping, under_way) << "one at a time: its echoes are waited for";
    bench.run_to(200ms);
    std::vector<Send> results;
    for (Send& send : bench.sent())
        if (is_result(send)) results.push_back(std::move(send));
    ASSERT_FALSE(results.empty());
    for (const Send& result : results) {
        EXPECT_EQ(result.to, second_host);
        EXPECT_EQ(at<double>(result.bytes, 21), 5) << "the range that it asked for";
    }
}

TEST(OculusHost, ThatIsSilentIsKeptUnlessALimitIsSet) {
    for (const bool limited : {false, true}) {
        OculusBench bench(limited ? Options{{"silence_limit", 1.5}} : Options{});
        bench.say(fire({}));
        bench.run_to(1400ms);
        bench.say(from_hex("534f000000005500000000000000"));  // half a message will do
        bench.run_to(2800ms);
        EXPECT_TRUE(std::ranges::none_of(bench.sent(), hangs_up));
        bench.run_to(4s);
        EXPECT_EQ(count(bench.sent(), hangs_up), limited ? 1U : 0U);
        EXPECT_EQ(count(bench.sent_within(1s), is_result), limited ? 0U : 10U);
    }
    OculusBench mute({{"silence_limit", 1.5}});
    mute.run_to(1600ms);
    EXPECT_EQ(count(mute.sent(), hangs_up), 1U) << "it has never said anything";
}

TEST(OculusHost, IsHungUpOnWhenItFiresIfThatIsAsked) {
    for (const std::string when : {"never", "first", "always"}) {
        OculusBench bench({{"hang_up_on_fire", when}});
        const auto losses_by_fire = [&](Address host) {
            bench.say(fire({}));
            const auto sends = bench.sent_within(500ms);
            const std::size_t lost = count(sends, hangs_up);
            EXPECT_EQ(count(sends, is_result) > 0, lost == 0) << when;
            bench.disconnect(0, host);
            return lost;
        };
        EXPECT_EQ(losses_by_fire(first_host), when == "never" ? 0U : 1U) << when;
        bench.connect(0, second_host);
        EXPECT_EQ(losses_by_fire(second_host), when == "always" ? 1U : 0U) << when;
    }
}

TEST(OculusNetwork, ThatIsSlowBoundsTheRate) {
    OculusBench bench;
    const Seen seen = bench.next_after(fire({.rate = 2, .speed = 5}));
    const Time first = bench.now;
    bench.next();
    EXPECT_NEAR(to_seconds(bench.now - first), 8e-6 * static_cast<double>(seen.bytes.size()) / 5, 0.004);
}

TEST(OculusNetwork, CarriesAResultBeforeTheHostHasIt) {
    for (const int speed : {1, 100}) {
        OculusBench bench;
        bench.say(fire({.speed = speed}));
        bench.run_to(bench.now);
        const Time due = bench.ping->due;
        bench.run_to(due);
        const auto sends = bench.sent();
        const auto result = std::ranges::find_if(sends, is_result);
        ASSERT_NE(result, sends.end());
        const double transfer = 8e-6 * static_cast<double>(result->bytes.size()) / speed;
        EXPECT_NEAR(to_seconds(result->not_before - due), transfer, 1e-6) << speed;
    }
}

TEST(OculusNetwork, ThatTakesSecondsForAResultLetsDummiesPassInBetween) {
    OculusBench bench;
    bench.say(fire({.speed = 1, .flags = 0x4F, .ext_flags = 0x200}, true));
    const auto sends = bench.sent_within(40s);
    const auto results = count(sends, is_result);
    EXPECT_GE(results, 2U);
    EXPECT_LE(results, 4U) << "2.1 MB take 17 s";
    EXPECT_NEAR(static_cast<double>(count(sends, is_dummy)), 40, 1) << "one a second: nobody waits for 10 s";
}

TEST(OculusNetwork, IsFreeForAFasterFireOnceItHasCarriedTheSlowResult) {
    OculusBench bench;
    bench.say(fire({.speed = 1}));
    bench.next();
    bench.say(fire({.rate = 2}));
    bench.run_to(4s);
    Time last{};
    for (const Send& send : bench.sent()) {
        if (!is_result(send)) continue;
        EXPECT_GE(send.not_before, last) << "in their order";
        last = send.not_before;
    }
    EXPECT_LT(bench.shots.size(), 100U) << "2 s of them would else wait";
}

}  // namespace
}  // namespace echoloop::test
