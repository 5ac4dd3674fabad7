// That pings are rendered ahead of their time when they are known before, and only what was then asked for is
// heard.
#include "emulator/water/ping_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <future>
#include <sstream>

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
    /// `count` pings behind `last`, each when the one before it is rendered.
    void send_behind(std::uint64_t last, std::uint64_t count) {
        for (std::uint64_t number = last + 1; number <= last + count; ++number) {
            send(number);
            settle();
        }
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

TEST_F(PingsAhead, AreTheMoreTheMoreWereAsExpectedButNoMoreThanASecond) {
    pings_.look_ahead(situation_at);
    const auto ahead = [this](std::uint64_t last) {
        std::uint64_t count = 0;
        while (send(last + count + 1)->echogram) ++count;
        settle();
        return count;
    };
    send_behind(0, 9);  // eight were as expected
    EXPECT_EQ(ahead(9), 3);
    send_behind(13, 50);
    EXPECT_EQ(ahead(63), 10);
}

TEST_F(PingsAhead, AreTheSamePings) {
    pings_.look_ahead(situation_at);
    send_behind(0, 20);
    for (std::uint64_t number = 21; number <= 24; ++number) {
        const auto rendering = send(number);
        ASSERT_TRUE(rendering->echogram) << number;
        EXPECT_EQ(rendering->echogram->values, heard(ping_number(number), time_of(number))) << number;
    }
}

TEST_F(PingsAhead, AreNotRenderedAfterSettingsThatChangeThem) {
    std::ostringstream log;
    const auto before = spdlog::default_logger();
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("", std::make_shared<spdlog::sinks::ostream_sink_st>(log)));
    Situation too_many = situation_at({});
    too_many.movers.resize(1);  // more than the scene has: the renderer will say so
    bool failing = false;
    pings_.look_ahead([&](Time time) { return failing ? too_many : situation_at(time); });
    send_behind(0, 9);
    std::promise<void> open;
    threads_.submit({3, {}}, ping_number(0).shot, {},
                    [gate = open.get_future().share()](const Echogram&, const std::string&) { gate.wait(); });
    failing = true;
    send(10);  // those behind it do not look alike any more
    failing = false;
    Ping louder = ping_number(11);
    louder.shot.source_level += 6;
    const auto rendering = send(louder, time_of(11));
    open.set_value();
    settle();
    spdlog::set_default_logger(before);
    EXPECT_TRUE(rendering->echogram);
    EXPECT_EQ(log.str(), "");
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
    send_behind(0, 3);
    const auto rendering = send(louder, time_of(4));
    EXPECT_FALSE(rendering->echogram);
    settle();
    ASSERT_TRUE(rendering->echogram);
    EXPECT_EQ(rendering->echogram->values, heard(louder, time_of(4)));
}

TEST_F(PingsAhead, AreRenderedAnewIfTheyAreSentLaterOnTheWay) {
    pings_.look_ahead(situation_at);
    send_behind(0, 3);
    const auto rendering = send(ping_number(4), time_of(4) + 5ms);
    EXPECT_FALSE(rendering->echogram);
    settle();
    ASSERT_TRUE(rendering->echogram);
    EXPECT_EQ(rendering->echogram->values, heard(ping_number(4), time_of(4) + 5ms));
}

TEST_F(PingsAhead, AreExpectedAnewBehindOneThatWasSentLaterAtRest) {
    const auto sails_off = [](Time time) { return situation_at(std::max(time - 1050ms, Time{})); };
    pings_.look_ahead(sails_off);
    const auto send_at = [&](std::uint64_t number, Time time) {
        auto rendering = pings_.render(ping_number(number), sails_off(time));
        pings_.expect_next(ping_number(number), time, false);
        settle();
        return rendering;
    };
    for (std::uint64_t number = 1; number <= 9; ++number) send_at(number, time_of(number));
    send_at(10, time_of(10) + 5ms);
    EXPECT_TRUE(pings_.render(ping_number(11), sails_off(time_of(11) + 5ms))->echogram);
}

TEST_F(PingsAhead, AreNotHeardOfAfterTheSonarLostItsPower) {
    pings_.look_ahead(situation_at);
    send_behind(0, 3);
    pings_.expect_nothing();
    EXPECT_FALSE(send(4)->echogram);
    settle();
}

}  // namespace
}  // namespace echoloop
