// The serial protocol of a DVL: published sentences, commands with their replies, and a noisy line.
#include "tests/emulator/devices/dvl_bench.h"
#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
namespace {

/// CRC-8 of the specification: polynomial 07, nothing else.
std::string with_crc(const std::string& body) {
    unsigned crc = 0;
    for (const char c : body) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = crc & 0x80U ? ((crc << 1U) ^ 7U) & 0xFFU : crc << 1U;
    }
    char text[8];
    std::snprintf(text, sizeof text, "*%02x\r\n", crc);
    return body + text;
}

std::vector<std::string> lines_of(DvlBench& dvl, Time end) {
    dvl.bench.sent();
    dvl.run_to(end);
    std::vector<std::string> lines;
    for (const std::string& text : dvl.texts(line_port))
        for (std::size_t at = 0, next; (next = text.find("\r\n", at)) != std::string::npos; at = next + 2)
            lines.push_back(text.substr(at, next - at));
    return lines;
}

TEST(DvlSerial, RepliesArePublishedOnes) {
    DvlBench dvl({{"acoustic_enabled", false}});
    EXPECT_EQ(dvl.ask_line("wcv*fe\r\n"), "wrv,2.8.0*b2\r\n");
    EXPECT_EQ(dvl.ask_line("wcv\n"), "wrv,2.8.0*b2\r\n") << "the sum may be left out";
    EXPECT_EQ(dvl.ask_line("wcr*e2\r"), "wra*d9\r\n") << "any end of a line";
    EXPECT_EQ(dvl.ask_line("wcx*d4\r\n"), "wra*d9\r\n");
    EXPECT_EQ(dvl.ask_line("wcx*d5\r\n"), "wr!*1e\r\n");
    EXPECT_EQ(dvl.ask_line("wcq\r\n"), "wr?*44\r\n");
    EXPECT_EQ(dvl.ask_line("hello\r\n"), "wr?*44\r\n");
    EXPECT_EQ(dvl.ask_line("wcs,1475.00,20.00,y,n,auto,y\r\n"), "wra*d9\r\n");
    EXPECT_EQ(dvl.ask_line("wcc*95\r\n"), "wrc,1475.00,20.00,y,n,auto,y*c1\r\n");
    EXPECT_EQ(dvl.ask_line("wcw*f9\r\n").substr(0, 20), "wrw,dvl-a50,2.7.2,0x");
}

TEST(DvlSerial, SettingsKeepWhatIsLeftOut) {
    DvlBench dvl;
    EXPECT_EQ(dvl.ask_line("wcs,,,,y,,*35\r\n"), "wra*d9\r\n");
    EXPECT_EQ(dvl.ask_line("wcs,,,,,=2,\r\n"), "wra*d9\r\n");
    EXPECT_EQ(dvl.ask_line("wcs,1480,,n,\r\n"), "wra*d9\r\n") << "four fields";
    EXPECT_EQ(dvl.ask_line("wcc\r\n"), with_crc("wrc,1480.00,0.00,n,y,=2,y"));
    EXPECT_EQ(dvl.ask_line("wcs,1\r\n"), "wr?*44\r\n") << "number of fields";
    EXPECT_EQ(dvl.ask_line("wcs,fast,,,\r\n"), "wr?*44\r\n") << "no number";
    EXPECT_EQ(dvl.ask_line("wcs,99,,,\r\n"), "wrn*f4\r\n");
    EXPECT_EQ(dvl.ask_line("wcs,,,,,=9,\r\n"), "wrn*f4\r\n");
    EXPECT_EQ(dvl.ask_line("wcc\r\n"), with_crc("wrc,1480.00,0.00,n,y,=2,y"));
}

TEST(DvlSerial, APartOfACommandIsNotWaitedFor) {
    DvlBench dvl({{"acoustic_enabled", false}, {"serial_output", std::string("off")}});
    EXPECT_EQ(dvl.ask_line("wc"), "");
    EXPECT_EQ(lines_of(dvl, 90ms), (std::vector<std::string>{}));
    EXPECT_EQ(lines_of(dvl, 110ms), (std::vector<std::string>{"wr?*44"}));
}

TEST(DvlSerial, ReportsOfAPingComeInOrder) {
    DvlBench dvl({{"range_mode", std::string("=2")}});
    dvl.velocity = {0.5, 0, 0};
    dvl.run_to(3s);
    std::string kinds;
    const auto lines = lines_of(dvl, 3s + 400ms);
    for (const std::string& line : lines) {
        EXPECT_EQ(with_crc(line.substr(0, line.size() - 3)), line + "\r\n") << line;
        EXPECT_LT(line.size(), 180U) << "hosts have short buffers";
        if (!line.starts_with("wrp")) kinds += line.substr(2, 1);
    }
    EXPECT_NE(kinds.find("zuuuuxt"), std::string::npos) << kinds;
    const auto report = *std::ranges::find_if(lines, [](const auto& l) { return l.starts_with("wrz"); });
    EXPECT_TRUE(report.starts_with("wrz,0.500,0.000,0.000,y,")) << report;
    const auto beam = *std::ranges::find_if(lines, [](const auto& l) { return l.starts_with("wru,3"); });
    EXPECT_TRUE(beam.starts_with("wru,3,0.135,5.4")) << beam;
}

TEST(DvlSerial, WithoutABottomItSaysSo) {
    DvlBench dvl;
    dvl.altitude = 0;
    std::string all;
    for (const std::string& line : lines_of(dvl, 3s)) all += line + '\n';
    EXPECT_NE(all.find("wrz,0.000,0.000,0.000,n,-1.00,2.660,"), std::string::npos) << all;
    EXPECT_NE(all.find("wru,0,0.000,-1.00,"), std::string::npos);
    EXPECT_NE(all.find("wrt,-1.00,-1.00,-1.00,-1.00*"), std::string::npos);
}

TEST(DvlSerial, OutputIsChosen) {
    DvlBench dvl({{"range_mode", std::string("=2")}});
    dvl.run_to(2s);
    const auto has = [&](const char* start) {
        const Time end = dvl.bench.now + 1s;
        for (const std::string& line : lines_of(dvl, end))
            if (line.starts_with(start)) return true;
        return false;
    };
    EXPECT_EQ(dvl.ask_line("wcp,3\r\n"), "wra*d9\r\n");
    EXPECT_FALSE(has("wrx"));
    EXPECT_TRUE(has("wrz"));
    EXPECT_EQ(dvl.ask_line("wcp,2\r\n"), "wra*d9\r\n");
    EXPECT_TRUE(has(":BI,"));
    EXPECT_EQ(dvl.ask_line("wcp,6\r\n"), "wra*d9\r\n");
    dvl.bench.sent();
    dvl.run_to(dvl.bench.now + 1s);
    EXPECT_EQ(dvl.texts(line_port).at(0).size(), 47U);
    EXPECT_EQ(dvl.ask_line("wcp,0\r\n"), "wra*d9\r\n");
    EXPECT_FALSE(has("w"));
    EXPECT_EQ(dvl.ask_line("wcp,4\r\n"), "wrn*f4\r\n");
    EXPECT_EQ(dvl.ask_line("wcp,x\r\n"), "wr?*44\r\n");
}

TEST(DvlSerial, ANoisyLineWedgesNothing) {
    DvlBench dvl({{"serial_output", std::string("off")}, {"acoustic_enabled", false}});
    const auto hex = [](const std::string& text) { return to_hex(Bytes(text.begin(), text.end())); };
    const NoisyHost host{.words = {hex("wcv*fe\r\n"), hex("wcs,1480,,,,auto,y\r\n"), hex("wcx*d4\r\n"),
                                   hex("wcp,0\r\n"), hex("wcg*89\r\n")},
                         .request = hex("wcv*fe\r\n"),
                         .is_answer = [](const Send& send) { return said(send) == "wrv,2.8.0*b2\r\n"; },
                         .patience = 10ms,
                         .quiet = 200ms,
                         .port = line_port};
    expect_no_wedge(dvl.bench, host, 300);
}

}  // namespace
}  // namespace echoloop::test
