// What a session makes of a ping beside rendering it: its key, late echoes of the ping before, pulses of
// others.
#include "emulator/run/session.h"

#include <gtest/gtest.h>

#include <numeric>

#include "emulator/contract/random_key.h"
#include "render/renderer.h"
#include "tests/render/meshes.h"

namespace echoloop {
namespace {

constexpr double c = 1500, interval = 1;  // s: 750 m

/// Pings twice, a second apart, and keeps what it hears.
class Pinger : public Device {
  public:
    Pinger(std::vector<Echogram>& heard, std::function<void()> done)
        : heard_(heard), done_(std::move(done)) {}
    std::vector<Port> ports() const override { return {}; }
    Actions started(Time now) override { return ping(now, now + from_seconds(interval)); }
    Actions woken(Time now) override { return ping(now, {}); }
    Actions received(const Received&, Time) override { return {}; }
    Actions heard(const Echogram& echogram, Time) override {
        heard_.push_back(echogram);
        if (heard_.size() == 2) done_();
        return {};
    }
    void reconnected(std::size_t) override {}
    DeviceCounters counters() const override { return {}; }

  private:
    static Actions ping(Time now, std::optional<Time> wake) {
        Shot shot;
        shot.bearings = {0};
        shot.beam_width = shot.fan_height = deg_to_rad(10);
        shot.bins = 500;
        shot.bin_interval = 2 * 50 / c / 500;
        shot.frequency = 100e3;
        shot.pulse_length = 1e-4;
        shot.source_level = 200;
        shot.interval = interval;
        return {{}, Ping{shot, now + from_seconds(2 * 50 / c)}, wake};
    }
    std::vector<Echogram>& heard_;
    std::function<void()> done_;
};

Located at_rest(Time time) { return {time, {}, {}}; }

/// Wants to be woken every 20 ms, and keeps what time it was told.
class Ticker : public Device {
  public:
    static constexpr Time period = std::chrono::milliseconds(20);

    Ticker(std::vector<Time>& told, std::function<void()> done) : told_(told), done_(std::move(done)) {}
    std::vector<Port> ports() const override { return {}; }
    Actions started(Time now) override { return {{}, {}, now + period}; }
    Actions woken(Time now) override {
        told_.push_back(now);
        if (told_.size() == 20) done_();
        return {{}, {}, now + period};
    }
    Actions received(const Received&, Time) override { return {}; }
    Actions heard(const Echogram&, Time) override { return {}; }
    void reconnected(std::size_t) override {}
    DeviceCounters counters() const override { return {}; }

  private:
    std::vector<Time>& told_;
    std::function<void()> done_;
};

// So that pings keep their pace though the machine wakes this program a little late each time.
TEST(Sessions, DoWhatWasPlannedWhenItWasPlannedUnlessTheyWakeFarTooLate) {
    const auto scene = test::scene_of({test::wall_at(5, 4, -4, 4, -4)});
    asio::io_context io;
    RealClock clock(io);
    SharedWater shared{{}, Effects::none(), 1, scene->bounds(), CrossTalk({}, Effects::none())};
    RenderThreads renderer([&] { return std::make_unique<Renderer>(scene, Water{}); });
    std::vector<Time> told;
    Session session(
        io, clock, renderer, shared, "ticker", std::make_unique<Ticker>(told, [&io] { io.stop(); }),
        std::vector<std::unique_ptr<Transport>>{}, [](Time) { return Pose(); }, at_rest);
    session.start();
    io.run();
    std::size_t punctual = 0;
    for (std::size_t i = 1; i < told.size(); ++i) {
        const Time late = told[i] - told[i - 1] - Ticker::period;
        if (late == Time{})
            ++punctual;
        else
            EXPECT_GE(late, std::chrono::milliseconds(1));
    }
    EXPECT_GT(punctual, 0U);
}

/// Asks once where it was at two moments, and keeps what it is told.
class Asker : public Device {
  public:
    Asker(std::vector<Located>& told, std::function<void()> done) : told_(told), done_(std::move(done)) {}
    std::vector<Port> ports() const override { return {}; }
    Actions started(Time now) override {
        Actions actions;
        actions.locate = {now - std::chrono::seconds(1), now};
        return actions;
    }
    Actions located(std::span<const Located> places, Time) override {
        told_.assign(places.begin(), places.end());
        done_();
        return {};
    }
    Actions woken(Time) override { return {}; }
    Actions received(const Received&, Time) override { return {}; }
    Actions heard(const Echogram&, Time) override { return {}; }
    void reconnected(std::size_t) override {}
    DeviceCounters counters() const override { return {}; }

  private:
    std::vector<Located>& told_;
    std::function<void()> done_;
};

TEST(Sessions, TellADeviceWhereItWasAtTheMomentsThatItAskedFor) {
    const auto scene = test::scene_of({test::wall_at(5, 4, -4, 4, -4)});
    asio::io_context io;
    RealClock clock(io);
    SharedWater shared{{}, Effects::none(), 1, scene->bounds(), CrossTalk({}, Effects::none())};
    RenderThreads renderer([&] { return std::make_unique<Renderer>(scene, Water{}); });
    std::vector<Located> told;
    Session session(
        io, clock, renderer, shared, "asker", std::make_unique<Asker>(told, [&io] { io.stop(); }),
        std::vector<std::unique_ptr<Transport>>{}, [](Time) { return Pose(); },
        [](Time time) {
            return Located{time, {{2 * to_seconds(time), 0, 0}, {}}, {{2, 0, 0}, {}}};
        });
    session.start();
    io.run();
    ASSERT_EQ(told.size(), 2U);
    EXPECT_EQ(told[1].time - told[0].time, std::chrono::seconds(1));
    EXPECT_DOUBLE_EQ(told[1].world_from_device.position.x - told[0].world_from_device.position.x, 2);
    EXPECT_EQ(told[0].motion.velocity.x, 2);
}

/// Two sonars 30 m apart; the first looks at a wall 760 m away, the second looks away from it.
class TwoSonars : public testing::Test {
  protected:
    std::array<std::vector<Echogram>, 2> run(const Effects& effects) {
        const auto scene = test::scene_of({test::wall_at(760, 200, -200, 200, -5)});
        Water water;
        water.sound_speed = c;
        RendererOptions options;
        options.effects = effects;
        options.surface.reset();
        asio::io_context io;
        RealClock clock(io);
        SharedWater shared{water, effects, 1, scene->bounds(), CrossTalk(water, effects)};
        std::array<std::vector<Echogram>, 2> heard;
        std::vector<std::unique_ptr<Session>> sessions;
        RenderThreads renderer([&] { return std::make_unique<Renderer>(scene, water, options); });
        int busy = 2;
        const auto done = [&] {
            if (--busy == 0) io.stop();
        };
        const Pose poses[2] = {{}, {{-30, 0, 0}, axis_angle({0, 0, 1}, std::numbers::pi)}};
        for (std::size_t i = 0; i < 2; ++i)
            sessions.push_back(std::make_unique<Session>(
                io, clock, renderer, shared, i == 0 ? "one" : "two", std::make_unique<Pinger>(heard[i], done),
                std::vector<std::unique_ptr<Transport>>{}, [pose = poses[i]](Time) { return pose; },
                at_rest));
        for (auto& session : sessions) session->start();
        io.run();
        return heard;
    }

    static Effects only(std::initializer_list<Effect> on) {
        Effects effects = Effects::none();
        for (const Effect effect : on) effects.set(effect);
        return effects;
    }
    static double power(const Echogram& echogram) {
        return std::accumulate(echogram.values.begin(), echogram.values.end(), 0.0);
    }
};

TEST_F(TwoSonars, HearNothingOfEachOtherAndOfTheLastPing) {
    const auto heard = run(Effects::none());
    for (const auto& pings : heard)
        for (const Echogram& echogram : pings) EXPECT_EQ(power(echogram), 0);
    EXPECT_EQ(heard[0][0].shot.random_key, random_key(1, "one"));
    EXPECT_EQ(heard[1][1].shot.random_key, random_key(1, "two"));
}

// The wall at 760 m shows in the second ping, 750 m nearer.
TEST_F(TwoSonars, SecondPingHearsTheLateEchoOfTheFirst) {
    const auto heard = run(only({Effect::second_time_around}));
    EXPECT_EQ(power(heard[0][0]), 0);
    const auto levels = heard[0][1].beam(0);
    const auto strongest = std::max_element(levels.begin(), levels.end()) - levels.begin();
    EXPECT_GT(levels[static_cast<std::size_t>(strongest)], 0);
    EXPECT_NEAR(heard[0][1].bin_range(static_cast<std::size_t>(strongest)), 10,
                3);  // the beam is 10 degrees wide
    EXPECT_EQ(power(heard[1][1]), 0);
}

TEST_F(TwoSonars, HearEachOthersPulses) {
    const auto heard = run(only({Effect::cross_talk, Effect::beam_pattern, Effect::side_lobes}));
    for (const auto& pings : heard)
        EXPECT_GT(power(pings[0]), 0);  // those were sent one right after the other
}

}  // namespace
}  // namespace echoloop
