// What hosts say to Nortek DVLs: ports, login, commands, triggers, and settings that change the next ping.
#include <map>
#include <tuple>

#include "tests/emulator/devices/nortek_dvl_bench.h"

namespace echoloop::test {
namespace {

using namespace nortek_dvl;
using namespace std::chrono_literals;

TEST(NortekDvl, PortsTellWhatTheyAreFor) {
    NortekDvl n;
    n.bench.sent();
    n.bench.connect(data, {0x7F000001, 5000});
    n.bench.connect(text, {0x7F000001, 5001});
    std::size_t greetings = 0;
    for (const Send& send : n.bench.sent()) {
        EXPECT_EQ(as_text(send.bytes), "\r\nNortek NORTEK-100500 Data Interface\r\n");
        EXPECT_EQ(send.to.port, send.port == data ? 5000 : 5001);
        ++greetings;
    }
    EXPECT_EQ(greetings, 2U);
    n.bottom.run(n.bench, 2s);
    std::map<std::size_t, int> frames;
    for (const Send& send : n.bench.sent()) {
        ++frames[send.port];
        if (send.port == datagrams) {
            EXPECT_EQ(send.to, host);
        }
    }
    EXPECT_EQ(frames[commands], 0) << "nobody has logged in";
    EXPECT_NEAR(frames[data], 8, 1);
    EXPECT_EQ(frames[text], 0) << "DF21 is no text";
    EXPECT_EQ(frames[line], frames[data]);
    EXPECT_EQ(frames[datagrams], frames[data]);
    NortekDvl lines({{"bottom_format", std::string("bt9")}});
    EXPECT_FALSE(lines.said(2s, text).empty());
}

TEST(NortekDvl, LogsItsHostInAsDuneDoes) {
    NortekDvl n;
    n.bench.sent();
    n.bench.connect(commands, {0x7F000001, 5000});
    auto said = n.said(n.bench.now, commands);
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(as_text(said[0]), "Username: ");
    EXPECT_EQ(n.ask("nortek", commands, "\n"), "Password: ");
    EXPECT_TRUE(n.ask("", commands, "\n").ends_with("Nortek DVL1000 Command Interface\r\n")) << "any will do";
    EXPECT_FALSE(n.said(2s, commands).empty()) << "who is in gets data";
    EXPECT_TRUE(n.ask("K1W%!Q", commands).ends_with("OK\r\n"));
    EXPECT_TRUE(n.said(4s, commands).empty()) << "a break stops them";
    EXPECT_EQ(n.ask("MC", commands), "OK\r\n");
    EXPECT_EQ(n.ask("SETDVL,0,\"OFF\",\"INTSR\",8.0,\"\",0.0,20.0", commands), "OK\r\n");
    EXPECT_EQ(n.ask("SETBT,30.00,4.00,4,0,21,-20.0,\"XYZ\"", commands), "OK\r\n");
    EXPECT_EQ(n.ask("GETDVL,SR,SA", commands), "GETDVL,SR=8.0,SA=20.0\r\nOK\r\n");
    EXPECT_EQ(n.ask("GETBT,PL", commands), "GETBT,PL=-20.0\r\nOK\r\n");
    EXPECT_EQ(n.ask("START", commands), "OK\r\n");
    const auto frames = n.said(6s, commands);
    EXPECT_NEAR(static_cast<double>(frames.size()), 16, 1) << "8 Hz";
    EXPECT_NEAR(f32(frames.back(), 10 + 24), 1449.2 + 46 - 5.5 + 0.29 - 1.24 * 15, 0.5)
        << "measured, of 10 degC and 20";
    EXPECT_NEAR(n.bench.shots.back().source_level, 197, 1e-6) << "20 dB less";

    NortekDvl other({{"password", std::string("secret")}, {"login", std::string("telnet")}});
    other.bench.connect(commands, {0x7F000001, 5000});
    other.ask("nortek", commands);
    EXPECT_EQ(other.ask("wrong", commands), "\r\nLogin failed\r\nUsername: ");
    other.ask("nortek", commands);
    EXPECT_TRUE(other.ask("secret", commands).ends_with("Command Interface\r\r\n"));
    NortekDvl as_nucleus({{"password", std::string("nortek")}, {"login", std::string("password")}});
    as_nucleus.bench.sent();
    as_nucleus.bench.connect(commands, {0x7F000001, 5000});
    EXPECT_EQ(as_text(as_nucleus.bench.sent().at(0).bytes), "Please enter password:\r\n");
    EXPECT_TRUE(as_nucleus.ask("nortek", commands).starts_with("Welcome to Nortek"));
}

TEST(NortekDvl, RefusesWhatIsNotLegal) {
    NortekDvl n;
    EXPECT_EQ(n.ask("SETBT,VR=4"), "ERROR\r\n") << "while it measures";
    EXPECT_EQ(n.ask("GETBT,VR"), "GETBT,VR=5\r\nOK\r\n");
    n.go_to_command_mode();
    EXPECT_EQ(n.ask("SETDVL,TRIG=\"TTLRISE\",SR=5.000000,SA=35.000000,"), "OK\r\n")
        << "DUNE ends it with a comma";
    EXPECT_EQ(
        n.ask(
            "SETBT,RANGE=50.00,VR=5.00,NB=4,CH=0,DF=359,PL=-2.0,WT=\"OFF\",WTDF=409,BD=0.01,PLMODE=\"MAX\""),
        "OK\r\n");
    for (const char* bad : {"SETDVL,SR=9", "SETDVL,SV=5", "SETDVL,TRIG=\"NONE\"", "SETBT,DF=353",
                            "SETBT,DF=2", "SETBT,WTDF=21", "SETBT,PL=3", "SETBT,NO=1", "SETBT,VR=nan",
                            "SETCLOCK,YEAR=2026", "SETCLOCKSTR,TIME=\"2026-13-27 12:30:15\"", "NO", "TRIG",
                            "GETLIM", "SETDVL,1,2,3,4,5,6,7,8,9", "$PNOR,GETBT*00", "CO"})
        EXPECT_TRUE(n.ask(bad) == "ERROR\r\n" || n.ask(bad) == "$PNOR,ERROR*77\r\n") << bad;
    EXPECT_NE(n.ask("GETERROR").find("OK\r\n"), std::string::npos);
    EXPECT_NE(n.ask("GETBTLIM").find("DF=[21;350;351;354;"), std::string::npos);
    EXPECT_EQ(n.ask("GETDVLLIM,SR"), "GETDVLLIM,SR=([1;8])\r\nOK\r\n");
    EXPECT_NE(n.ask("$PNOR,GETDVL*27").find("SR=5.000000"), std::string::npos);
    EXPECT_EQ(n.ask("SETDEFAULT,ALL"), "OK\r\n");
    EXPECT_EQ(n.ask("GETDVL,SR"), "GETDVL,SR=4\r\nOK\r\n");
}

TEST(NortekDvl, ABreakAsksAndTimeAnswers) {
    NortekDvl n;
    EXPECT_FALSE(n.said(1s).empty());
    EXPECT_TRUE(n.ask("\x03", line, "").starts_with("NortekDVL - NORTEK AS.\r\nVersion "));
    EXPECT_EQ(n.ask("CO"), "OK\r\n");
    EXPECT_FALSE(n.said(2s).empty()) << "it goes on";
    n.ask("@@@@@@", line, "");
    n.ask("K1W%!Q", line, "");
    EXPECT_TRUE(n.said(61s).empty());
    EXPECT_FALSE(n.said(64s).empty()) << "nobody has said MC for a minute";
}

TEST(NortekDvl, PingsAtCommandsAndEdges) {
    NortekDvl by_command({{"trigger", std::string("command")}});
    EXPECT_TRUE(by_command.said(3s).empty());
    EXPECT_EQ(by_command.ask("TRIG"), "OK\r\n");
    EXPECT_EQ(by_command.ask("TRIG"), "OK\r\n") << "ignored, for one is under way";
    EXPECT_EQ(by_command.said(6s).size(), 1U);
    by_command.ask("TRIG");
    EXPECT_EQ(by_command.said(9s).size(), 1U);
    for (const auto& [trigger, count, phase] :
         {std::tuple{"rise", 12.0, 0}, {"fall", 12.0, 125}, {"edges", 24.0, 0}}) {
        NortekDvl n({{"trigger", std::string(trigger)}, {"trigger_rate", 4.0}});
        n.bottom.run(n.bench, 3s - 1ms);
        EXPECT_NEAR(static_cast<double>(n.said(n.bench.now).size()), count, 2) << trigger;
        while (!n.bench.ping) n.bottom.run(n.bench, n.bench.now + 1ms);
        EXPECT_NEAR(static_cast<double>((n.bench.now / 1ms) % 250 % (count > 20 ? 125 : 250)), phase, 1.5)
            << trigger;
    }
    NortekDvl too_fast({{"trigger", std::string("edges")}, {"trigger_rate", 50.0}});
    too_fast.bottom.altitude = 60;
    const auto frames = too_fast.said(6s).size();
    EXPECT_LT(frames, 6 * 8U) << "edges while a ping is under way are ignored";
    EXPECT_GT(frames, 6 * 3U);
    NortekDvl no_line({{"trigger", std::string("rise")}});
    EXPECT_TRUE(no_line.said(5s).empty()) << "no pulses, no pings";
}

TEST(NortekDvl, RangeAndVelocityRangeAreLimits) {
    NortekDvl n;
    n.go_to_command_mode();
    EXPECT_EQ(n.ask("SETBT,RANGE=10,VR=0.5"), "OK\r\n");
    EXPECT_EQ(n.ask("START"), "OK\r\n");
    n.bottom.altitude = 20;
    EXPECT_EQ(u32(n.last(4s), 20) & 0xF000U, 0U);
    n.bottom.altitude = 5;
    EXPECT_EQ(u32(n.last(8s), 20) & 0xF000U, 0xF000U);
    n.bottom.velocity = {1, 0, 0};
    const Bytes fast = n.last(12s);
    EXPECT_EQ(u32(fast, 20) & 0xF000U, 0U) << "faster than VR";
    EXPECT_NEAR(f32(fast, 52), 5, 0.05) << "its beams hear all the same";
}

TEST(NortekDvl, DistanceMayBeSlant) {
    NortekDvl n({{"distance", std::string("slant")}});
    EXPECT_NEAR(f32(n.last(4s), 52), 5 / std::cos(deg_to_rad(25)), 0.03);
}

TEST(NortekDvl, NoiseOnTheLineCannotWedgeIt) {
    NortekDvl n;
    std::uint32_t state = 1;
    for (int i = 0; i < 4000; ++i) {
        state = state * 1664525U + 1013904223U;
        n.bench.say(Bytes{static_cast<std::uint8_t>(state >> 24)}, line);
    }
    n.ask("");
    n.go_to_command_mode();
    EXPECT_EQ(n.ask("START"), "OK\r\n");
}

TEST(NortekDvl, ALineIsItsOwnEndpointWhereverItStands) {
    const auto device = make_device("nortek-dvl500", {"udp://127.0.0.1:9005", "pty:/tmp/echoloop/n"});
    const auto ports = device->ports();
    ASSERT_EQ(ports.size(), 2U);
    EXPECT_EQ(ports[0].kind, Port::Kind::datagram);
    EXPECT_EQ(ports[1].endpoint, 1U);
}

TEST(NortekDvl, EndpointsThatAreTooManyAreNamed) {
    EXPECT_THROW(make_device("nortek-dvl1000", {"pty:/tmp/a", "pty:/tmp/b"}), std::invalid_argument);
    EXPECT_THROW(make_device("nortek-dvl1000", {"udp-listen://127.0.0.1:9000"}), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop::test
