// In which order pings are rendered, and that their number of threads changes nothing in them.
#include "emulator/water/render_thread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <future>
#include <string_view>

#include "emulator/contract/error.h"
#include "render/renderer.h"
#include "tests/render/meshes.h"

namespace echoloop {
namespace {

using Lane = RenderThread::Lane;
using testing::ElementsAre;
using namespace std::chrono_literals;

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

class RenderThreads : public testing::Test {
  protected:
    void start(RenderThread::Crew crew) {
        crew_.emplace([this](Lane) { return std::make_unique<Renderer>(scene_, Water{}); }, crew);
    }
    /// Notes `name` when the ping is rendered.
    RenderThread::Ticket submit(const std::string& name, std::size_t sonar, int needed, std::size_t beams) {
        return submit(name, sonar, needed, shot_of(beams));
    }
    RenderThread::Ticket submit(const std::string& name, std::size_t sonar, int needed, const Shot& shot) {
        return crew_->submit({sonar, std::chrono::milliseconds(needed)}, shot, {}, noting(name));
    }
    void hurry(RenderThread::Ticket ticket) { crew_->hurry(ticket); }
    void withdraw(RenderThread::Ticket ticket) { crew_->withdraw(ticket); }
    struct Blocked {
        RenderThread::Ticket ticket;
        pid_t thread;
        int policy() const { return ::sched_getscheduler(thread); }
    };
    /// Keeps a thread busy until release(), and tells which.
    Blocked block(RenderThread::Claim claim, const Shot& shot) {
        std::promise<pid_t> begun;
        const auto ticket = crew_->submit(claim, shot, {}, [&](const Echogram&, const std::string&) {
            begun.set_value(::gettid());
            gate_.wait();
        });
        return {ticket, begun.get_future().get()};
    }
    Blocked block(RenderThread::Claim claim) { return block(claim, shot_of(16)); }
    RenderThread::Ticket block(std::size_t sonar, std::size_t beams, int needed = 0) {
        return block(sonar, shot_of(beams), needed);
    }
    RenderThread::Ticket block(std::size_t sonar, const Shot& shot, int needed = 0) {
        return block({sonar, std::chrono::milliseconds(needed)}, shot).ticket;
    }
    RenderThread::Done noting(const std::string& name) {
        return [this, name](const Echogram&, const std::string&) { note(name); };
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

  protected:
    std::optional<RenderThread> crew_;  // last: ended first
};

TEST_F(RenderThreads, ShotsWithRowsLeaveAThreadToTheOthers) {
    start({2, false});
    block(1, rows());
    submit("image", 2, 10, rows());
    submit("fan", 3, 20, 2);
    EXPECT_THAT(wait_for(1), ElementsAre("fan"));
    release();
    EXPECT_THAT(wait_for(2), ElementsAre("fan", "image"));
}

TEST_F(RenderThreads, WhatIsNeededFirstComesFirst) {
    start({1, false});
    block(9, 1);
    submit("at 30", 1, 30, 2);
    submit("at 10", 2, 10, 4);
    submit("at 20", 3, 20, 1);
    release();
    EXPECT_THAT(wait_for(3), ElementsAre("at 10", "at 20", "at 30"));
}

TEST_F(RenderThreads, PingsOfOneSonarComeAsTheyAreNeededAndElseInTheirOrder) {
    start({1, false});
    block(9, 1);
    submit("its first, at 30", 1, 30, 2);
    submit("its second, at 10", 1, 10, 2);
    submit("its third, at 30", 1, 30, 2);
    submit("another's, at 20", 2, 20, 2);
    release();
    EXPECT_THAT(wait_for(4),
                ElementsAre("its second, at 10", "another's, at 20", "its first, at 30", "its third, at 30"));
}

TEST_F(RenderThreads, ASonarHasOnePingUnderWayHoweverManyThreadsAreFree) {
    start({2, false});
    block(1, 2);
    submit("of the same sonar", 1, 10, 2);
    submit("of another", 2, 20, 2);
    EXPECT_THAT(wait_for(1), ElementsAre("of another"));
    release();
    EXPECT_THAT(wait_for(2), ElementsAre("of another", "of the same sonar"));
}

TEST_F(RenderThreads, ASingleBeamDoesNotWaitBehindFans) {
    start({1, true});
    block(1, 16);
    submit("fan", 2, 10, 16);
    submit("single beam", 3, 20, 1);
    EXPECT_THAT(wait_for(1), ElementsAre("single beam"));
    release();
    EXPECT_THAT(wait_for(2), ElementsAre("single beam", "fan"));
}

TEST_F(RenderThreads, AFanThatIsNeededBeforeOneUnderWayInterruptsIt) {
    start({1, false, true});
    block(1, 16, 20);
    submit("as soon", 2, 20, 16);
    submit("sooner", 3, 10, 16);
    submit("sooner, but a single beam", 4, 15, 1);
    EXPECT_THAT(wait_for(1), ElementsAre("sooner"));
    submit("as soon as that", 5, 10, 16);
    EXPECT_THAT(wait_for(2), ElementsAre("sooner", "as soon as that"));
    release();
    EXPECT_THAT(wait_for(4),
                ElementsAre("sooner", "as soon as that", "sooner, but a single beam", "as soon"));
}

TEST_F(RenderThreads, NothingIsUrgentThatIsNeededAfterAllUnderWay) {
    start({2, false, true});
    block(1, 16, 20);
    block(2, 16, 5);
    submit("after both", 3, 30, 16);
    submit("before one", 4, 10, 16);
    EXPECT_THAT(wait_for(1), ElementsAre("before one"));
    release();
    EXPECT_THAT(wait_for(2), ElementsAre("before one", "after both"));
}

TEST_F(RenderThreads, WhatIsWithdrawnIsNotRendered) {
    start({1, false});
    block(9, 1);
    const auto withdrawn = submit("withdrawn", 1, 10, 2);
    submit("of the same sonar", 1, 20, 2);
    submit("of another", 2, 30, 2);
    withdraw(withdrawn);
    release();
    EXPECT_THAT(wait_for(2), ElementsAre("of the same sonar", "of another"));
}

TEST_F(RenderThreads, NobodyWaitsForAPingThatIsWithdrawnWhileItIsRendered) {
    start({2, false});
    const auto withdrawn = block(1, 2);
    submit("the next", 1, 10, 2);
    withdraw(withdrawn);
    EXPECT_THAT(wait_for(1), ElementsAre("the next"));
    submit("the one after", 1, 20, 2);
    release();
    EXPECT_THAT(wait_for(2), ElementsAre("the next", "the one after"));
    withdraw(withdrawn);  // long gone
}

/// Threads that go before other programs, where this user may have that.
class PunctualRenderThreads : public RenderThreads {
  protected:
    void start(RenderThread::Crew crew) {
        crew.real_time = true;
        try {
            RenderThreads::start(crew);
        } catch (const StartError& error) {
            if (const char* ci = std::getenv("CI"); ci != nullptr && std::string_view(ci) == "true") throw;
            GTEST_SKIP() << error.what();
        }
    }
};

TEST_F(PunctualRenderThreads, LeaveProcessorsToOtherProgramsWhileTheirFansArePatient) {
    start({2, false, true});
    if (!crew_) return;
    const Blocked soon = block({1, 10ms}), patient = block({2, 30ms, true});
    EXPECT_EQ(soon.policy(), SCHED_FIFO);
    EXPECT_EQ(patient.policy(), SCHED_OTHER);
    const Blocked urgent = block({3, 20ms});  // has a thread of its own
    EXPECT_EQ(urgent.policy(), SCHED_FIFO);
    EXPECT_EQ(patient.policy(), SCHED_OTHER);
    hurry(patient.ticket);
    EXPECT_EQ(patient.policy(), SCHED_FIFO);
    release();
}

TEST_F(PunctualRenderThreads, HurryWithAPatientFanForOneThatWaitsForTheThread) {
    start({1, false, false});
    if (!crew_) return;
    const Blocked patient = block({1, 30ms, true});
    submit("a single beam", 2, 20, 1);
    EXPECT_EQ(patient.policy(), SCHED_OTHER);
    const auto next = submit("fan", 3, 40, 16);
    EXPECT_EQ(patient.policy(), SCHED_FIFO);
    withdraw(next);
    release();
    EXPECT_THAT(wait_for(1), ElementsAre("a single beam"));
}

TEST_F(PunctualRenderThreads, WaitForTheNextPingBeforeOtherPrograms) {
    start({1, false, false});
    if (!crew_) return;
    const Blocked patient = block({1, 30ms, true});
    EXPECT_EQ(patient.policy(), SCHED_OTHER);
    release();
    const auto until = std::chrono::steady_clock::now() + 10s;
    while (patient.policy() != SCHED_FIFO && std::chrono::steady_clock::now() < until)
        std::this_thread::yield();
    EXPECT_EQ(patient.policy(), SCHED_FIFO);
}

TEST_F(RenderThreads, APatientFanIsNeverUrgent) {
    start({1, false, true});
    block(1, 16, 30);
    const auto patient = crew_->submit({2, 10ms, true}, shot_of(16), {}, noting("patient"));
    submit("urgent", 3, 20, 16);
    EXPECT_THAT(wait_for(1), ElementsAre("urgent"));
    hurry(patient);
    EXPECT_THAT(wait_for(2), ElementsAre("urgent", "patient"));
    release();
}

std::vector<std::vector<float>> rendered(const std::shared_ptr<const Scene>& scene, RenderThread::Crew crew) {
    constexpr std::size_t pings = 24;
    std::vector<std::vector<float>> values(pings);
    std::promise<void> all;
    std::atomic<std::size_t> left = pings;
    RenderThread threads([&](Lane) { return std::make_unique<Renderer>(scene, Water{}); }, crew);
    for (std::size_t i = 0; i < pings; ++i)
        threads.submit({i % 6, Time(i)}, shot_of(i % 3 == 0 ? 1 : 32, i), {},
                       [&, i](Echogram echogram, const std::string&) {
                           values[i] = std::move(echogram.values);
                           if (--left == 0) all.set_value();
                       });
    all.get_future().wait();
    return values;
}

TEST(RenderThreadsOfAnyNumber, GiveTheSameEchoes) {
    const auto scene = test::scene_of({test::wall_at(5, 4, -4, 4, -4)});
    const auto alone = rendered(scene, {1, false});
    EXPECT_EQ(alone, rendered(scene, {3, true}));
    EXPECT_NE(alone[1], alone[2]) << "nothing to compare";
}

TEST(RenderThreadsThatCannotStart, SayWhy) {
    const auto make = [](Lane lane) -> std::unique_ptr<Renderer> {
        if (lane == Lane::single_beams) throw std::runtime_error("no context");
        return std::make_unique<Renderer>(test::scene_of({test::wall_at(5, 4, -4, 4, -4)}), Water{});
    };
    EXPECT_THROW(RenderThread(make, {2, true}), std::runtime_error);
}

TEST(UsefulThreads, AreNoMoreThanFindWork) {
    EXPECT_EQ(RenderThread::useful(1, 1).threads, 1U);
    EXPECT_FALSE(RenderThread::useful(1, 1).single_beams);
    EXPECT_TRUE(RenderThread::useful(100, 0).single_beams);
    EXPECT_FALSE(RenderThread::useful(100, 1).urgent_fans);
    EXPECT_TRUE(RenderThread::useful(100, 50).urgent_fans);
    EXPECT_LE(RenderThread::useful(100, 50).threads, 4U);
}

}  // namespace
}  // namespace echoloop
