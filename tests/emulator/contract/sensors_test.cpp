// What a unit's sensors and timer add to the truth: how much, how fast, and the same each time.
#include "emulator/contract/sensors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "emulator/contract/ping_pacer.h"

namespace echoloop {
namespace {

using namespace std::chrono_literals;

constexpr Stray both{.drift = 2, .noise = 0.5};

TEST(Sensors, ReadTheTruthWithoutTheEffects) {
    const Sensors none(7, Effects::none());
    for (const Time now : {0s, 1s, 1000s}) {
        EXPECT_EQ(none.read("water", 12.345, both, now), 12.345);
        EXPECT_EQ(none.read_bearing("compass", 359.9, both, now), 359.9);
        EXPECT_EQ(none.lateness({1us, 100}, static_cast<std::uint64_t>(now.count())), 0ns);
    }
}

TEST(Sensors, ReadTheSameAtTheSameTimeAndOtherUnitsSomethingElse) {
    const Sensors one(7, {}), same(7, {}), other(8, {});
    EXPECT_EQ(one.read("water", 10, both, 5s), same.read("water", 10, both, 5s));
    EXPECT_NE(one.read("water", 10, both, 5s), other.read("water", 10, both, 5s));
    EXPECT_NE(one.read("water", 10, both, 5s), one.read("board", 10, both, 5s));
    EXPECT_NE(one.read("water", 10, both, 5s), one.read("water", 10, both, 5s + 1ns));
}

struct Spread {
    double mean = 0, deviation = 0;
};
template <class Value>
Spread spread_of(int count, const Value& value) {
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) sum += value(i), squares += value(i) * value(i);
    const double mean = sum / count;
    return {mean, std::sqrt(squares / count - mean * mean)};
}

TEST(Sensors, HaveTheDeviationsOfTheirKind) {
    const Sensors unit(7, {});
    const auto drift = spread_of(4000, [&](int i) { return unit.read("a", 20, {.drift = 2}, i * 30s); });
    EXPECT_NEAR(drift.mean, 20, 0.2);
    EXPECT_NEAR(drift.deviation, 2, 0.1);
    const auto noise = spread_of(4000, [&](int i) { return unit.read("a", 20, {.noise = 0.5}, i * 1ms); });
    EXPECT_NEAR(noise.mean, 20, 0.03);
    EXPECT_NEAR(noise.deviation, 0.5, 0.02);
}

TEST(Sensors, DriftIsSlow) {
    const Sensors unit(7, {});
    for (int i = 0; i < 6000; ++i) {
        const double step =
            unit.read("a", 0, {.drift = 1}, i * 100ms + 100ms) - unit.read("a", 0, {.drift = 1}, i * 100ms);
        ASSERT_LT(std::abs(step), 0.02) << i;
    }
}

TEST(Sensors, ReadInStepsOfTheirConverter) {
    const Sensors unit(7, {});
    for (int i = 0; i < 100; ++i) {
        const double steps = unit.read("a", 10, {.drift = 1, .noise = 1, .step = 0.0625}, i * 1s) / 0.0625;
        EXPECT_EQ(steps, std::round(steps));
    }
}

TEST(Sensors, SayAReadingUntilTheNextOne) {
    const Sensors unit(7, {});
    std::set<double> read;
    for (int i = 0; i < 200; ++i)
        read.insert(unit.read("a", 10, {.drift = 1, .noise = 1, .every = 0.5}, i * 10ms));
    EXPECT_EQ(read.size(), 4U);
}

TEST(Sensors, BearingsStayOnTheCircle) {
    const Sensors unit(7, {});
    std::set<bool> sides;
    for (int i = 0; i < 1000; ++i) {
        const double read = unit.read_bearing("compass", 0, {.noise = 1}, i * 1s);
        ASSERT_TRUE(read >= 0 && read < 360) << read;
        sides.insert(read < 180);
    }
    EXPECT_EQ(sides.size(), 2U);
}

/// The starts of pings at an interval of a second that take half of it.
std::vector<Time> starts(PingPacer pacer, int count) {
    std::vector<Time> all;
    pacer.start(0s, 1s);
    for (int i = 0; i < count; ++i) {
        const Time now = pacer.wake();
        EXPECT_TRUE(pacer.begin(now));
        all.push_back(now);
        EXPECT_TRUE(pacer.end(now + 500ms, 1s));
    }
    return all;
}

TEST(Sensors, PingsComeLateWithoutLosingTheirPlaces) {
    const Jitter jitter{33ns, 2};
    std::set<Time> late;
    int n = 0;
    for (const Time start : starts(PingPacer(Sensors(7, {}), jitter), 200)) late.insert(start - n++ * 1s);
    EXPECT_EQ(late, (std::set<Time>{0ns, 33ns, 66ns}));
    n = 0;
    for (const Time start : starts(PingPacer(Sensors(7, Effects::none()), jitter), 20))
        EXPECT_EQ(start, n++ * 1s);
}

}  // namespace
}  // namespace echoloop
