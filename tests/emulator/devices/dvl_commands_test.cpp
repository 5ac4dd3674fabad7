// What a DVL answers by TCP: commands of JSON with their errors, triggered pings, PD4, PD6 and HTTP.
#include "tests/emulator/devices/dvl_bench.h"

namespace echoloop::test {
namespace {

TEST(DvlCommands, AnswerHasTheKeysOfARealOneInTheirOrder) {
    DvlBench dvl;
    dvl.bench.sent();
    dvl.say(R"({"command":"reset_dead_reckoning"})");
    const auto texts = dvl.texts(json_port);
    ASSERT_EQ(texts.size(), 1U);
    EXPECT_EQ(texts[0],
              "{\"response_to\":\"reset_dead_reckoning\",\"success\":true,\"error_message\":\"\",\"result\":"
              "null,\"format\":\"json_v3.3\",\"type\":\"response\"}\r\n");
}

TEST(DvlCommands, ConfigurationIsReadAndSet) {
    DvlBench dvl;
    const Json before = dvl.ask(R"({"command":"get_config"})").at(0).at("result");
    EXPECT_EQ(before, Json::parse(R"({"speed_of_sound":1500,"acoustic_enabled":true,"dark_mode_enabled":false,
        "mounting_rotation_offset":0,"range_mode":"auto","periodic_cycling_enabled":true})"));
    const Json set =
        dvl.ask(R"({"command":"set_config","parameters":{"speed_of_sound":1480,"mounting_rotation_offset":20,
        "acoustic_enabled":false,"dark_mode_enabled":true,"range_mode":"1<=3","periodic_cycling_enabled":false}})")
            .at(0);
    EXPECT_TRUE(set.at("success"));
    EXPECT_EQ(dvl.ask(R"({"command":"get_config"})").at(0).at("result"),
              Json::parse(R"({"speed_of_sound":1480,"acoustic_enabled":false,"dark_mode_enabled":true,
        "mounting_rotation_offset":20,"range_mode":"1<=3","periodic_cycling_enabled":false})"));
}

TEST(DvlCommands, WhatIsWrongChangesNothing) {
    DvlBench dvl;
    for (const char* bad :
         {R"({"speed_of_sound":999})", R"({"speed_of_sound":"1500"})", R"({"mounting_rotation_offset":361})",
          R"({"range_mode":"=5"})", R"({"range_mode":"3<=1"})", R"({"range_mode":2})",
          R"({"acoustic_enabled":1})", R"({"speed_of_sound":1480,"dark_mode_enabled":"no"})", "[]", "null"}) {
        const Json answer =
            dvl.ask(R"({"command":"set_config","parameters":)" + std::string(bad) + "}").at(0);
        EXPECT_FALSE(answer.at("success")) << bad;
        EXPECT_NE(answer.at("error_message"), "") << bad;
        EXPECT_TRUE(answer.at("result").is_null());
    }
    EXPECT_EQ(dvl.ask(R"({"command":"get_config"})").at(0).at("result").at("speed_of_sound"), 1500);
    EXPECT_TRUE(
        dvl.ask(R"({"command":"set_config","parameters":{"mountig_rotation_offset":3}})").at(0).at("success"))
        << "a driver says so; keys that it does not know are passed over";
}

TEST(DvlCommands, ErrorsAreThoseOfADemoUnit) {
    DvlBench dvl;
    const Json unknown = dvl.ask(R"({"command":"fly"})").at(0), broken = dvl.ask("hello\r\n").at(0),
               array = dvl.ask(R"(["command","get_config"])").at(0);
    EXPECT_EQ(unknown.at("response_to"), "fly");
    EXPECT_EQ(unknown.at("error_message"), "Command not recognised");
    EXPECT_EQ(broken.at("response_to"), "");
    EXPECT_EQ(broken.at("error_message"), "Invalid JSON");
    EXPECT_FALSE(array.at("success"));
}

TEST(DvlCommands, EveryObjectInAReadIsAnsweredOrNoneOfSeveral) {
    const std::string two = R"({"command":"get_config"}{"command":"trigger_ping"})";
    DvlBench lenient, strict({{"strict_read", true}});
    EXPECT_EQ(lenient.ask(two).size(), 2U);
    ASSERT_EQ(strict.ask(two).size(), 1U);
    EXPECT_EQ(strict.ask(two).at(0).at("error_message"), "Invalid JSON");
    EXPECT_TRUE(strict.ask(R"({"command":"get_config"})").at(0).at("success"));
}

TEST(DvlCommands, HalfACommandWaitsASecond) {
    DvlBench dvl({{"acoustic_enabled", false}});
    EXPECT_TRUE(dvl.ask(R"({"command":"get_)").empty());
    dvl.run_to(500ms);
    EXPECT_TRUE(dvl.ask(R"(config"})").at(0).at("success"));
    EXPECT_TRUE(dvl.ask(R"({"command":)").empty());
    const auto answers = dvl.reports("response", 3s);
    ASSERT_EQ(answers.size(), 1U);
    EXPECT_EQ(answers[0].at("error_message"), "Invalid JSON");
}

TEST(DvlCommands, AnswersGoToTheAskerAndReportsToAll) {
    DvlBench dvl;
    dvl.bench.sent();
    dvl.say(R"({"command":"get_config"})");
    dvl.run_to(2s);
    for (const Send& send : dvl.bench.sent()) {
        if (send.port != json_port) continue;
        const bool response = said(send).find("response_to") != std::string::npos;
        EXPECT_EQ(send.to, response ? DvlBench::host : Address{});
    }
}

TEST(DvlCommands, TriggeredPingsAreCountedAndQueued) {
    DvlBench dvl({{"acoustic_enabled", false}, {"range_mode", std::string("=2")}});
    EXPECT_TRUE(dvl.reports("velocity", 2s).empty()) << "acoustics are off";
    const std::string trigger = R"({"command":"trigger_ping"})";
    for (int i = 0; i < 16; ++i)
        EXPECT_TRUE(dvl.ask(trigger).at(0).at("success")) << i << ": one is under way";
    EXPECT_FALSE(dvl.ask(trigger).at(0).at("success")) << "fifteen wait";
    EXPECT_EQ(dvl.reports("velocity", 10s).size(), 16U);
    dvl.ask(R"({"command":"set_config","parameters":{"acoustic_enabled":true}})");
    EXPECT_FALSE(dvl.ask(trigger).at(0).at("success")) << "it pings by itself";
    EXPECT_FALSE(dvl.reports("velocity", 12s).empty());
}

TEST(DvlCommands, AcousticsOffMayBeToldTwiceASecond) {
    DvlBench dvl({{"acoustic_enabled", false}, {"invalid_lines_when_off", true}});
    const auto reports = dvl.reports("velocity", 10s);
    EXPECT_NEAR(static_cast<double>(reports.size()), 20, 1);
    EXPECT_FALSE(reports.back().at("velocity_valid"));
}

TEST(DvlCommands, GyroTakesItsTime) {
    DvlBench dvl;
    EXPECT_TRUE(dvl.ask(R"({"command":"calibrate_gyro"})").size() == 1);
    dvl.say(R"({"command":"calibrate_gyro"})");
    for (const Send& send : dvl.bench.sent())
        if (send.port == json_port && said(send).find("calibrate") != std::string::npos) {
            EXPECT_GE(send.not_before, dvl.bench.now + 1s);
        }
}

TEST(DvlCommands, CommandsFollowTheSoftware) {
    DvlBench recent, old({{"software", std::string("2.2")}});
    const Json version = recent.ask(R"({"command":"get_version_info"})").at(0).at("result");
    EXPECT_EQ(version.at("product_name"), "DVL A50");
    EXPECT_EQ(version.at("version_short"), "2.7.2");
    EXPECT_EQ(old.ask(R"({"command":"get_version_info"})").at(0).at("error_message"),
              "Command not recognised");
    EXPECT_EQ(old.ask(R"({"command":"get_config"})").at(0).at("format"), "json_v3");
}

TEST(DvlCommands, ClockIsSetByHandOnlyWithoutAServer) {
    const std::string set = R"({"command":"set_time_manual","parameters":{"now":"2030-01-01T00:00:00Z"}})";
    DvlBench synchronised, alone({{"ntp", std::string("unreachable")}});
    EXPECT_EQ(synchronised.ask(set).at(0).at("error_message"),
              "Manual time not allowed when NTP is synchronized");
    EXPECT_TRUE(alone.ask(set).at(0).at("success"));
    const Json report = alone.reports("velocity", 3s).back();
    EXPECT_NEAR(1e-6 * report.at("time_of_transmission").get<double>(), 1893456000 + 3, 1.5);
    EXPECT_EQ(alone.ask(R"({"command":"get_time_ntp"})").at(0).at("result").at("ntp_address"), "auto");
    EXPECT_FALSE(alone.ask(R"({"command":"get_time_status"})").at(0).at("result").at("ntp_synced"));
}

TEST(DvlCommands, Pd6IsAsPublished) {
    DvlBench dvl;
    dvl.velocity = {0.123, 0.42, -0.2};
    dvl.run_to(4s);
    const std::string last = dvl.texts(pd6_port).back();
    std::vector<std::string> lines;
    for (std::size_t at = 0, end; (end = last.find("\r\n", at)) != std::string::npos; at = end + 2)
        lines.push_back(last.substr(at, end - at));
    ASSERT_EQ(lines.size(), 10U);
    EXPECT_EQ(lines[0], ":SA, +0.00, +0.00,  0.00");
    EXPECT_EQ(lines[1].substr(0, 10), ":TS,250615") << "2025-06-15, the bench's Unix time";
    EXPECT_EQ(lines[1].substr(18), ", 0.0,+10.0,   0.0,1500.0,  0");
    EXPECT_EQ(lines[2], ":WI,    +0,    +0,    +0,    +0,V");
    EXPECT_EQ(lines[6], ":BI,  +123,  -420,  +200,    +0,A");
    EXPECT_EQ(lines[7], ":BS,  -420,  +123,  +200,A");
    EXPECT_EQ(lines[9].substr(0, 42), ":BD,       +0.00,       +0.00,       +0.00");
}

TEST(DvlCommands, Pd4IsAsPublished) {
    DvlBench dvl({{"speed_of_sound", 1500.0}});
    dvl.velocity = {0.123, 0.42, -0.2};
    dvl.run_to(4s);
    std::vector<Bytes> blocks;
    for (const Send& send : dvl.bench.sent())
        if (send.port == pd4_port) blocks.push_back(send.bytes);
    ASSERT_FALSE(blocks.empty());
    const Bytes& block = blocks.back();
    ASSERT_EQ(block.size(), 47U);
    EXPECT_EQ(to_hex(ByteView(block).first(13)), "7d002d00a37b005cfec8000000");
    const auto u16 = [&](std::size_t at) { return block[at] + 256 * block[at + 1]; };
    EXPECT_NEAR(u16(13), 541, 3) << "cm along the beam";
    EXPECT_EQ(u16(41), 1500);
    int sum = 0;
    for (std::size_t i = 0; i < 45; ++i) sum += block[i];
    EXPECT_EQ(u16(45), sum);
    dvl.altitude = 0;
    dvl.run_to(14s);
    for (const Send& send : dvl.bench.sent())
        if (send.port == pd4_port) {
            EXPECT_EQ(send.bytes.size(), 47U);
        }
}

std::string get(DvlBench& dvl, const std::string& path, const std::string& more = "") {
    dvl.bench.connect(web_port, DvlBench::host);
    dvl.bench.sent();
    dvl.say("GET " + path + " HTTP/1.1\r\nHost: 192.168.194.95\r\n" + more + "\r\n", web_port);
    const auto texts = dvl.texts(web_port);
    return texts.empty() ? "" : texts[0];
}

TEST(DvlCommands, PagesAreThoseOfTheBlueOsExtension) {
    DvlBench dvl;
    const auto body = [&](const std::string& path) {
        const std::string answer = get(dvl, path);
        EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << path;
        return Json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
    };
    EXPECT_EQ(body("/api/v1/about").at("product_name"), "DVL A50");
    EXPECT_EQ(body("/api/v1/about/status").at("temperature"), 30);
    EXPECT_EQ(body("/api/v1/config").at("range_mode"), "auto");
    EXPECT_EQ(body("/api/v1/outputs/").at(0).at("id"), "tcp_water_linked");
    EXPECT_EQ(body("/api/v1/outputs/").at(0).at("port"), 16171);
    EXPECT_TRUE(get(dvl, "/other").starts_with("HTTP/1.1 404"));
    EXPECT_TRUE(get(dvl, "/api/v1/about", "Origin: http://evil.example\r\n").starts_with("HTTP/1.1 403"));
}

}  // namespace
}  // namespace echoloop::test
