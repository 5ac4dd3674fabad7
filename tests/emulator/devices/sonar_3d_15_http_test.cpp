// The Sonar 3D-15's HTTP interface: what is refused, what is told, and that no host can wedge it.
#include "tests/emulator/devices/noisy_line.h"
#include "tests/emulator/devices/sonar_3d_15_bench.h"

namespace echoloop::test {
namespace {

TEST(Sonar3d15, WhatCannotBeIsRefusedAndChangesNothing) {
    SonarBench sonar;
    const std::vector<std::pair<std::string, std::string>> nonsense{
        {"/acoustics/enabled", "1"},
        {"/acoustics/enabled", ""},
        {"/acoustics/range", R"({"min": 3.0, "max": 2.0})"},
        {"/acoustics/range", R"({"min": -1, "max": 2.0})"},
        {"/acoustics/range", R"({"min": 0, "max": 20.1})"},
        {"/acoustics/range", R"({"max": 2.0})"},
        {"/acoustics/range", R"({"min": 1, "max": 2.0, "more": {}})"},
        {"/acoustics/range", R"([1, 2.0])"},
        {"/acoustics/range", R"({"min": 1, "max": 2.0)"},
        {"/acoustics/speed_of_sound", "1e999"},
        {"/acoustics/speed_of_sound", "inf"},
        {"/acoustics/speed_of_sound", "999"},
        {"/acoustics/speed_of_sound", "2001"},
        {"/acoustics/speed_of_sound", R"("1500")"},
        {"/acoustics/mode", R"("medium-frequency")"},
        {"/acoustics/salinity", "salt"},
        {"/udp", R"({"mode":"unicast","unicast_destination_ip":"","unicast_destination_port":1})"},
        {"/udp", R"({"mode":"unicast","unicast_destination_ip":"1.2.3.4","unicast_destination_port":0})"},
        {"/udp", R"({"mode":"multicast","unicast_destination_ip":"1.2.3.400","unicast_destination_port":0})"},
        {"/udp", R"({"mode":"multicast","unicast_destination_ip":"","unicast_destination_port":65536})"},
        {"/udp", R"({"mode":"broadcast","unicast_destination_ip":"","unicast_destination_port":0})"},
        {"/udp", R"({"mode":"multicast"})"},
    };
    for (const auto& [path, body] : nonsense) {
        const std::string before = sonar.get(path);
        EXPECT_EQ(sonar.post(path, body), 400) << path << ' ' << body;
        EXPECT_EQ(sonar.get(path), before);
    }
    EXPECT_EQ(sonar.post("/about", "1"), 405);
    EXPECT_EQ(sonar.status("DELETE " + integration + "/udp HTTP/1.1\r\n\r\n"), 405);
    EXPECT_EQ(sonar.status(get_text("/nothing")), 404);
    EXPECT_EQ(sonar.status("GET / HTTP/1.1\r\n\r\n"), 404);
    EXPECT_EQ(sonar.bench->device().counters().rejected, nonsense.size() + 4);
}

TEST(Sonar3d15, SaysWhoItIsInTheTypesThatTheMakersClientInsistsOn) {
    SonarBench sonar;
    const std::string about = sonar.get("/about");
    for (const char* part : {R"("chipid":"0x)", R"("hardware_revision":6)", R"("is_ready":true)",
                             R"("product_id":21045)", R"("product_name":"Sonar 3D-15")", R"("variant":")",
                             R"("version":"1.7.0)", R"("version_short":"1.7.0")"})
        EXPECT_NE(about.find(part), std::string::npos) << part;
    EXPECT_NE(sonar.ask("GET /api/v1/about HTTP/1.1\r\n\r\n").find(about), std::string::npos)
        << "where the maker's BlueOS extension looks for it";
    EXPECT_EQ(sonar.status("GET /api/v1/about/more HTTP/1.1\r\n\r\n"), 404);
    EXPECT_EQ(sonar.get("/temperature"), "21.0") << "with a decimal point";
    EXPECT_EQ(sonar.post("/acoustics/range", R"({"min": 0.0001, "max": 3})"), 204);
    EXPECT_EQ(sonar.get("/acoustics/range"), R"({"min":1e-04,"max":3.0})");
    EXPECT_NE(sonar.get("/status").find(R"("systems_check":{"id":")"), std::string::npos);
}

TEST(Sonar3d15, PagesFromElsewhereMayNotCommand) {
    const auto status = [](SonarBench& sonar, const std::string& headers) {
        return sonar.status("POST " + integration + "/acoustics/enabled HTTP/1.1\r\n" + headers +
                            "Content-Length: 4\r\n\r\ntrue");
    };
    SonarBench sonar, open({{"any_page", true}});
    for (const char* foreign :
         {"Host: 127.0.0.1:8080\r\nOrigin: http://page.example\r\n", "Host: 127.0.0.1\r\nOrigin: null\r\n",
          "Host: rebound.example:8080\r\n", "Host: rebound.example\r\nOrigin: http://rebound.example\r\n",
          "Host: 127.0.0.1:8080\r\nOrigin: http://127.0.0.1:9000\r\n"}) {
        EXPECT_EQ(status(sonar, foreign), 403) << foreign;
        EXPECT_EQ(status(open, foreign), 204) << foreign;
    }
    EXPECT_EQ(sonar.get("/acoustics/enabled"), "false");
    for (const char* own :
         {"", "Host: 192.168.194.96\r\n", "host: localhost:8080\r\norigin: http://localhost:8080\r\n",
          "Host: [::1]:80\r\n", "Host: [::1]\r\n"})
        EXPECT_EQ(status(sonar, own), 204) << own;
}

TEST(Sonar3d15, OlderReleasesHaveNoModes) {
    SonarBench sonar({{"release", std::string("1.5.1")}});
    EXPECT_NE(sonar.get("/about").find(R"("version_short":"1.5.1")"), std::string::npos);
    for (const char* path : {"/status", "/acoustics/mode", "/acoustics/salinity"})
        EXPECT_EQ(sonar.status(get_text(path)), 404) << path;
    EXPECT_EQ(sonar.status(get_text("/udp")), 200);
}

Options release(const std::string& number, const std::string& ntp = "synchronised") {
    return {{"release", number}, {"ntp", ntp}};
}

TEST(Sonar3d15, EachReleaseServesWhatItBrought) {
    const std::vector<std::pair<std::string, int>> last_to_miss{
        {"/time/status", 170}, {"/time/ntp", 170}, {"/output/imu-batch/enabled", 171}};
    for (const auto& [number, order] : {std::pair{"1.7.0", 170}, {"1.7.1", 171}, {"1.8.0", 180}}) {
        SonarBench sonar(release(number));
        for (const auto& [path, missing] : last_to_miss)
            EXPECT_EQ(sonar.status(get_text(path)), order > missing ? 200 : 404) << number << path;
        EXPECT_EQ(sonar.post("/time/ntp/force-sync", R"({"timeout_seconds": 1})"), order > 170 ? 200 : 404);
    }
}

TEST(Sonar3d15, ASynchronisedClockCannotBeSet) {
    SonarBench sonar(release("1.7.1"));
    EXPECT_TRUE(
        sonar.get("/time/status")
            .starts_with(R"({"system_time":"2025-06-15T15:06:40.250000Z","ntp_synced":true,"ntp_synced_to)"));
    EXPECT_EQ(sonar.post("/time/manual", R"({"now":"2026-08-17T10:00:00Z"})"), 409);
    EXPECT_EQ(sonar.post("/time/ntp", R"({"ntp_address":"10.0.0.1"})"), 204);
    EXPECT_EQ(sonar.get("/time/ntp"), R"({"ntp_address":"10.0.0.1"})");
    EXPECT_NE(sonar.get("/time/status").find(R"("ntp_synced_to":"10.0.0.1")"), std::string::npos);
    for (const char* wrong : {R"({"ntp_address":""})", R"({"ntp_address":"a b"})", R"({"ntp":"auto"})", "7"})
        EXPECT_EQ(sonar.post("/time/ntp", wrong), 400) << wrong;
}

TEST(Sonar3d15, AClockWithoutAServerIsWrongUntilAHostSetsIt) {
    Options options = release("1.7.1", "unreachable");
    options.insert(pinging.begin(), pinging.end());
    SonarBench sonar(options);
    EXPECT_NE(
        sonar.get("/time/status").find(R"("system_time":"2025-01-01T00:00:00.000000Z","ntp_synced":false)"),
        std::string::npos);
    EXPECT_NEAR(SeenImage(sonar.packets_until(250ms).at(0).bytes).seconds(), 1735689600, 0.1);
    for (const char* wrong : {R"({"now":"2026-13-01T00:00:00Z"})", R"({"now":"yesterday"})", R"({"now":7})",
                              R"({"now":"2026-08-17T10:00:00"})", R"({"now":"2026-02-29T10:00:00Z"})"})
        EXPECT_EQ(sonar.post("/time/manual", wrong), 400) << wrong;
    EXPECT_EQ(sonar.post("/time/manual", R"({"now":"2026-08-17T12:00:00.500+02:00"})"), 204);
    EXPECT_NE(sonar.get("/time/status").find("2026-08-17T10:00:00.5"), std::string::npos);
    sonar.packets_until(450ms);
    EXPECT_NEAR(SeenImage(sonar.packets_until(650ms).at(0).bytes).seconds(), 1786960800.5, 1);
    sonar.bench->say(text_bytes(post_text("/time/ntp/force-sync", R"({"timeout_seconds": 2.5})")));
    const auto sent = sonar.bench->sent();
    EXPECT_EQ(sent.at(0).not_before, sonar.bench->now + 2500ms) << "it waits in vain";
    EXPECT_NE(std::string(sent[0].bytes.begin(), sent[0].bytes.end()).find(R"("success":false)"),
              std::string::npos);
}

TEST(Sonar3d15, SendsBatchesOfItsImuWhenAskedTo) {
    SonarBench sonar(release("1.8.0"), {"tcp-listen://127.0.0.1:80", "udp://127.0.0.1:4747"});
    EXPECT_TRUE(sonar.packets_until(1s).empty());
    EXPECT_EQ(sonar.post("/output/imu-batch/enabled", "true"), 204);
    const auto packets = sonar.packets_until(2s);
    ASSERT_EQ(packets.size(), 10U) << "10 samples of 10 ms each";
    const SeenImage batch(packets[3].bytes);
    EXPECT_EQ(batch.type_url, "type.googleapis.com/waterlinked.sonar.protocol.ImuBatch");
    EXPECT_EQ(batch.message.numbers.at(1), 3U);
    EXPECT_EQ(batch.message.numbers.at(2), 10U);
    const Bytes force = batch.message.blocks.at(4);
    ASSERT_EQ(force.size(), 10U * 3 * 4);
    float down = 0;
    std::memcpy(&down, force.data() + 8, 4);
    EXPECT_NEAR(down, -9.81, 1e-3) << "z points down, what holds it points up";
    EXPECT_EQ(batch.message.blocks.at(5).size(), 120U);
    EXPECT_EQ(sonar.post("/output/imu-batch/enabled", "false"), 204);
    EXPECT_TRUE(sonar.packets_until(3s).empty());
}

TEST(Sonar3d15, ARequestThatNeverEndsIsGivenUpAndANewConnectionStartsClean) {
    SonarBench sonar;
    EXPECT_EQ(sonar.ask("POST " + integration + "/udp HTTP/1.1\r\nContent-Length: 500\r\n\r\n{"), "");
    sonar.bench->run_to(4999ms);
    EXPECT_TRUE(sonar.bench->sent().empty());
    sonar.bench->run_to(5s);
    const auto sent = sonar.bench->sent();
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_EQ(std::string(sent[0].bytes.begin(), sent[0].bytes.begin() + 12), "HTTP/1.1 408");
    EXPECT_TRUE(sent[0].hang_up) << "as Connection: close says";
    EXPECT_EQ(sonar.get("/temperature"), "21.0");
    EXPECT_EQ(sonar.ask("GET /half"), "");
    sonar.bench->disconnect(0, {});
    EXPECT_EQ(sonar.get("/temperature"), "21.0");
}

TEST(Sonar3d15, ARequestThatDripsIsGivenUpAsWell) {
    SonarBench sonar;
    EXPECT_EQ(sonar.ask("GET /"), "");
    sonar.bench->run_to(4s);
    EXPECT_EQ(sonar.ask("h"), "");
    sonar.bench->run_to(5s);
    const auto sent = sonar.bench->sent();
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_EQ(std::string(sent[0].bytes.begin(), sent[0].bytes.begin() + 12), "HTTP/1.1 408");
}

TEST(Sonar3d15, AConnectionThatAsksNothingIsClosedForTheNextOne) {
    SonarBench sonar;
    const Address idle{0x7F000001, 40000};
    const auto wake = sonar.bench->device().connected(0, idle, 0s).wake;
    ASSERT_EQ(wake, Time(5s));
    const auto sent = sonar.bench->device().woken(5s).send;
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_TRUE(sent[0].hang_up && sent[0].bytes.empty());
    EXPECT_EQ(sent[0].to, idle);
    EXPECT_EQ(sonar.bench->device().counters().rejected, 0U);
    EXPECT_EQ(sonar.get("/temperature"), "21.0");
    sonar.bench->device().connected(0, {0x7F000001, 40001}, 10s);
    EXPECT_EQ(sonar.bench->device().disconnected(0, {0x7F000001, 40001}, 11s).wake, Time::max())
        << "nobody is waited for";
}

TEST(Sonar3d15, ServesFourHostsAtOnceEachWithARequestOfItsOwn) {
    SonarBench sonar;
    EXPECT_EQ(sonar.bench->device().ports().at(0).drivers, 4U);
    const std::string request = get_text("/temperature");
    std::vector<Address> hosts;
    for (std::uint16_t port = 40000; port < 40004; ++port) hosts.push_back({0x7F000001, port});
    for (const Address& host : hosts) sonar.bench->connect(0, host);
    for (const std::size_t at : {std::size_t{0}, request.size() / 2}) {
        EXPECT_TRUE(sonar.bench->sent().empty());
        for (const Address& host : hosts)
            if (host != hosts.back() || at == 0)
                sonar.bench->say(
                    text_bytes(request.substr(at, at == 0 ? request.size() / 2 : std::string::npos)), 0,
                    host);
    }
    const auto answers = sonar.bench->sent();
    ASSERT_EQ(answers.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(answers[i].to, hosts[i]);
        EXPECT_TRUE(std::string(answers[i].bytes.begin(), answers[i].bytes.end()).ends_with("21.0"));
    }
    sonar.bench->run_to(5s);
    const auto late = sonar.bench->sent();
    ASSERT_EQ(late.size(), 1U);
    EXPECT_EQ(late[0].to, hosts.back()) << "half a request is given up without the others";
}

TEST(Sonar3d15, ABodyInChunksIsReadAsOneWithItsLength) {
    SonarBench sonar;
    EXPECT_EQ(sonar.status("POST " + integration +
                           "/acoustics/range HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n"
                           "b\r\n{\"min\": 0.3\r\nC;x=y\r\n, \"max\": 16}\r\n0\r\n\r\n"),
              204);
    EXPECT_EQ(sonar.get("/acoustics/range"), R"({"min":0.3,"max":16.0})");
    EXPECT_EQ(sonar.ask("POST " + integration + "/udp HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n"), "");
    sonar.bench->run_to(5s);
    const auto sent = sonar.bench->sent();
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_EQ(std::string(sent[0].bytes.begin(), sent[0].bytes.begin() + 12), "HTTP/1.1 408");
}

TEST(Sonar3d15, ServesItsHostAfterNoiseOnTheLine) {
    SonarBench sonar;
    NoisyHost host;
    for (const std::string& text :
         {post_text("/acoustics/range", R"({"min": 2.0, "max": 3.0})"), get_text("/about"),
          post_text("/udp",
                    R"({"mode":"multicast","unicast_destination_ip":"","unicast_destination_port":0})")})
        host.words.push_back(to_hex(text_bytes(text)));
    host.request = to_hex(text_bytes(get_text("/temperature")));
    host.quiet = 5s;  // what a damaged length waits for is given up by then
    host.is_answer = [](const Send& send) {
        return send.port == 0 && std::string(send.bytes.begin(), send.bytes.end()).ends_with("\r\n\r\n21.0");
    };
    expect_no_wedge(*sonar.bench, host, 500);
}

}  // namespace
}  // namespace echoloop::test
