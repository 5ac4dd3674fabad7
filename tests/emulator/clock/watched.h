// For tests of what a run does in real time: the watchers of processors, where this user may have them.
#pragma once

#include <gtest/gtest.h>
#include <sched.h>

#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

#include "emulator/contract/error.h"
#include "emulator/machine/standstills.h"

namespace echoloop {

/// On which that thread may run; 0 is the calling one.
inline std::vector<int> processors_of(pid_t thread) {
    cpu_set_t set;
    CPU_ZERO(&set);
    ::sched_getaffinity(thread, sizeof set, &set);
    std::vector<int> processors;
    for (int i = 0; i < CPU_SETSIZE; ++i)
        if (CPU_ISSET(i, &set)) processors.push_back(i);
    return processors;
}

class Watched : public testing::Test {
  protected:
    void SetUp() override {
        try {
            watching.emplace();
        } catch (const StartError&) {
            if (const char* ci = std::getenv("CI"); ci != nullptr && std::string_view(ci) == "true") throw;
            GTEST_SKIP() << "real time is not permitted to this user";
        }
    }

    std::optional<Standstills> watching;
};

}  // namespace echoloop
