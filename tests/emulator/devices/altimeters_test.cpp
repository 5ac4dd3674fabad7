// Altimeters of several makers on a bench: literal lines at given times. Depths follow from bins; the echo
// lies at 5.000 m within one bin.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocols/nmea/sentences.h"
#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
namespace {
using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

/// With an echo at `metres` by its sound speed of 1500 m/s.
Bench altimeter(const std::string& model, const Options& changes = {}, double metres = 6) {
    Bench bench(make_device(model, {}, changes));
    if (!bench.ping) bench.say("5a");  // one that waits to be asked
    if (bench.ping)
        bench.echo_bin = static_cast<std::size_t>(2 * metres / 1500 / bench.ping->shot.bin_interval + 0.5);
    bench.echo_power = 1e13F;
    return bench;
}

std::vector<std::string> lines(Bench& bench) {
    std::vector<std::string> all;
    for (const Send& s : bench.sent()) all.emplace_back(s.bytes.begin(), s.bytes.end());
    return all;
}

/// What it has said within `time`, in one.
std::string said(Bench& bench, Time time) {
    bench.run_to(bench.now + time);
    std::string all;
    for (const std::string& line : lines(bench)) all += line;
    return all;
}

std::string told(Bench& bench, const std::string& command) {
    bench.say(Bytes(command.begin(), command.end()));
    return said(bench, 1ms);
}

Options with(const std::string& option, const std::string& word) { return {{option, word}}; }

TEST(Valeport, SaysItsSentenceOnceASecond) {
    Bench bench = altimeter("valeport-va500", with("pressure", "zeros"));
    bench.run_to(3100ms);
    // 2 x 100 m / 1500 m/s + 20 ms: 153 ms after each ping
    EXPECT_THAT(lines(bench), testing::SizeIs(3));
    Bench one = altimeter("valeport-va500", with("pressure", "zeros"));
    EXPECT_EQ(said(one, 200ms), "$PRVAT,06.000,M,0000.000,dBar*3f\r\n");
    Bench none = altimeter("valeport-va500", with("pressure", "none"));
    EXPECT_EQ(said(none, 200ms), "$PRVAT,06.000,M*14\r\n");
}

TEST(Valeport, HasTheChecksumsOfItsManual) {
    EXPECT_EQ(nmea::checksum("PRVAT,05.000,M,0010.132,dBar"), 0x3d);
    EXPECT_EQ(nmea::checksum("SDDBT,16.4,f,5.0,M,2.7,F"), 0x35);
    Bench bench = altimeter("valeport-va500", with("format", "SDDBT"), 5);
    EXPECT_EQ(said(bench, 200ms), "$SDDBT,16.4,f,5.0,M,2.7,F*35\r\n");
}

TEST(Valeport, TellsThePressureOfTheWaterAboveIt) {
    Bench bench = altimeter("valeport-va500");
    bench.run_to(1ms);
    Echogram echo = echo_of(bench.ping->shot, bench.echo_bin, 1e13F);
    echo.world_from_sonar.position.z = -10.25;
    bench.hear(echo);
    EXPECT_THAT(lines(bench), ElementsAre("$PRVAT,06.000,M,0010.250,dBar*39\r\n"));
}

TEST(Valeport, StopsAtAMarkAndAnswersAsItsDriverWants) {
    Bench bench = altimeter("valeport-va500", with("pressure", "zeros"));
    bench.run_to(1100ms);
    lines(bench);
    EXPECT_EQ(told(bench, "#"), ">") << "at any time";
    EXPECT_EQ(said(bench, 3s), "") << "also of the ping under way";
    EXPECT_EQ(told(bench, "\r\n#"), ">") << "as the driver sends it: # CR LF, #";
    EXPECT_EQ(told(bench, "#823;100\r\n"), "#823;100\r\n100\r\n>");
    EXPECT_EQ(told(bench, "#840;1\r\n"), "#840;1\r\n1\r\n>");
    EXPECT_EQ(told(bench, "#039;M4\r\n"), "#039;M4\r\nM4\r\n>");
    EXPECT_EQ(told(bench, "#824\r"), "#824\r\n100\r\n>");
    EXPECT_EQ(told(bench, "#\r"), ">");
    EXPECT_EQ(told(bench, "#777\r"), "#777\r\n>") << "it knows no such value";
    EXPECT_EQ(told(bench, "#823;1e9\r"), "#823;1e9\r\n>");
    EXPECT_EQ(bench.device().counters().rejected, 2U);
    EXPECT_EQ(told(bench, "#028\r\n"), "#028\r\n");
    bench.run_to(bench.now + 2s);
    EXPECT_NEAR(static_cast<double>(lines(bench).size()), 8, 1) << "four a second";
}

TEST(Valeport, IsAskedForOne) {
    Bench bench(make_device("valeport-va500", {}, {{"running", false}, {"format", std::string("TRITEC")}}));
    bench.echo_power = 1e13F;
    EXPECT_EQ(said(bench, 5s), "");
    bench.say("530d");  // S
    bench.echo_bin = static_cast<std::size_t>(2 * 6.0 / 1500 / bench.ping->shot.bin_interval + 0.5);
    EXPECT_EQ(said(bench, 5s), "S\r\n006.000m\r\n>");
}

TEST(Valeport, WithoutABottomSaysWhatItIsToldTo) {
    const auto first = [](const std::string& word) {
        Bench bench = altimeter("valeport-va500", {{"no_bottom", word}, {"pressure", std::string("none")}});
        std::string all = said(bench, 200ms);
        bench.echo_power = 0;
        return said(bench, 1s);
    };
    EXPECT_EQ(first("zero"), "$PRVAT,00.000,M*12\r\n");
    EXPECT_EQ(first("text"), "ERROR\r\n");
    EXPECT_EQ(first("last"), "$PRVAT,06.000,M*14\r\n");
    EXPECT_EQ(first("silent"), "");
}

TEST(TritechPa, HasTheFormatsOfItsSwitches) {
    const auto first = [](std::int64_t switches) {
        Bench bench = altimeter("tritech-pa500", {{"switches", switches}}, switches == 17 ? 5 : 6);
        if (switches >= 32) {
            const auto letter = static_cast<std::uint8_t>('A' + switches % 8);
            bench.say(Bytes{letter});
            bench.echo_bin = static_cast<std::size_t>(2 * 6.0 / 1500 / bench.ping->shot.bin_interval + 0.5);
        }
        return said(bench, 99ms);
    };
    EXPECT_EQ(first(5), "006.000m\r\n");
    EXPECT_EQ(first(9), "06.000m\r\n");
    EXPECT_EQ(first(13), "006.00m\r\n");
    EXPECT_EQ(first(17), "$PADBT,016.40,f,005.00,M,002.73,F*30\r\n") << "the manual's example";
    EXPECT_EQ(first(32), "A006.000m\r\n");
    EXPECT_EQ(first(39), "H006.000m\r\n");
    Bench centimetres = altimeter("tritech-pa500", with("text", "centimetres"));
    EXPECT_EQ(said(centimetres, 99ms), "00600\r\n");
    for (const std::int64_t bad : {16, 19, 31})
        EXPECT_THROW(make_device("tritech-pa500", {}, {{"switches", bad}}), std::invalid_argument) << bad;
}

TEST(TritechPa, WithoutABottomSaysZeroOrItsGreatestDistance) {
    const auto first = [](const std::string& model, std::int64_t switches) {
        Bench bench = altimeter(model, {{"switches", switches}});
        bench.echo_power = 0;
        return said(bench, 200ms).substr(0, 10);
    };
    EXPECT_EQ(first("tritech-pa500", 5), "000.000m\r\n");
    EXPECT_EQ(first("tritech-pa500", 7), "050.000m\r\n");
    EXPECT_EQ(first("tritech-pa200", 7), "100.000m\r\n");
}

TEST(TritechPa, InterrogatedAnswersItsLetterOnly) {
    Bench bench = altimeter("tritech-pa500", {{"switches", std::int64_t{4}}});
    EXPECT_EQ(said(bench, 5s), "006.000m\r\n") << "asked once";
    const std::string asked = "#Z";
    bench.say(Bytes(asked.begin(), asked.end()));
    EXPECT_EQ(said(bench, 5s), "006.000m\r\n");
    bench.say("46");  // F
    bench.run_to(bench.now + 1s);
    EXPECT_NEAR(static_cast<double>(lines(bench).size()), 10, 1);
    Bench addressed(make_device("tritech-pa500", {}, {{"switches", std::int64_t{33}}}));
    for (const char* other : {"5a", "46", "41"}) addressed.say(other);  // Z, F, A
    EXPECT_EQ(said(addressed, 5s), "") << "it is B";
}

TEST(Benthos, MarksWhatIsOldOrTooNear) {
    Bench bench = altimeter("benthos-psa916");
    EXPECT_EQ(said(bench, 190ms), "R06.00\r\n");
    bench.echo_power = 0;
    EXPECT_EQ(said(bench, 800ms), "R06.00E\r\nR06.00E\r\nR06.00E\r\nR06.00E\r\n");
    EXPECT_EQ(said(bench, 400ms), "R99.99E\r\nR99.99E\r\n");
    Bench near = altimeter("benthos-psa916", {}, 0.6);
    EXPECT_EQ(said(near, 190ms), "R00.60<\r\n");
    Bench plain = altimeter("benthos-psa916", with("no_bottom", "R99.99E"));
    said(plain, 190ms);
    plain.echo_power = 0;
    EXPECT_EQ(said(plain, 200ms), "R99.99E\r\n");
}

TEST(Echologger, SaysSentencesOrMetres) {
    Bench bench = altimeter("echologger-ect400", {{"range", 15.0}});
    EXPECT_EQ(said(bench, 100ms),
              "$SDDBT,19.685,f,6.000,M,3.281,F*3B\r\n$SDDPT,6.000,0.000,15.0*67\r\n$SDMTW,10.0,C*05\r\n");
    Bench simple = altimeter("echologger-ect400", {{"range", 15.0}, {"output", std::string("simple")}});
    EXPECT_EQ(said(simple, 100ms), "6.000\r\n");
    simple.echo_power = 0;
    EXPECT_EQ(said(simple, 1s), "0.000\r\n");
}

TEST(Echologger, TakesCommandsWithoutALineEnd) {
    Bench bench = altimeter("echologger-ect400", {{"range", 15.0}, {"output", std::string("simple")}});
    said(bench, 200ms);
    EXPECT_EQ(told(bench, "#"), "");
    EXPECT_EQ(said(bench, 5s), "") << "stopped after the silence";
    for (const std::string command : {"#interval 0.5", "#range 20000", "#deadzone 300", "#offset 250"}) {
        told(bench, command);
        EXPECT_EQ(said(bench, 150ms), "") << command;
    }
    told(bench, "#go\r");
    EXPECT_EQ(bench.device().counters().messages, 6U);
    const Time shot = bench.now;
    bench.run_to(shot + 2s);
    EXPECT_NEAR(static_cast<double>(lines(bench).size()), 4, 1) << "two a second";
    EXPECT_NEAR(static_cast<double>(bench.shots.back().bins) * bench.shots.back().bin_interval, 40 / 1500.0,
                1e-6);
    told(bench, "#range 1e9\r#output 2\r#nonsense\r");
    EXPECT_EQ(bench.device().counters().rejected, 3U);
}

TEST(Imagenex863, SaysTheTimeOfFlightAndTheLevel) {
    Bench bench = altimeter("imagenex-863");
    bench.run_to(200ms);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U);
    ASSERT_EQ(sent[0].bytes.size(), 4U);
    EXPECT_EQ(sent[0].bytes[0], 0xFF);
    EXPECT_NEAR(sent[0].bytes[1] * 256 + sent[0].bytes[2], 8000, 12) << "us, within one bin";
    EXPECT_GT(sent[0].bytes[3], 0);
    bench.echo_power = 0;
    bench.run_to(1200ms);
    EXPECT_EQ(to_hex(bench.sent().at(0).bytes), "ff000000");
}

TEST(Altimeters, AreAsLateAsTheyAreTold) {
    for (const std::string model : {"valeport-va500", "tritech-pa500", "tritech-pa200", "benthos-psa916",
                                    "echologger-ect400", "imagenex-863"}) {
        Bench bench = altimeter(model, {{"tracking_lag", 1.0}});
        bench.run_to(1500ms);
        lines(bench);
        bench.echo_bin = bench.echo_bin * 3 / 2;  // a step
        const std::size_t before = bench.shots.size();
        while (bench.shots.size() == before) bench.run_to(bench.now + 10ms);
        bench.run_to(bench.now + 1ms);
        const auto after = bench.sent();
        ASSERT_FALSE(after.empty()) << model;
        EXPECT_EQ(to_hex(after.front().bytes).find("392e30"), std::string::npos)
            << model << ": not 9.0 at once";
    }
}

}  // namespace
}  // namespace echoloop::test
