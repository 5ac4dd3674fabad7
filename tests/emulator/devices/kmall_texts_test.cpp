// The texts of a Kongsberg's controller on the bench: what it tells, what it is told, and the datagrams that
// a file begins with.
#include "tests/emulator/devices/kmall_bench.h"

namespace echoloop::test {
namespace {

const std::vector<std::string> with_texts{"udp-listen://127.0.0.1:14002", "udp://127.0.0.1:6020",
                                          "udp://127.0.0.1:4002"};
Bench talking_sounder(const Options& changes = {}) { return sounder(changes, with_texts); }
/// What the controller says, and what the sounder sends to its readers.
std::vector<std::string> texts(const std::vector<Send>& sent) {
    std::vector<std::string> found;
    for (const Send& send : sent)
        if (send.to.port == 4002) found.emplace_back(send.bytes.begin(), send.bytes.end());
    return found;
}
std::string text_of_number(const std::vector<Send>& sent, const std::string& number) {
    for (const std::string& one : texts(sent))
        if (one.starts_with("$KSSIS," + number + ",")) return one;
    return "";
}

TEST(Kmall, TheControllerTellsOfTheSounderEachSecond) {
    Bench bench = talking_sounder({{"pinging", false}});
    const auto at_once = bench.sent();
    EXPECT_EQ(text_of_number(at_once, "455"), "$KSSIS,455,EM2040_40,127.0.0.1,6020");
    const std::string found = text_of_number(at_once, "12");
    for (const char* pair :
         {"$KSSIS,12,IP=127.0.0.1~~", "~~NAME=EM2040_40~~", "~~TYPE=2040~~", "~~STARTED=0~~",
          "~~SYSTEM_ID=40~~", "~~DATA_MACST_IP=127.0.0.1~~", "~~DATA_MACST_PORT=6020~~"})
        EXPECT_NE(found.find(pair), found.npos) << pair << " in " << found;
    EXPECT_TRUE(found.ends_with("END!~~$$$"));
    EXPECT_EQ(text_of_number(at_once, "616"), "") << "nobody has chosen it";
    bench.say(text("$KSSIS,13,EM2040_40"));
    EXPECT_EQ(texts(bench.sent()), std::vector<std::string>{"$KSSIS,39,EM2040_40"}) << "ready";
    bench.run_to(999ms);
    EXPECT_TRUE(bench.sent().empty());
    bench.run_to(1s);
    const auto next = bench.sent();
    EXPECT_NE(text_of_number(next, "12").find("STARTED=1"), std::string::npos);
    const std::string status = text_of_number(next, "616");
    EXPECT_TRUE(
        status.starts_with("$KSSIS,616,EM2040_40,EM status=OFF;B,CPU Temperature=OK;G,Position system 1="));
    EXPECT_TRUE(status.ends_with(",1PPS=OFF;B,Depth=--;B")) << status;
    EXPECT_EQ(std::count(status.begin(), status.end(), ','), 14) << "a known driver takes no other number";
}

TEST(Kmall, ItsStatusHasTheDepthBelow) {
    Bench bench = talking_sounder();
    bench.run_to(0ns);
    Echogram echo = bottom_echo(bench.ping->shot, flat(8), {});
    echo.world_from_sonar = {{0, 0, -12}, from_rpy(0, deg_to_rad(90), 0)};
    bench.device().heard(echo, bench.ping->due);
    const std::string status = text_of_number(bench.device().woken(1s).send, "616");
    EXPECT_NE(status.find("EM status=ON;G"), status.npos) << status;
    const std::size_t depth = status.find("Depth=");
    ASSERT_NE(depth, status.npos);
    EXPECT_NEAR(std::stod(status.substr(depth + 6)), 8, 0.04);
}

/// The depth of the status after a ping over a slope 8 m below; the head is rolled by `roll` deg.
std::string told_depth(const char* edges, double roll, double angle_without_echo = 10) {
    Bench bench = talking_sounder();
    bench.say(text(std::string("$KSSIS,262,EM2040_40,") + edges));
    bench.run_to(0ns);
    const double r = deg_to_rad(roll);
    const auto floor = [&](double angle) {
        return std::abs(angle - angle_without_echo) < 0.01 ? 1e3 : sloping(8, 0.1)(angle - r);
    };
    Echogram echo = bottom_echo(bench.ping->shot, floor, {});
    echo.world_from_sonar = {{0, 0, -12}, from_rpy(r, 0, 0) * from_rpy(0, deg_to_rad(90), 0)};
    bench.device().heard(echo, bench.ping->due);
    const std::string status = text_of_number(bench.device().woken(1s).send, "616");
    return status.substr(status.find("Depth=") + 6);
}

TEST(Kmall, TheDepthInItsStatusIsThatOfTheSoundingNearestTheVertical) {
    EXPECT_NEAR(std::stod(told_depth("SSPA1=70,SSSA1=10", 0)), 8, 0.04) << "the middle beam looks to port";
    EXPECT_NEAR(std::stod(told_depth("SSPA1=45,SSSA1=45", 20)), 8, 0.04) << "the middle beam looks aside";
    EXPECT_NEAR(std::stod(told_depth("SSPA1=45,SSSA1=45", 0, 0)), 8, 0.04) << "none straight below";
}

TEST(Kmall, ADepthStaysAsItWasSetWhereverItStandsAmongTheValues) {
    for (const char* order : {"SDMA=20,SSPA1=45,SSSA1=70", "SSPA1=45,SSSA1=70,SDMA=20"}) {
        Bench bench = talking_sounder();
        bench.run_to(100ms);
        bench.sent();
        bench.say(text(std::string("$KSSIS,262,EM2040_40,") + order));
        const std::string values = text_of_number(bench.sent(), "401");
        EXPECT_NE(values.find(R"("RUNT_PARAM_PU_MAX_DEPTH","value":"20")"), values.npos) << values;
        bench.run_to(300ms);
        const Shot& shot = bench.shots.back();
        EXPECT_NEAR(static_cast<double>(shot.bins) * shot.bin_interval * 750, 20 / std::cos(deg_to_rad(70)),
                    0.05)
            << order;
        bench.say(text("$KSSIS,262,EM2040_40,SSSA1=30"));
        EXPECT_NE(text_of_number(bench.sent(), "401").find(R"(MAX_DEPTH","value":"20")"), values.npos);
        bench.run_to(800ms);
        EXPECT_NEAR(static_cast<double>(bench.shots.back().bins) * bench.shots.back().bin_interval * 750,
                    20 / std::cos(deg_to_rad(45)), 0.05)
            << "the edges moved";
    }
}

TEST(Kmall, ADepthThatTheOutermostBeamDoesNotReachStaysSet) {
    Bench bench = talking_sounder();
    bench.run_to(100ms);
    bench.sent();
    bench.say(text("$KSSIS,262,EM2040_40,SDMA=500,SSPA1=75"));
    EXPECT_NE(text_of_number(bench.sent(), "401").find(R"(MAX_DEPTH","value":"500")"), std::string::npos);
    bench.run_to(2s);
    EXPECT_NEAR(static_cast<double>(bench.shots.back().bins) * bench.shots.back().bin_interval * 750, 600, 1);
    bench.say(text("$KSSIS,454,EM2040_40"));
    const auto runtime = of_type(bench.sent(), "#IOP");
    ASSERT_EQ(runtime.size(), 1U);
    const std::string words(runtime[0].bytes.begin() + 26, runtime[0].bytes.end());
    EXPECT_NE(words.find("\nMax. depth: 500.0\n"), words.npos) << words;
}

TEST(Kmall, TheWaterColumnIsAValueAsWell) {
    Bench bench = talking_sounder();
    bench.run_to(100ms);
    EXPECT_TRUE(of_type(bench.sent(), "#MWC").empty());
    bench.say(text("$KSSIS,262,EM2040_40,RUNT_PARAM_PU_WATERCOL=1"));
    EXPECT_NE(text_of_number(bench.sent(), "401").find(R"(PU_WATERCOL","value":"1")"), std::string::npos);
    bench.run_to(300ms);
    EXPECT_FALSE(of_type(bench.sent(), "#MWC").empty());
    bench.say(text("$KSSIS,262,EM2040_40,RUNT_PARAM_PU_WATERCOL=0"));
    bench.run_to(1s);
    EXPECT_TRUE(of_type(bench.sent(), "#MWC").empty());
}

TEST(Kmall, TextsMayEndWithBlanksAndZeros) {
    for (const std::string& end :
         {std::string(1, '\0'), std::string(3, '\0'), std::string(" "), std::string(" \r\n\0", 4)}) {
        Bench bench = talking_sounder({{"pinging", false}});
        bench.sent();
        bench.say(text("$KSSIS,262,EM2040_40,STPF=3,SSBS=Equidistance" + end));
        const std::string values = text_of_number(bench.sent(), "401");
        EXPECT_NE(values.find(R"(BEAM_SPACING","value":"Equidistance")"), values.npos) << to_hex(text(end));
        EXPECT_FALSE(bench.ping);
        bench.say(text("$KSSIS,458,EM2040_40" + end));
        bench.run_to(100ms);
        EXPECT_NE(bench.shots.size(), 0U) << to_hex(text(end));
        EXPECT_EQ(bench.device().counters().rejected, 0U) << to_hex(text(end));
    }
}

TEST(Kmall, ItsIpiIsAsThePublishedOne) {
    Bench bench = talking_sounder();
    const std::string found = text_of_number(bench.sent(), "812");
    const std::size_t begin = std::string("$KSSIS,812,EM2040_40,").size();
    const Bytes b(found.begin() + static_cast<std::ptrdiff_t>(begin), found.end());
    EXPECT_EQ(at<std::uint32_t>(b, 0), b.size());
    EXPECT_EQ(at<std::uint32_t>(b, b.size() - 4), b.size());
    EXPECT_EQ(found.substr(begin + 4, 4), "#IPI");
    EXPECT_EQ(b[9], 40);
    EXPECT_EQ(u16(b, 10), 2040);
    EXPECT_EQ(u16(b, 24), 2012) << "port of commands";
    EXPECT_EQ(u16(b, 26), 6020);
    EXPECT_EQ(to_hex(ByteView(b).subspan(28, 4)), "7f000001");
    EXPECT_EQ(found.substr(begin + 40, 16), "SOUNDER: EM 2040");
}

TEST(Kmall, ValuesAreReadAndSetAndShapeTheNextPing) {
    Bench bench = talking_sounder();
    bench.run_to(0ns);
    bench.sent();
    bench.say(text("$KSSIS,261,EM2040_40"));
    std::string values = text_of_number(bench.sent(), "401");
    for (const char* pair : {R"([{"id":"RUNT_PARAM_PU_ANGLE_PORT_RX1","value":"60"})",
                             R"({"id":"RUNT_PARAM_PU_MAX_PING_FREQ","value":"300kHz"})",
                             R"({"id":"RUNT_PARAM_PU_PING_MODE","value":"5.00"})"})
        EXPECT_NE(values.find(pair), values.npos) << pair << " in " << values;
    bench.say(
        text("$KSSIS,262,EM2040_40,RUNT_PARAM_PU_ANGLE_PORT_RX1=45,SSSA1=30,RUNT_PARAM_PU_MAX_PING_FREQ="
             "400kHz,RUNT_PARAM_PU_BEAM_SPACING=Equidistance,STPF=2,RUNT_PARAM_PU_MAX_DEPTH=20\r\n"));
    values = text_of_number(bench.sent(), "401");
    EXPECT_NE(values.find(R"("RUNT_PARAM_PU_ANGLE_STARB_RX1","value":"30")"), values.npos) << values;
    EXPECT_NE(values.find(R"("RUNT_PARAM_PU_MAX_DEPTH","value":"20")"), values.npos) << values;
    bench.run_to(300ms);
    auto pings = of_type(bench.sent(), "#MRZ");
    ASSERT_EQ(pings.size(), 1U);
    EXPECT_EQ(f32(pings[0].bytes, ping + 16), 300e3F) << "it was under way";
    EXPECT_NEAR(f32(pings[0].bytes, first + 72), 60, 1e-3);
    bench.run_to(900ms);
    const Shot& shot = bench.shots.back();
    EXPECT_NEAR(rad_to_deg(shot.bearings.front()), -45, 1e-9) << "port";
    EXPECT_NEAR(rad_to_deg(shot.bearings.back()), 30, 1e-9);
    EXPECT_NEAR(std::tan(shot.bearings[1]) - std::tan(shot.bearings[0]),
                std::tan(shot.bearings[399]) - std::tan(shot.bearings[398]), 1e-9);
    EXPECT_NEAR(shot.beam_width, deg_to_rad(0.4), 1e-9);
    EXPECT_NEAR(static_cast<double>(shot.bins) * shot.bin_interval * 750, 20 / std::cos(deg_to_rad(45)),
                0.05);
    pings = of_type(bench.sent(), "#MRZ");
    ASSERT_EQ(pings.size(), 1U) << "2 Hz";
    EXPECT_EQ(f32(pings[0].bytes, ping + 16), 400e3F);
    EXPECT_NEAR(f32(pings[0].bytes, ping + 44), 45, 1e-4);
    EXPECT_NEAR(f32(pings[0].bytes, ping + 48), -30, 1e-4);
}

TEST(Kmall, ValuesThatCannotBeChangeNothing) {
    Bench bench = talking_sounder();
    bench.run_to(0ns);
    bench.sent();
    bench.say(text("$KSSIS,261,2040"));
    const std::string before = text_of_number(bench.sent(), "401");
    for (const char* wrong :
         {"SSPA1=80", "SSPA1=", "SSPA1", "=60", "SSPA1=6e1", "SSPA1=nan", "STPF=0", "STPF=51",
          "RUNT_PARAM_PU_MAX_PING_FREQ=350kHz", "SSBS=High density", "SDMA=601", "WARP=9",
          "RUNT_PARAM_PU_WATERCOL=2", ",,,", "SSPA1=1111111111111111111111111111"}) {
        bench.say(text(std::string("$KSSIS,262,2040,") + wrong));
        EXPECT_EQ(text_of_number(bench.sent(), "401"), before) << wrong;
    }
    EXPECT_EQ(bench.device().counters().rejected, 14U + 4U);
}

TEST(Kmall, LaterControllersTellValuesAsXml) {
    Bench bench = talking_sounder({{"values_text", std::string("814")}, {"pinging", false}});
    bench.sent();
    bench.say(text("$KSSIS,262,EM2040_40,STPF=12.5"));
    const std::string values = text_of_number(bench.sent(), "814");
    EXPECT_TRUE(values.starts_with(
        "$KSSIS,814,EM2040_40,<ALL_TOKENS>\n<TOKEN>\n<ID>SSPA1</ID>\n<VALUE>60</VALUE>\n</TOKEN>\n"))
        << values;
    EXPECT_NE(values.find("<ID>STPF</ID>\n<VALUE>12.50</VALUE>"), values.npos);
}

TEST(Kmall, TheRecordsOfAFilesBeginningAreSentAgain) {
    Bench bench = sounder({{"pinging", false}, {"sector_width", 100.0}});
    EXPECT_TRUE(bench.sent().empty()) << "without a place for texts there are none";
    bench.run_to(1500ms);
    bench.say(text("$KSSIS,454,EM2040_40"));
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 3U);
    for (const Send& send : sent) {
        const Bytes& b = send.bytes;
        EXPECT_EQ(at<std::uint32_t>(b, 0), b.size());
        EXPECT_EQ(at<std::uint32_t>(b, b.size() - 4), b.size());
        EXPECT_EQ(b.size() % 4, 0U);
        EXPECT_EQ(u16(b, 10), 2040);
        EXPECT_EQ(at<std::uint32_t>(b, 12), 1U) << "s";
        EXPECT_EQ(send.to.port, 6020);
    }
    const auto text_in = [](const Bytes& b) { return std::string(b.begin() + 26, b.end() - 4); };
    EXPECT_EQ(type(sent[0]), "#IIP");
    EXPECT_EQ(u16(sent[0].bytes, 20), sent[0].bytes.size() - 24);
    EXPECT_TRUE(text_in(sent[0].bytes).starts_with("OSCV:Empty,EMXV:EM2040,\nPU_0,\nSN=10140,\nIP="));
    EXPECT_NE(text_in(sent[0].bytes).find("\nSERIALno-END,\nSYSTEM:EM 2040 - Single Tx single Rx,TRAI_TX1:"),
              std::string::npos);
    EXPECT_NE(text_in(sent[0].bytes).find(",TRAI_RX1:N=1;X=0.000;Y=0.000;Z=0.000;R=0.000;P=0.000;H=0.000,"),
              std::string::npos);
    EXPECT_EQ(type(sent[1]), "#IOP");
    EXPECT_NE(text_in(sent[1].bytes).find("\nMax angle Port: 50.0\nMax angle Starboard: 50.0\n"),
              std::string::npos);
    const Bytes& svp = sent[2].bytes;
    EXPECT_EQ(type(sent[2]), "#SVP");
    EXPECT_EQ(svp[8], 1) << "version";
    EXPECT_EQ(u16(svp, 20), 28);
    EXPECT_EQ(u16(svp, 22), 2);
    EXPECT_EQ(std::string(svp.begin() + 24, svp.begin() + 27), "S00");
    EXPECT_EQ(at<double>(svp, 32), 200) << "latitude, not known";
    EXPECT_EQ(f32(svp, 48 + 4), 1500);
    EXPECT_EQ(f32(svp, 68), 12000);
    EXPECT_EQ(f32(svp, 68 + 4), 1500);
    EXPECT_EQ(svp.size(), 20U + 28 + 2 * 20 + 20 + 4) << "one point is not counted";
}

}  // namespace
}  // namespace echoloop::test
