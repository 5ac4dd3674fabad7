// That pings are rendered ahead of their time when they are known before, and only what was then asked for is
// heard.
#include "emulator/ping_renderer.h"

#include <gtest/gtest.h>

#include "render/renderer.h"
#include "tests/render/meshes.h"

namespace echoloop {
namespace {

using namespace std::chrono_literals;

Ping ping_number(std::uint64_t number) {
    Shot shot;
    shot.bearings = {-0.1, 0, 0.1};
    shot.beam_width = shot.fan_height = deg_to_rad(5);
    shot.bins = 100;
    shot.bin_interval = 2 * 10 / 1500.0 / 100;
    shot.frequency = 500e3;
    shot.pulse_length = 1e-4;
    shot.source_level = 200;
    shot.ping = number;
    shot.random_key = 7;
    shot.interval = 0.1;
    return {shot, 100ms * static_cast<int>(number) + 20ms};
}

/// A sonar that sails towards a wall at 1 m/s and pings at 10 Hz.
class PingsAhead : public testing::Test {
  protected:
    static Situation situation_at(Time time) { return Situation({to_seconds(time), 0, 0}, {}); }
    static Time time_of(std::uint64_t number) { return 100ms * static_cast<int>(number); }
    static std::unique_ptr<Renderer> make() {
        return std::make_unique<Renderer>(test::scene_of({test::wall_at(5, 4, -4, 4, -4)}), Water{});
    }

    std::shared_ptr<Rendering> send(const Ping& ping, Time time) {
        auto rendering = pings_.render(ping, situation_at(time));
        pings_.expect_next(ping, time, false);
        return rendering;
    }
    std::shared_ptr<Rendering> send(std::uint64_t number) {
        return send(ping_number(number), time_of(number));
    }
    /// Until all that has been submitted so far is rendered.
    void settle() {
        bool settled = false;
        threads_.submit({2, 1h}, ping_number(0).shot, {}, [&](const Echogram&, const std::string&) {
            clock_.inbox().post([&] { settled = true; });
        });
        while (!settled) io_.run_one();
    }
    static std::vector<float> heard(const Ping& ping, Time time) {
        return make()->render(ping.shot, situation_at(time)).values;
    }

    asio::io_context io_;
    RealClock clock_{io_};
    RenderThread threads_{[](RenderThread::Lane) { return make(); }};
    PingRenderer pings_{clock_, threads_, 1, "sonar"};
};

TEST_F(PingsAhead, AreRenderedBeforeTheyAreSentOnceOneWasAsExpected) {
    pings_.look_ahead(situation_at);
    for (std::uint64_t number = 1; number <= 4; ++number) {
        const auto rendering = send(number);
        EXPECT_EQ(rendering->echogram.has_value(), number > 2) << number;
        settle();
        ASSERT_TRUE(rendering->echogram) << number;
        EXPECT_EQ(rendering->echogram->values, heard(ping_number(number), time_of(number))) << number;
    }
    EXPECT_NE(heard(ping_number(3), time_of(3)), heard(ping_number(3), time_of(4))) << "nothing to compare";
}

TEST_F(PingsAhead, AreNotWhereNobodyKnowsWhereTheSonarWillBe) {
    for (std::uint64_t number = 1; number <= 4; ++number) {
        EXPECT_FALSE(send(number)->echogram) << number;
        settle();
    }
}

TEST_F(PingsAhead, AreRenderedAnewIfTheyAreNotWhatWasExpected) {
    pings_.look_ahead(situation_at);
    Ping louder = ping_number(4);
    louder.shot.source_level += 6;
    for (std::uint64_t number = 1; number <= 3; ++number) send(number);
    settle();
    const auto rendering = send(louder, time_of(4));
    EXPECT_FALSE(rendering->echogram);
    settle();
    ASSERT_TRUE(rendering->echogram);
    EXPECT_EQ(rendering->echogram->values, heard(louder, time_of(4)));
}

TEST_F(PingsAhead, AreRenderedAnewIfTheyAreSentLaterOnTheWay) {
    pings_.look_ahead(situation_at);
    for (std::uint64_t number = 1; number <= 3; ++number) send(number);
    settle();
    const auto rendering = send(ping_number(4), time_of(4) + 5ms);
    EXPECT_FALSE(rendering->echogram);
    settle();
    ASSERT_TRUE(rendering->echogram);
    EXPECT_EQ(rendering->echogram->values, heard(ping_number(4), time_of(4) + 5ms));
}

TEST_F(PingsAhead, AreNotHeardOfAfterTheSonarLostItsPower) {
    pings_.look_ahead(situation_at);
    for (std::uint64_t number = 1; number <= 3; ++number) send(number);
    settle();
    pings_.expect_nothing();
    EXPECT_FALSE(send(4)->echogram);
    settle();
}

}  // namespace
}  // namespace echoloop
