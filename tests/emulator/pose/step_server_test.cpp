// Lines that step the clock: what is answered to good, bad and repeated ones, and in which order.
#include "emulator/pose/step_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace echoloop {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

class StepServerTest : public testing::Test, protected LineSource {
  protected:
    void take(const PoseText& text) override {
        if (text.message) poses_.push_back(to_seconds(clock_.now()));
    }
    Task<void> answer(std::string text, Address, std::uint64_t connection) override {
        EXPECT_EQ(connection, 3);
        answers_.push_back(text);
        if (--wanted_ == 0) io_.stop();
        co_return;
    }
    /// Gives the lines in one burst and serves them until that many are answered.
    void give(const std::vector<std::string>& lines, int answers) {
        wanted_ = answers;
        for (const auto& line : lines) server_.add({parse_pose_line(line), this, {}, 3});
        io_.restart();
        clock_.run();
    }
    std::string error(const std::string& line) {
        answers_.clear();
        give({line}, 1);
        return nlohmann::json::parse(answers_.at(0)).value("error", "");
    }

    asio::io_context io_;
    asio::executor_work_guard<asio::io_context::executor_type> work_ = asio::make_work_guard(io_);
    SteppedClock clock_{io_};
    StepServer server_{clock_, [] { return std::vector<std::pair<std::string, std::uint64_t>>{{"a", 7}}; }};
    std::vector<std::string> answers_;
    std::vector<double> poses_;
    int wanted_ = 0;
};

TEST_F(StepServerTest, StepsOfABurstAreServedInTurn) {
    server_.start({}, [] {});
    give({R"({"now": 0})", R"({"now": 0.1, "position": [1, 2, 3]})", R"({"position": [1, 2, 4]})",
          R"({"now": 0.30000000000000004})"},
         3);
    EXPECT_THAT(answers_,
                ElementsAre(R"({"now":0.0,"ack":1,"sent":{"a":7}})", R"({"now":0.1,"ack":2,"sent":{"a":7}})",
                            R"({"now":0.30000000000000004,"ack":3,"sent":{"a":7}})"));
    EXPECT_THAT(poses_, ElementsAre(0, 0.1));  // each in its turn
    EXPECT_EQ(clock_.now(), 300ms);
}

TEST_F(StepServerTest, ARepeatedStepIsAcknowledgedWithoutEffect) {
    server_.start({}, [] {});
    give({R"({"now": 2})", R"({"now": 2.0, "position": [9, 9, 9]})"}, 2);
    EXPECT_EQ(answers_[0], answers_[1]);
    EXPECT_TRUE(poses_.empty());
    EXPECT_EQ(server_.summary().steps, 1);
}

TEST_F(StepServerTest, RefusesWhatIsNoStep) {
    server_.start({}, [] {});
    give({R"({"now": 10})"}, 1);
    EXPECT_THAT(error(R"({"now": 9.999999999})"),
                HasSubstr("9.999999999 s is before 10.0 s, where the run is"));
    EXPECT_THAT(error(R"({"now": -1})"), HasSubstr("before"));
    EXPECT_THAT(error(R"({"now": 14410.1})"), HasSubstr("more than 4 hours ahead"));
    EXPECT_THAT(error(R"({"now": 1e300})"), HasSubstr("no time"));
    EXPECT_THAT(error(R"({"now": 1e999})"), HasSubstr("JSON"));
    EXPECT_THAT(error(R"({"now": "11"})"), HasSubstr("finite number"));
    EXPECT_THAT(error(R"({"now": null})"), HasSubstr("finite number"));
    EXPECT_THAT(error(R"({"now": 11, "position": [1, 2]})"), HasSubstr("position"));
    EXPECT_THAT(error(R"({"now": 11, "orientation": [1, 0, 0, 0]})"), HasSubstr("position"));
    EXPECT_THAT(error("now"), HasSubstr("JSON"));
    EXPECT_EQ(clock_.now(), 10s);
    EXPECT_TRUE(poses_.empty());
    const StepSummary summary = server_.summary();
    EXPECT_EQ(summary.refused, 10);
    EXPECT_EQ(summary.last_refusal, "no JSON");
    EXPECT_EQ(error(R"({"now": 14410})"), "");  // four hours are allowed
}

TEST_F(StepServerTest, EndsTheRunAtItsEndAndNotBehindIt) {
    server_.start(1500ms, [this] { io_.stop(); });
    give({R"({"now": 1})", R"({"now": 2})", R"({"now": 3})"}, 99);
    EXPECT_EQ(clock_.now(), 1500ms);
    EXPECT_EQ(answers_.size(), 2);
    EXPECT_THAT(answers_[1], HasSubstr(R"("end":true)"));
}

TEST_F(StepServerTest, LinesThatWaitAreBounded) {
    server_.start({}, [] {});
    for (std::size_t i = 0; i <= StepServer::most_waiting; ++i)
        server_.add({parse_pose_line("{}"), this, {}, 3});
    EXPECT_EQ(server_.summary().refused, 1);
    EXPECT_THAT(server_.summary().last_refusal, HasSubstr("waiting"));
}

}  // namespace
}  // namespace echoloop
