// What a Sonic 2024 makes of names that it does not know and of noise on its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/noisy_line.h"
#include "tests/emulator/devices/r2sonic_bench.h"

namespace echoloop::test {
namespace {

TEST(R2SonicUnknownCommands, AreCountedOnceANameHoweverOftenTheyComeAndHoweverManyThereAre) {
    Bench bench = head({{"trigger", std::string("command")}});
    for (int again = 0; again < 3; ++again)
        for (const char* what :
             {"XYZ0", "RNG0", "DHM0", "ABS4", "ABS5", "BDG0", "MIM0"})  // two of them unknown
            bench.say(command(what, 40.0F));
    EXPECT_EQ(bench.device().counters().rejected, 2u);
    for (int i = 0; i < 2000; ++i) bench.say(command("#" + std::to_string(i), std::uint32_t{0}));
    EXPECT_LE(bench.device().counters().rejected, 64u);
}

TEST(R2SonicNoise, GarbageIsCountedAndNotAnswered) {
    Bench bench = head({{"trigger", std::string("command")}});
    bench.run_to(1ms);
    bench.sent();
    bench.say(Bytes{});
    bench.say("00");
    bench.say(Bytes(2000, 0xFF));
    Bytes cut = command("RNG0", 100.0F);
    cut.pop_back();
    bench.say(cut);
    EXPECT_TRUE(bench.sent().empty());
    EXPECT_EQ(bench.device().counters().rejected, 4u);
}

TEST(R2SonicNoise, AHostIsServedAgainWithinOneRequest) {
    Bench bench = head({{"range", 15.0}});
    NoisyHost host;
    const std::string set = "434d4430";  // CMD0
    host.words = {
        set + "524e47304198000053455730" + "3f800000",                       // RNG0 19 m, SEW0 1 rad
        set + "5452473000000000" + "50524c3041200000" + "5052553000000001",  // TRG0 0, PRL0 10, PRU0 1
        set + "5452473000000002504e473000000001",                            // TRG0 2, PNG0 1
        set + "57434d3000000001534e495000000001" + "55484430" + "00000000",  // WCM0, SNIP, UHD0
        "52324444"
        "7f000001ff780000" +
            std::string(64, '0')};  // R2DD
    host.request = set + "524e473041880000" + "5052553000000000" +
                   "5452473000000002504e473000000001";  // RNG0 17 m, no limit of the rate, one ping
    host.is_answer = [](const Send& send) {
        return name(send.bytes, 0, 4) == "BTH0" && f32(send.bytes, 12 + 88) == 17.0F;
    };
    host.patience = 4s;  // a ping of 1200 m may be under way
    host.from = {0x7F000001, 40000};
    expect_no_wedge(bench, host, 300);
    EXPECT_GT(bench.device().counters().messages, 300u);
}

}  // namespace
}  // namespace echoloop::test
