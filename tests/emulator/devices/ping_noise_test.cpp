// Ping devices on a line that flips bytes: whatever was damaged before, the next good request is answered.
#include <gtest/gtest.h>

#include <random>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
namespace {

/// What a host of the model says in a row: settings, commands, requests.
const std::vector<std::string>& words(const std::string& model) {
    static const std::vector<std::string> ping360{"42520200060000000500a100",
                                                  "42520e00290a00000000c8000b005800ee02b0040100a503",
                                                  "42520000570b0000f600", "42520000040000009800"};
    static const std::vector<std::string> ping1d{"42520200060000000500a100", "42520100eb030000008301",
                                                 "42520200ec0300003200b701", "4252000014050000ad00",
                                                 "42520000040000009800"};
    return model == "ping360" ? ping360 : ping1d;
}

class OnANoisyLine : public testing::TestWithParam<const char*> {};

TEST_P(OnANoisyLine, EveryHostIsServedAgainWithinOneRequest) {
    std::mt19937 random(7);
    Bench bench(make_device(GetParam()));
    const auto& vocabulary = words(GetParam());
    for (int round = 0; round < 2000; ++round) {
        for (int i = 0; i < 5; ++i) {
            Bytes bytes = from_hex(vocabulary[random() % vocabulary.size()]);
            for (std::uint8_t& byte : bytes)
                if (random() % 20 == 0) byte ^= static_cast<std::uint8_t>(1 + random() % 255);
            bench.say(bytes);
            bench.run_to(bench.now + std::chrono::milliseconds(random() % 50));
        }
        bench.sent();
        bench.say("42520200060000000500a100");
        bool answered = false;
        for (const Send& send : bench.sent()) answered |= send.bytes.size() == 14 && send.bytes[4] == 5;
        ASSERT_TRUE(answered) << "round " << round;
        bench.shots.clear();
    }
}

INSTANTIATE_TEST_SUITE_P(Ping, OnANoisyLine, testing::Values("ping360", "ping1d"),
                         [](const auto& model) { return std::string(model.param); });

}  // namespace
}  // namespace echoloop::test
