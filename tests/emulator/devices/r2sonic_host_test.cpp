// What a Sonic 2024 says beside its pings: status, discovery, and nothing to noise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/noisy_line.h"
#include "tests/emulator/devices/r2sonic_bench.h"

namespace echoloop::test {
namespace {

TEST(R2SonicStatus, OnceASecondToBasePlusTwo) {
    Bench bench = head({{"trigger", std::string("command")}});
    bench.run_to(2500ms);
    const auto sent = bench.sent();
    const auto brief = named(sent, "R2DS");
    const auto full = named(sent, "STH0");
    ASSERT_EQ(brief.size(), 3u);
    EXPECT_EQ(full.size(), 3u);
    EXPECT_EQ(brief[0].to.port, gui.port + 2);
    EXPECT_EQ(brief[0].bytes.size(), 24u);
    EXPECT_EQ(name(brief[0].bytes, 4, 6), "100017");
    bench.say(command("STM0", std::uint32_t{0}));
    bench.run_to(5s);
    EXPECT_TRUE(named(bench.sent(), "STH0").empty());
}

Bytes discovery_request() {
    Bytes bytes;
    put(bytes, "R2DD", 4);
    put(bytes, 0x7F000001u);
    put(bytes, 65400u << 16);
    for (int i = 0; i < 8; ++i) put(bytes, 0u);
    return bytes;
}

Bytes configuration(const std::string& serial, std::uint32_t gui_ip, std::uint32_t gui_port) {
    Bytes bytes;
    put(bytes, "R2DC", 4);
    put(bytes, serial, 12);
    put(bytes, 77u);
    put(bytes, 0u);
    put(bytes, 0u);
    put(bytes, gui_ip);
    put(bytes, gui_port << 16);
    while (bytes.size() < 164) bytes.push_back(0);
    return bytes;
}

TEST(R2SonicDiscovery, AnswersTheSender) {
    Bench bench =
        head({{"trigger", std::string("command")}},
             {"udp-listen://127.0.0.1:65500", "udp://127.0.0.1:65400", "udp-listen://127.0.0.1:65300"});
    bench.run_to(1ms);
    bench.sent();
    bench.say(discovery_request(), 2, {0x7F000001, 41000});
    const auto sent = named(bench.sent(), "R2DI");
    ASSERT_EQ(sent.size(), 2u);
    EXPECT_EQ(sent[0].to, (Address{0x7F000001, 41000}));
    EXPECT_EQ(sent[0].bytes.size(), 72u);
    EXPECT_EQ(name(sent[0].bytes, 4, 6), "100017");
    EXPECT_EQ(name(sent[0].bytes, 28, 4), "2024");
    EXPECT_EQ(name(sent[1].bytes, 4, 6), "100117");
}

TEST(R2SonicDiscovery, AnswersTheGuiIfToldToButNeverFromLoopbackToANetwork) {
    Bench bench = head({{"discovery_reply", std::string("gui")}});
    const auto answered = [&](const Bytes& request) {
        bench.sent();
        bench.say(request, 1, {0x7F000001, 41000});
        return named(bench.sent(), "R2DI");
    };
    ASSERT_EQ(answered(discovery_request()).size(), 1u);
    EXPECT_EQ(answered(discovery_request()).at(0).to, gui);
    Bytes elsewhere = discovery_request();
    elsewhere[4] = 10;
    EXPECT_TRUE(answered(elsewhere).empty());
}

TEST(R2SonicDiscovery, ConfigurationMovesTheHostOnLoopbackOnly) {
    Bench bench = head({{"trigger", std::string("command")}});
    bench.run_to(1ms);
    bench.say(configuration("100017", 0x7F000002, 4000), 1);
    bench.sent();
    bench.run_to(1500ms);
    auto sent = named(bench.sent(), "R2DS");
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_EQ(sent[0].to, (Address{0x7F000002, 4002}));
    EXPECT_EQ(u32(sent[0].bytes, 16), 77u) << "ConfigID";
    bench.say(configuration("100017", 0x0A000166, 65400), 1);
    bench.say(configuration("999999", 0x7F000001, 5000), 1);
    bench.run_to(2500ms);
    sent = named(bench.sent(), "R2DS");
    EXPECT_EQ(sent.at(0).to, (Address{0x7F000002, 4002}));
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
