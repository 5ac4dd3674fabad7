// What a Norbit WBMS answers, and which bytes are a command.
#include "tests/emulator/devices/noisy_line.h"
#include "tests/emulator/devices/norbit_bench.h"

namespace echoloop::test {
namespace {

TEST(NorbitWbms, IsSilentUntilPowerIsOn) {
    Bench bench = norbit();
    bench.run_to(5s);
    EXPECT_TRUE(bench.sent().empty());
    EXPECT_FALSE(bench.ping);
    EXPECT_EQ(ask(bench, "set_power 1"), "set_power 1\r\n");
    bench.run_to(bench.now);
    ASSERT_TRUE(bench.ping);
    ask(bench, "set_power 0");
    bench.run_to(8s);
    EXPECT_EQ(bench.shots.size(), 1U) << "the ping under way is finished, no other follows";
}

TEST(NorbitWbms, GreetsWhoConnectsToTheCommandPortAndNobodyElse) {
    Bench bench = norbit({{"revision", std::string("10.4")}});
    bench.connect(bathymetry, host);
    bench.connect(water_column, host);
    EXPECT_TRUE(bench.sent().empty());
    bench.connect(commands, other_host);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U) << "one write: drivers read once";
    EXPECT_EQ(sent[0].port, commands);
    EXPECT_EQ(sent[0].to, other_host);
    EXPECT_EQ(std::string(sent[0].bytes.begin(), sent[0].bytes.end()),
              "Welcome to WHI\r\n\r\n10.4 release\r\n\r\n Version: 4.7.343\r\n\r\n"
              " Compiled:Oct 18 2018 19:34:31\r\n");
}

TEST(NorbitWbms, ACommandWithoutALinesEndIsAnsweredAfterAPause) {
    Bench bench = norbit();
    bench.say(bytes_of("set_rate 10"));
    bench.run_to(99ms);
    EXPECT_TRUE(bench.sent().empty());
    bench.run_to(100ms);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_EQ(std::string(sent[0].bytes.begin(), sent[0].bytes.end()), "set_rate 10 # Hz, -1 automatic\r\n");
}

TEST(NorbitWbms, EveryHostIsAnsweredForItself) {
    Bench bench = norbit();
    bench.connect(commands, host);
    bench.connect(commands, other_host);
    bench.say(bytes_of("set_ra"), commands, host);
    EXPECT_EQ(ask(bench, "set_rate 10", other_host), "set_rate 10 # Hz, -1 automatic\r\n");
    bench.say(bytes_of("te\r\n"), commands, host);
    auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_EQ(std::string(sent[0].bytes.begin(), sent[0].bytes.end()), "set_rate 10 # Hz, -1 automatic\r\n");
    EXPECT_EQ(sent[0].to, host);
    bench.say(bytes_of("seri"), commands, host);
    bench.say(bytes_of("revision"), commands, other_host);
    bench.disconnect(commands, host);
    bench.run_to(1s);
    sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U) << "half a command goes with its host";
    EXPECT_EQ(sent[0].to, other_host);
    bench.say(bytes_of("exit\r\n"), commands, other_host);
    sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_TRUE(sent[0].hang_up && sent[0].to == other_host);
}

TEST(NorbitWbms, AnswersHaveTheValuesInForce) {
    Bench bench = norbit();
    EXPECT_EQ(ask(bench, "set_range"), "range 0.0 50.0 # in meter\r\n");
    EXPECT_EQ(ask(bench, "set_range 0.5 20.0"), "range 0.5 20.0 # in meter\r\n");
    for (const char* wrong : {"set_range 1", "set_range 5 5", "set_range 0 601", "set_range a b",
                              "set_range 1 2 3", "set_range nan 4"})
        EXPECT_EQ(ask(bench, wrong), "range 0.5 20.0 # out of range, not set\r\n") << wrong;
    ask(bench, "set_gate_mode 2");
    EXPECT_EQ(ask(bench, "set_range"), "range 0.0 50.0 0.0 50.0 # in meter\r\n");
    EXPECT_EQ(ask(bench, "set_resolution 256 100"), "set_resolution 256 128 # out of range, not set\r\n");
    EXPECT_EQ(ask(bench, "set_tx 700 80 10 200"), "set_tx 700 80 10 200 # kHz, kHz, 0-15, us\r\n");
    EXPECT_EQ(ask(bench, "sound_velocity 20"), "sound_velocity -1 # out of range, not set\r\n");
    EXPECT_EQ(ask(bench, "set_vga 101"), "set_vga 50 # out of range, not set\r\n");
    EXPECT_EQ(ask(bench, "set_gain 101"), "set_gain   0 # out of range, not set\r\n");
    EXPECT_EQ(ask(bench, "partno"), "partno 12004\r\n");
    EXPECT_EQ(ask(bench, "set_warp 1"), "error # unknown command\r\n");
    ask(bench, "set_default");
    EXPECT_EQ(ask(bench, "set_tx"), "set_tx 400 80 15 500 # kHz, kHz, 0-15, us\r\n");
    EXPECT_EQ(ask(bench, "set_gate_mode"), "set_gate_mode 1 # gate by depth\r\n");
}

TEST(NorbitWbms, AnswersAreThoseInThePicturesOfARealSonar) {
    Bench bench = norbit();
    for (const auto& [command, answer] : {std::pair("set_range 20 50", "range 20.0 50.0 # in meter\r\n"),
                                          {"set_range", "range 20.0 50.0 # in meter\r\n"},
                                          {"direction 0", "direction 0.0 # in degrees\r\n"},
                                          {"autogain 1", "autogain 1 # adaptive\r\n"},
                                          {"set_gate_mode 1", "set_gate_mode 1 # gate by depth\r\n"},
                                          {"set_mode 1", "set_mode 1 # Bathy\r\n"}})
        EXPECT_EQ(ask(bench, command), answer);
    EXPECT_THAT(ask(bench, "set_gain"), testing::StartsWith("set_gain   0 # dB (analog = 0.000000dB"));
    EXPECT_THAT(ask(bench, "set_gain 100"), testing::StartsWith("set_gain 100 # dB (analog = 40.000000dB"));
}

TEST(NorbitWbms, OlderNamesOfCommandsDoTheSame) {
    Bench bench = norbit();
    EXPECT_EQ(ask(bench, "on"), "on\r\n");
    EXPECT_EQ(ask(bench, "set_power"), "set_power 1\r\n");
    EXPECT_EQ(ask(bench, "off"), "off\r\n");
    EXPECT_EQ(ask(bench, "set_power"), "set_power 0\r\n");
    EXPECT_EQ(ask(bench, "range 2 30"), "range 2.0 30.0 # in meter\r\n");
    EXPECT_EQ(ask(bench, "depth_range"), "Bottom detect gates set: 2.0 to 30.0 m\r\n");
    EXPECT_EQ(ask(bench, "depth_range 0.5 20"), "Bottom detect gates set: 0.5 to 20.0 m\r\n");
    EXPECT_EQ(ask(bench, "depth_range 9 3"),
              "Bottom detect gates set: 0.5 to 20.0 m # out of range, not set\r\n");
    ask(bench, "direction 20");
    EXPECT_EQ(ask(bench, "set_direction"), "direction 20.0 # in degrees\r\n");
    EXPECT_EQ(ask(bench, "set_p\xFFwer 1"), "error # unknown command\r\n");
    for (const char* other : {"power 1", "mode 0", "tx"})
        EXPECT_EQ(ask(bench, other), "error # unknown command\r\n") << "no source knows these";
}

TEST(NorbitWbms, ExitEndsTheConnectionBehindItsAnswer) {
    Bench bench = norbit();
    for (const auto& [command, ends] : {std::pair{"set_rate 5\r\n", false}, {"exit\r\n", true}}) {
        bench.say(bytes_of(command));
        const auto sent = bench.sent();
        ASSERT_EQ(sent.size(), 1U);
        EXPECT_EQ(sent[0].hang_up, ends) << command;
    }
}

TEST(NorbitWbms, TheNameOfATimeServerIsKept) {
    Bench bench = norbit();
    EXPECT_EQ(ask(bench, "set_ntp_server"), "set_ntp_server 0.0.0.0\r\n");
    EXPECT_EQ(ask(bench, "set_ntp_server 10.0.0.1"), "set_ntp_server 10.0.0.1\r\n");
    EXPECT_EQ(ask(bench, "set_ntp_server"), "set_ntp_server 10.0.0.1\r\n");
    ask(bench, "set_default");
    EXPECT_EQ(ask(bench, "set_ntp_server"), "set_ntp_server 0.0.0.0\r\n");
}

TEST(NorbitWbms, ANoisyHostIsServedAgainWithinOneRequest) {
    Bench bench = norbit({{"power", true}});
    NoisyHost host;
    for (const char* word :
         {"set_range .5 30", "set_rate 3", "set_tx 400 80 15 500\r\n", "set_opening_angle 120"})
        host.words.push_back(to_hex(bytes_of(word)));
    host.request = to_hex(bytes_of("serial"));
    host.is_answer = [](const Send& s) {
        return s.port == commands && std::string(s.bytes.begin(), s.bytes.end()) == "serial 700218\r\n";
    };
    host.quiet = 101ms;
    host.patience = 500ms;
    expect_no_wedge(bench, host, 500);
}

}  // namespace
}  // namespace echoloop::test
