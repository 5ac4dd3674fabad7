// What is left of a process whose child dies, loops or eats memory: a message that says what it was doing.
#include "tools/import/guard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>
#include <vector>

namespace echoloop::worlds {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

auto says(const char* what) {
    return ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("wreck.dae"), HasSubstr(what)));
}

TEST(Guard, TheResultIsTheChilds) {
    int here = 0;
    EXPECT_EQ(run_guarded({}, [&](Stage&) { return here = 65; }), 65);
    EXPECT_EQ(here, 0);
}

TEST(Guard, ACrashIsTold) {
    const auto crash = [](Stage& stage) {
        stage.set("wreck.dae");
        std::signal(SIGSEGV, SIG_DFL);  // the sanitizer's handler would tell it as an error of its own
        std::raise(SIGSEGV);
        return 0;
    };
    EXPECT_THAT([&] { run_guarded({}, crash); }, says("broke the library"));
}

TEST(Guard, ALoopEnds) {
    const auto loop = [](Stage& stage) {
        stage.set("wreck.dae");
        volatile bool stop = false;
        while (!stop) {
        }
        return 0;
    };
    EXPECT_THAT([&] { run_guarded({.seconds = 1}, loop); }, says("took more than 1 s"));
}

#ifndef __SANITIZE_ADDRESS__
TEST(Guard, MemoryEnds) {
    const auto eat = [](Stage& stage) {
        stage.set("wreck.dae");
        std::vector<std::vector<char>> all;
        for (;;) all.emplace_back(std::size_t{1} << 28);
        return 0;
    };
    EXPECT_THAT([&] { run_guarded({.memory = std::size_t{1} << 30}, eat); },
                says("more than 1 GiB of memory"));
}
#endif

}  // namespace
}  // namespace echoloop::worlds
