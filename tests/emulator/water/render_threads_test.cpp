// In which order pings are rendered, and that the number of threads changes nothing in them.
#include "emulator/water/render_threads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <optional>

#include "render/renderer.h"
#include "tests/render/meshes.h"

namespace echoloop {
namespace {

using testing::ElementsAre;

Shot shot_of(std::size_t beams, std::uint64_t ping = 0) {
    Shot shot;
    for (std::size_t i = 0; i < beams; ++i) shot.bearings.push_back(0.02 * static_cast<double>(i));
    shot.beam_width = shot.fan_height = deg_to_rad(5);
    shot.bins = 100;
    shot.bin_interval = 2 * 10 / 1500.0 / 100;
    shot.frequency = 500e3;
    shot.pulse_length = 1e-4;
    shot.source_level = 200;
    shot.ping = ping;
    shot.random_key = 7;
    return shot;
}

Shot rows() {
    Shot shot = shot_of(4);
    shot.elevations = {-0.02, 0, 0.02};
    return shot;
}

class RenderThreadsTest : public testing::Test {
  protected:
    void start(std::size_t threads) {
        threads_.emplace([this] { return std::make_unique<Renderer>(scene_, Water{}); }, threads);
    }
    /// Notes `name` when the ping is rendered.
    void submit(const std::string& name, std::size_t sonar, int needed, const Shot& shot = shot_of(2)) {
        threads_->submit({sonar,
                          std::chrono::milliseconds(needed),
                          shot,
                          {},
                          [this, name](const Echogram&, const std::string&) { note(name); }});
    }
    /// Keeps a thread busy until release(); returns when it is.
    void block(std::size_t sonar, const Shot& shot = shot_of(2)) {
        std::promise<void> begun;
        threads_->submit({sonar, {}, shot, {}, [&](const Echogram&, const std::string&) {
                              begun.set_value();
                              gate_.wait();
                          }});
        begun.get_future().wait();
    }
    void release() { open_.set_value(); }
    std::vector<std::string> wait_for(std::size_t count) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return rendered_.size() >= count; });
        return rendered_;
    }

  private:
    void note(const std::string& name) {
        const std::lock_guard lock(mutex_);
        rendered_.push_back(name);
        changed_.notify_all();
    }

    std::shared_ptr<const Scene> scene_ = test::scene_of({test::wall_at(5, 4, -4, 4, -4)});
    std::promise<void> open_;
    std::shared_future<void> gate_ = open_.get_future().share();
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> rendered_;
    std::optional<RenderThreads> threads_;  // last: ended first
};

TEST_F(RenderThreadsTest, RenderWhatIsNeededFirst) {
    start(1);
    block(9);
    submit("at 30", 1, 30);
    submit("at 10", 2, 10, shot_of(4));
    submit("at 20", 3, 20, shot_of(1));
    release();
    EXPECT_THAT(wait_for(3), ElementsAre("at 10", "at 20", "at 30"));
}

TEST_F(RenderThreadsTest, RenderPingsOfOneSonarAsTheyAreNeededAndElseInTheirOrder) {
    start(1);
    block(9);
    submit("its first, at 30", 1, 30);
    submit("its second, at 10", 1, 10);
    submit("its third, at 30", 1, 30);
    submit("another's, at 20", 2, 20);
    release();
    EXPECT_THAT(wait_for(4),
                ElementsAre("its second, at 10", "another's, at 20", "its first, at 30", "its third, at 30"));
}

TEST_F(RenderThreadsTest, RenderOnePingOfASonarAtATimeHoweverManyThreadsAreFree) {
    start(2);
    block(1);
    submit("of the same sonar", 1, 10);
    submit("of another", 2, 20);
    EXPECT_THAT(wait_for(1), ElementsAre("of another"));
    release();
    EXPECT_THAT(wait_for(2), ElementsAre("of another", "of the same sonar"));
}

TEST_F(RenderThreadsTest, LeaveAThreadToOthersBesideShotsWithRows) {
    start(2);
    block(1, rows());
    submit("image", 2, 10, rows());
    submit("fan", 3, 20);
    EXPECT_THAT(wait_for(1), ElementsAre("fan"));
    release();
    EXPECT_THAT(wait_for(2), ElementsAre("fan", "image"));
}

std::vector<std::vector<float>> rendered(const std::shared_ptr<const Scene>& scene, std::size_t count) {
    constexpr std::size_t pings = 24;
    std::vector<std::vector<float>> values(pings);
    std::promise<void> all;
    std::atomic<std::size_t> left = pings;
    RenderThreads threads([&] { return std::make_unique<Renderer>(scene, Water{}); }, count);
    for (std::size_t i = 0; i < pings; ++i)
        threads.submit({i % 6,
                        Time(i),
                        shot_of(i % 3 == 0 ? 1 : 32, i),
                        {},
                        [&, i](Echogram echogram, const std::string&) {
                            values[i] = std::move(echogram.values);
                            if (--left == 0) all.set_value();
                        }});
    all.get_future().wait();
    return values;
}

TEST(RenderThreadsOfAnyNumber, GiveTheSameEchoes) {
    const auto scene = test::scene_of({test::wall_at(5, 4, -4, 4, -4)});
    const auto alone = rendered(scene, 1);
    EXPECT_EQ(alone, rendered(scene, 4));
    EXPECT_NE(alone[1], alone[2]) << "nothing to compare";
}

TEST(RenderThreadsThatCannotRender, AreSilentAndSayWhy) {
    RenderThreads threads(
        [] { return std::make_unique<Renderer>(test::scene_of({test::wall_at(5, 4, -4, 4, -4)}), Water{}); });
    Situation too_many;
    too_many.movers.resize(1);  // more than the scene has
    std::promise<std::string> why;
    threads.submit({0, {}, shot_of(2), too_many, [&](const Echogram& echogram, const std::string& error) {
                        EXPECT_EQ(echogram.values, std::vector<float>(200, 0.0F));
                        why.set_value(error);
                    }});
    EXPECT_NE(why.get_future().get(), "");
}

TEST(RenderThreadsThatCannotStart, SayWhy) {
    std::atomic<int> made = 0;
    const auto make = [&made]() -> std::unique_ptr<Renderer> {
        if (made++ == 1) throw std::runtime_error("no context");
        return std::make_unique<Renderer>(test::scene_of({test::wall_at(5, 4, -4, 4, -4)}), Water{});
    };
    EXPECT_THROW(RenderThreads(make, 2), std::runtime_error);
}

TEST(UsefulThreads, AreNoMoreThanFindWork) {
    EXPECT_EQ(RenderThreads::useful(1), 1U);
    EXPECT_LE(RenderThreads::useful(100), 4U);
}

}  // namespace
}  // namespace echoloop
