// Late echoes in the ping after: when they are asked for, and where they show (V12 of the reference values).
#include "emulator/water/second_time_around.h"

#include <gtest/gtest.h>

#include <numeric>

#include "emulator/contract/random_key.h"
#include "render/acoustics/chain.h"

namespace echoloop {
namespace {

constexpr double c = 1500, far_away = 1e6;

Water water() {
    Water out;
    out.sound_speed = c;
    return out;
}

/// A window of 50 m in 500 bins; the next ping follows after 2 * 50 m / c.
Shot shot_of(std::size_t beams = 1, std::size_t bins = 500) {
    Shot shot;
    for (std::size_t i = 0; i < beams; ++i) shot.bearings.push_back(-1 + 0.01 * static_cast<double>(i));
    shot.beam_width = 0.01;
    shot.fan_height = 0.3;
    shot.bins = bins;
    shot.bin_interval = 2 * 50 / c / static_cast<double>(bins);
    shot.frequency = 330e3;
    shot.pulse_length = 50e-6;
    shot.source_level = 210;
    shot.interval = 2 * 50 / c;
    return shot;
}

Echogram echogram_of(const Shot& shot) {
    Echogram out;
    out.shot = shot;
    out.sound_speed = c;
    out.values.assign(shot.bearings.size() * shot.bins, 0.0F);
    return out;
}

/// The echogram of `shot` where a single bin at the slant range `range` has power 7.
Echogram echo_at(const Shot& shot, double range) {
    Echogram out = echogram_of(shot);
    const auto bin = static_cast<std::size_t>((2 * range / c - shot.first_bin_time) / shot.bin_interval);
    for (std::size_t beam = 0; beam < out.beams(); ++beam) out.values.at(beam * shot.bins + bin) = 7;
    return out;
}

TEST(SecondTimeAround, ListensWhileTheNextPingDoes) {
    const Shot shot = shot_of();
    const auto late = late_shot(shot, water(), {}, far_away);
    ASSERT_TRUE(late);
    EXPECT_DOUBLE_EQ(late->first_bin_time, shot.interval);
    EXPECT_DOUBLE_EQ(late->bin_interval * static_cast<double>(late->bins), 500 * shot.bin_interval);
    EXPECT_EQ(late->ping, shot.ping);
    EXPECT_NE(late->random_key, shot.random_key);
}

// V12: an echo from 60 m shows at 60 - 50 m in the next ping, and nowhere else.
TEST(SecondTimeAround, EchoShowsAtItsRangeLessThatOfTheInterval) {
    const Shot shot = shot_of();
    SecondTimeAround kept;
    kept.keep(4, echo_at(*late_shot(shot, water(), {}, far_away), 60.05));
    Echogram next = echogram_of(shot);
    next.values[100] = 1;
    kept.add_to(5, next);
    EXPECT_EQ(next.values[100], 8);  // 10.0..10.1 m, on top of what is there
    EXPECT_EQ(std::accumulate(next.values.begin(), next.values.end(), 0.0F), 8);
}

TEST(SecondTimeAround, LateEchoesAreHeardOnceAndByTheNextPingOnly) {
    const Shot shot = shot_of();
    const Echogram late = echo_at(*late_shot(shot, water(), {}, far_away), 60.05);
    SecondTimeAround kept;
    kept.keep(4, late);
    Echogram same = echogram_of(shot), next = same, after = same;
    kept.add_to(4, same);  // its own ping may be delivered after they are known
    EXPECT_EQ(same.values[100], 0);
    kept.add_to(5, next);
    kept.add_to(6, after);
    EXPECT_EQ(next.values[100], 7);
    EXPECT_EQ(after.values[100], 0);
    kept.keep(6, late);
    kept.keep(7, echogram_of(late.shot));  // its own late echoes are rendered before ping 7 is delivered
    Echogram seventh = echogram_of(shot);
    kept.add_to(7, seventh);
    EXPECT_EQ(seventh.values[100], 7);
    kept.keep(7, late);
    kept.add_to(9, after);  // the one between was not delivered
    EXPECT_EQ(after.values[100], 0);
}

TEST(SecondTimeAround, ManyBeamsAndBinsAreThinned) {
    const Shot shot = shot_of(200, 2000);
    const auto late = late_shot(shot, water(), {}, far_away);
    ASSERT_TRUE(late);
    EXPECT_EQ(late->bearings.size(), 100U);
    EXPECT_EQ(late->bins, 512U);
    SecondTimeAround kept;
    kept.keep(1, echo_at(*late, 60));
    Echogram next = echogram_of(shot);
    kept.add_to(2, next);
    for (std::size_t beam = 0; beam < 200; ++beam) {
        const auto levels = next.beam(beam);
        const auto first = std::find(levels.begin(), levels.end(), 7.0F) - levels.begin();
        EXPECT_NEAR(next.bin_range(static_cast<std::size_t>(first)), 10, 50.0 / 512) << beam;
        EXPECT_EQ(std::count(levels.begin(), levels.end(), 7.0F) / 4,
                  1);  // 3.9 bins of the ping to one late one
    }
}

// Of a ping whose noise is 1000 uPa^2 in the mean, 20 dB below are 10 uPa^2.
class FaintLateEchoes : public ::testing::Test {
  protected:
    /// Ping 2 hears, 10 m away, an echo of 7 uPa^2 of ping 1.
    Echogram second_ping(double noise_power) {
        EXPECT_TRUE(kept.asks(1, late, there));
        kept.keep(1, echo_at(late, 60.05));
        EXPECT_TRUE(kept.asks(2, late, there));  // nobody has heard yet how faint it is
        Echogram next = echogram_of(shot_of());
        next.noise_power = noise_power;
        kept.add_to(2, next);
        return next;
    }

    const Shot late = *late_shot(shot_of(), water(), {}, far_away);
    Situation there = Situation({1, 2, -3}, axis_angle({0, 0, 1}, 0.3));
    SecondTimeAround kept;
};

TEST_F(FaintLateEchoes, AreLeftOut) {
    const Echogram next = second_ping(1000);
    EXPECT_EQ(std::accumulate(next.values.begin(), next.values.end(), 0.0F), 0);
}

TEST_F(FaintLateEchoes, AreLookedForAgainAtTheThirtySecondPing) {
    second_ping(1000);
    std::uint64_t ping = 3;
    for (; ping < 34; ++ping) EXPECT_FALSE(kept.asks(ping, late, there)) << ping;
    EXPECT_TRUE(kept.asks(ping, late, there));
    kept.keep(ping, echo_at(late, 60.05));
    Echogram next = echogram_of(shot_of());
    kept.add_to(ping + 1, next);  // without noise it is heard
    EXPECT_EQ(next.values[100], 7);
    EXPECT_TRUE(kept.asks(ping + 1, late, there));
}

TEST_F(FaintLateEchoes, AreHeardWhereTheNoiseIsLow) {
    EXPECT_EQ(second_ping(600).values[100], 7);
    EXPECT_TRUE(kept.asks(3, late, there));
}

TEST_F(FaintLateEchoes, AreLookedForWhereTheViewIsAnother) {
    there.movers = {Pose{{50, 0, 0}, {}}};
    second_ping(1000);
    const auto asks = [&](const Shot& shot, const Situation& situation) {
        return SecondTimeAround(kept).asks(3, shot, situation);
    };
    const auto with = [this](const auto& change) {
        Situation changed = there;
        change(changed);
        return changed;
    };
    EXPECT_FALSE(asks(late, there));
    EXPECT_FALSE(asks(late, with([](Situation& s) { s.world_from_sonar.position.x += 0.4; })));
    EXPECT_TRUE(asks(late, with([](Situation& s) { s.world_from_sonar.position.x += 0.6; })));
    EXPECT_TRUE(asks(late, with([](Situation& s) { s.movers[0].position.z -= 0.6; })));
    const auto turned = [](double degrees) {
        return [degrees](Situation& s) {
            s.world_from_sonar.orientation =
                s.world_from_sonar.orientation * axis_angle({0, 1, 0}, deg_to_rad(degrees));
        };
    };
    EXPECT_FALSE(asks(late, with(turned(0.9))));
    EXPECT_TRUE(asks(late, with(turned(1.1))));
    Shot other = late;
    other.ping = 3;
    EXPECT_FALSE(asks(other, there));
    other.pan = deg_to_rad(1.8);  // a step of a scanning head
    EXPECT_TRUE(asks(other, there));
    EXPECT_FALSE(asks(other, with([](Situation& s) {
                          s.world_from_sonar.orientation = s.world_from_sonar.orientation *
                                                           axis_angle({0, 0, 1}, deg_to_rad(1.8));  // back
                      })));
    other = late;
    other.source_level += 1;
    EXPECT_TRUE(asks(other, there));
}

TEST(SecondTimeAround, IsNotAskedForWhereItCannotMatter) {
    const Shot shot = shot_of();
    EXPECT_FALSE(late_shot(shot, water(), Effects{}.set(Effect::second_time_around, false), far_away));
    EXPECT_FALSE(late_shot(shot, water(), {}, 49.9));  // nothing is that far away
    EXPECT_TRUE(late_shot(shot, water(), {}, 50.1));
    Shot alone = shot;
    alone.interval = 0;
    EXPECT_FALSE(late_shot(alone, water(), {}, far_away));
    Shot slow = shot;
    slow.interval = 59.99;
    EXPECT_FALSE(late_shot(slow, water(), {}, 1e9));
    // 2.25 MHz loses 162 dB on the way to 50 m and back.
    Shot weak = shot;
    weak.frequency = 2.25e6;
    EXPECT_FALSE(late_shot(weak, water(), {}, far_away));
    EXPECT_TRUE(late_shot(weak, water(), Effects{}.set(Effect::noise, false), far_away));
}

// A pulse of many bins: the chain must not be asked for the impossible to keep the late ping silent.
TEST(SecondTimeAround, ALongPulsePassesTheAcousticChain) {
    Shot shot = shot_of(64, 500);
    shot.pulse_length = 2e-3;
    const auto late = late_shot(shot, water(), {}, far_away);
    ASSERT_TRUE(late);
    ASSERT_GT(late->pulse_length, 3 * late->bin_interval);
    std::vector<float> values(late->bearings.size() * late->bins, 1.0F);
    const double noise = AcousticChain(Effects{}).apply(*late, {}, c, {}, values);
    EXPECT_LT(noise, 1e-12);
    for (const float value : values) ASSERT_TRUE(std::isfinite(value));
}

TEST(RandomKey, DiffersByNameAndBySeed) {
    static_assert(random_key(1, "micron") == random_key(1, "micron"));
    EXPECT_NE(random_key(1, "micron"), random_key(1, "micron2"));
    EXPECT_NE(random_key(1, "micron"), random_key(2, "micron"));
    EXPECT_NE(random_key(1, "port"), random_key(1, "trop"));
}

}  // namespace
}  // namespace echoloop
