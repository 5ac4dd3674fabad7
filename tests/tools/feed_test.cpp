// What a page asks of a run: pictures no more often than they can be looked at, objects, which cost time to
// draw, seldom, and seldom of all sonars while pings are late.
#include "tools/view/feed.h"

#include <gtest/gtest.h>

#include <utility>

namespace echoloop::view {
namespace {

using namespace std::chrono_literals;

Shot shot_of(std::size_t beams, std::size_t bins) {
    Shot shot;
    shot.bearings.assign(beams, 0.0);
    shot.bins = bins;
    return shot;
}

class AFeed : public testing::Test {
  protected:
    AFeed() { feed.look(1); }

    void heard(const std::string& device, const Shot& shot, Time late) {
        const Echogram echogram{shot, {}, {}, 1500, std::vector<float>(shot.beams() * shot.bins), 0, {}, {}};
        feed.ping({.device = device, .late = late, .echogram = echogram, .movers = movers});
    }

    Feed::Moment now{1h};
    Feed feed{[this] { return now; }};
    const Shot fan = shot_of(256, 500), line = shot_of(1, 400);
    const std::vector<Pose> movers{};
};

TEST_F(AFeed, WantsNothingWhileNobodyLooks) {
    feed.look(0);
    EXPECT_EQ(feed.wants_ping("fan", fan), Wanted::nothing);
    EXPECT_EQ(feed.wants_ping("head", line), Wanted::nothing);
}

TEST_F(AFeed, WantsALargePingTenTimesASecondAndItsObjectsOnce) {
    int pings = 0, objects = 0;
    for (const auto end = now + 10s; now < end; now += 20ms) {
        const Wanted wanted = feed.wants_ping("fan", fan);
        pings += wanted != Wanted::nothing;
        objects += wanted == Wanted::objects;
        if (wanted != Wanted::nothing) heard("fan", fan, 0ms);
    }
    EXPECT_EQ(pings, 100);
    EXPECT_EQ(objects, 10);
}

TEST_F(AFeed, WantsALargePingOnceASecondWhereNobodyHasItOnTheScreen) {
    for (const auto& [looks, count] : {std::pair(Looks{.all_heard = false, .said = {"fan"}}, 10),
                                       {Looks{.all_heard = false, .heard = {"fan"}}, 100}}) {
        feed.look(1, looks);
        int pings = 0;
        now += 1s;
        for (const auto end = now + 10s; now < end; now += 100ms)
            pings += feed.wants_ping("fan", fan) != Wanted::nothing;
        EXPECT_EQ(pings, count);
    }
}

TEST_F(AFeed, WantsEachLineOfAHeadAndObjectsFiveTimesASecond) {
    int objects = 0;
    for (const auto end = now + 2s; now < end; now += 50ms) {
        const Wanted wanted = feed.wants_ping("head", line);
        EXPECT_NE(wanted, Wanted::nothing);
        objects += wanted == Wanted::objects;
    }
    EXPECT_EQ(objects, 10);
}

TEST_F(AFeed, WantsTheObjectsOfEachLineThatShowsThemUntilAPingOfAnySonarIsLate) {
    feed.look(1, {.all_heard = false, .truth = {"head"}});
    for (int i = 0; i < 20; ++i, now += 50ms) EXPECT_EQ(feed.wants_ping("head", line), Wanted::objects);
    heard("fan", fan, 30ms);
    int objects = 0;
    for (int i = 0; i < 40; ++i, now += 50ms) {
        const Wanted wanted = feed.wants_ping("head", line);
        EXPECT_NE(wanted, Wanted::nothing);
        objects += wanted == Wanted::objects;
    }
    EXPECT_EQ(objects, 0) << "the last ones are not five seconds old";
    EXPECT_EQ(feed.wants_ping("head", line), Wanted::objects) << "two seconds without a late ping";
}

TEST_F(AFeed, KeepsALongMessageOfAStreamOnceASecondWhereNobodyHasItOnTheScreen) {
    const Bytes image(20'000), words(500);
    for (const auto& [looks, count] :
         {std::pair(Looks{.all_heard = false}, 3U), {Looks{.all_heard = false, .said = {"fan"}}, 30U}}) {
        feed.look(1, looks);
        feed.take();
        now += 2s;
        std::size_t images = 0, lines = 0, told = 0;
        for (const auto end = now + 3s; now < end; now += 100ms) {
            feed.bytes({.device = "fan", .port = "data", .sent = true, .bytes = image});
            feed.bytes({.device = "fan", .port = "data", .sent = true, .bytes = words});
            for (const Passed& one : feed.take().passed) {
                (one.size == image.size() ? images : lines) += 1;
                told += one.unread;
            }
        }
        EXPECT_EQ(images, count);
        EXPECT_EQ(lines, 30U);
        EXPECT_EQ(told, count == 3 ? 18U : 9U) << "those since the last that was read";
    }
}

TEST_F(AFeed, HasALargePingOfEachFrequencyTenTimesASecondAndTellsThemInTheirOrder) {
    Shot low = fan, high = fan;
    low.frequency = 120e3, high.frequency = 410e3;
    std::size_t told = 0;
    for (const auto end = now + 3s; now < end; now += 100ms) {
        for (const Shot& shot : {high, low}) {
            EXPECT_NE(feed.wants_ping("side", shot), Wanted::nothing);
            const Echogram echogram{shot, {}, {}, 1500, std::vector<float>(shot.beams() * shot.bins),
                                    0,    {}, {}};
            feed.ping(
                {.device = "side", .transmitted = Time(++told), .echogram = echogram, .movers = movers});
        }
        const auto pings = feed.take().pings;
        ASSERT_EQ(pings.size(), 2U);
        EXPECT_EQ(pings.front()->echogram.shot.frequency, high.frequency) << "which came first";
    }
}

TEST_F(AFeed, KeepsBothSidesOfASideScansPing) {
    const Bytes side(20'000);
    feed.look(1, {.all_heard = false});
    std::size_t sides = 0;
    for (const auto end = now + 10s; now < end; now += 70ms) {
        for (int i = 0; i < 2; ++i, now += 1ms)
            feed.bytes({.device = "side", .port = "data", .sent = true, .bytes = side});
        const std::size_t passed = feed.take().passed.size();
        EXPECT_NE(passed, 1U);
        sides += passed;
    }
    EXPECT_GE(sides, 2U * 9);
    EXPECT_LE(sides, 2U * 11);
}

TEST_F(AFeed, WantsALargePingThatIsLateOnceASecond) {
    int pings = 0;
    for (const auto end = now + 10s; now < end; now += 100ms)
        if (feed.wants_ping("fan", fan) != Wanted::nothing) {
            ++pings;
            heard("fan", fan, 30ms);
        }
    EXPECT_EQ(pings, 10);
}

}  // namespace
}  // namespace echoloop::view
