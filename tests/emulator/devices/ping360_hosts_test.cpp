// The Ping360 as known hosts meet it: what they send before their first frame, how they scan, how they find
// it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/emulator/devices/ping360_bench.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;
using testing::Each;
using testing::ElementsAre;

Bytes text(const std::string& words) { return {words.begin(), words.end()}; }

/// What a host writes, a piece at a time, before it hears anything. A line break itself is not seen on a
/// pseudo-terminal; on a UART it arrives as a zero.
struct StartUp {
    const char* host;
    std::vector<std::string> pieces;
    bool ends_a_scan;  ///< it holds a break, or the mark that follows one
};

const std::string marks10 = "55555555555555555555";
const std::string boot_loader_probe = "5a48000048b8a5";
const std::string ask_device = "42520200060000000400a000", ask_version = "42520200060000000500a100";

std::vector<StartUp> start_ups() {
    std::vector<std::string> search{marks10, boot_loader_probe}, companion;
    for (int i = 0; i < 20; ++i) search.push_back(ask_device);
    for (int i = 0; i < 10; ++i) companion.push_back(ask_device);
    companion.push_back("5555555555555555555555");
    return {{"ping-python", {"55"}, true},
            {"ping-cpp", {marks10 + "00"}, true},
            {"Ping Viewer's link", search, true},
            {"Ping Viewer's detector", {"555555", ask_device, boot_loader_probe}, true},
            {"BlueOS", companion, true},
            {"an Asio host", {ask_version}, false},
            {"an Arduino host", {"55"}, true},
            {"ArduPilot", {}, false}};
}

/// The device information that a host reads back, from device 2 to host 0, firmware 3.3.8.
const std::string information = "4252060004000200020103030800b100";

TEST(Ping360Hosts, AreServedAfterTheirOwnStartUp) {
    for (const StartUp& host : start_ups())
        for (const bool by_byte : {false, true})
            for (const char* break_byte : {"", "00"}) {
                Bench bench = ping360();
                bench.say(from_hex(break_byte));
                for (const std::string& piece : host.pieces)
                    if (!by_byte)
                        bench.say(piece);
                    else
                        for (const std::uint8_t byte : from_hex(piece)) bench.say(Bytes{byte});
                bench.sent();
                bench.say(ask_device);
                const auto sent = bench.sent();
                ASSERT_EQ(sent.size(), 1u) << host.host;
                EXPECT_EQ(to_hex(sent[0].bytes), information) << host.host;
            }
}

TEST(Ping360Hosts, AnswerEveryProbeOfTheSearchForTheRate) {
    for (const StartUp& host : start_ups()) {
        Bench bench = ping360();
        std::size_t requests = 0;
        for (const std::string& piece : host.pieces) {
            bench.say(piece);
            requests += piece == ask_device || piece == ask_version ? 1 : 0;
        }
        EXPECT_EQ(bench.sent().size(), requests) << host.host << ": no answer more, none less";
    }
}

TEST(Ping360Hosts, EndTheScanOfTheHostBeforeThem) {
    for (const StartUp& host : start_ups()) {
        Bench bench = ping360();
        bench.say(auto_transmit(0, 399, 1));
        bench.run_to(300ms);
        for (const std::string& piece : host.pieces) bench.say(piece);
        bench.sent();
        bench.run_to(1s);
        EXPECT_EQ(bench.sent().empty(), host.ends_a_scan) << host.host;
    }
}

TEST(Ping360Hosts, NoiseAndDamageCostNoLaterRequest) {
    Bench bench = ping360();
    bench.say("00ff");  // a datagram of ping-cpp
    Bytes damaged = frame(4);
    damaged[2] = 0x20;  // claims 32 bytes that never come
    bench.say(damaged);
    EXPECT_TRUE(bench.sent().empty());
    bench.say(frame(5));
    EXPECT_THAT(ids(bench.sent()), ElementsAre(5));
}

TEST(Ping360Hosts, NoiseOfOneCostsNoOtherItsPing) {
    const std::vector<std::string> ends{"pty:/tmp/a", "udp-listen://127.0.0.1:1234"};
    const Address host{0x7F000001, 50000}, other{0x7F000001, 50001};
    const std::vector<std::pair<const char*, std::function<void(Bench&)>>> noises{
        {"an empty datagram of its own", [&](Bench& b) { b.say(Bytes{}, 1, host); }},
        {"an empty datagram", [&](Bench& b) { b.say(Bytes{}, 1, other); }},
        {"a mark", [&](Bench& b) { b.say("55", 1, other); }},
        {"marks on the pty", [&](Bench& b) { b.say(marks10, 0); }},
        {"half a frame", [&](Bench& b) { b.say("42520e00290a", 1, other); }},
        {"a program opens and closes the pty", [](Bench& b) { b.device().reconnected(0); }}};
    for (const auto& [name, noise] : noises)
        for (const Bytes& command : {transducer(10), auto_transmit(10, 12, 1)}) {
            Bench bench(make_device("ping360", ends));
            bench.say(ByteView(command).first(9), 1, host);
            noise(bench);
            bench.say(ByteView(command).subspan(9), 1, host);
            noise(bench);
            bench.run_to(62ms);  // the ping is in the water
            noise(bench);
            bench.run_to(200ms);
            const auto sent = bench.sent();
            ASSERT_FALSE(sent.empty()) << name;
            EXPECT_EQ(sent[0].to, host) << name;
            EXPECT_EQ(angles(sent)[0], 10) << name;
        }
}

TEST(Ping360Hosts, ACommandThatIsNeverAnsweredIsCounted) {
    Bench bench(make_device("ping360", {"pty:/tmp/a", "udp-listen://127.0.0.1:1234"}));
    bench.say(transducer(10), 0);
    for (int i = 0; i < 17; ++i) bench.say(transducer(20), 1, {0x7F000001, 50000});
    EXPECT_EQ(bench.device().counters().rejected, 1u) << "16 wait";
    bench.device().reconnected(0);
    EXPECT_EQ(bench.device().counters().rejected, 2u);
    bench.run_to(3s);
    EXPECT_EQ(angles(bench.sent()), std::vector<int>(16, 20)) << "the others wait on";
}

TEST(Ping360Hosts, PingViewerScansByItselfAfterAnEmptyDatagram) {
    Bench bench(make_device("ping360", {"udp-listen://127.0.0.1:1234"}));
    const Address viewer{0x7F000001, 50000};
    bench.say(frame(4), 0, viewer);
    bench.say(Bytes{}, 0, viewer);
    bench.run_to(200ms);
    EXPECT_THAT(ids(bench.sent()), ElementsAre(4));
    bench.say(auto_transmit(0, 399, 1), 0, viewer);
    bench.run_to(1s);
    auto sent = bench.sent();
    // 6 ms of motor, 2.64 ms of 2R/c, 18 ms inside an Ethernet unit
    EXPECT_NEAR(static_cast<double>(sent.size()), 800 / 26.64, 1.5);
    for (const Send& s : sent) EXPECT_EQ(s.to.port, 50000);
    bench.say(Bytes{}, 0, viewer);
    bench.say(auto_transmit(0, 399, 2), 0, viewer);  // another setting
    bench.run_to(2s);                                // the way back first
    sent = bench.sent();
    ASSERT_GT(sent.size(), 3u);
    EXPECT_EQ(angles(sent)[0], 0);
    EXPECT_EQ(angles(sent)[1], 2) << "no frame of the scan before";
    for (const Send& s : sent) EXPECT_EQ(s.bytes.at(8 + 14), 2) << "steps";
}

/// s that a host takes which asks for the next ping when it has the last one.
double scan_time(const std::string& endpoint, int pings, int step, const Options& options = {}) {
    Bench bench(make_device("ping360", {endpoint}, options));
    for (int i = 1; i <= pings; ++i) {
        bench.say(transducer(i * step % 400), 0, {0x7F000001, 50000});
        while (bench.sent().empty())
            bench.run_to(std::min(bench.wake, bench.ping ? bench.ping->due : Time::max()));
    }
    return to_seconds(bench.now);
}

TEST(Ping360Hosts, AScanOfAnEthernetUnitTakesAsLongAsInTheField) {
    const std::string ethernet = "udp-listen://127.0.0.1:12345";
    // Two public measurements with 1200 samples of 88 ticks; hosts take up to 2 ms a ping themselves.
    EXPECT_NEAR(scan_time(ethernet, 40, 10), 3.29, 0.08);
    EXPECT_GT(scan_time(ethernet, 400, 1), 10.6);
    EXPECT_LT(scan_time(ethernet, 400, 1), 11.8);
    EXPECT_NEAR(scan_time(ethernet, 40, 10, {{"ethernet_time", 0.0}}), 40 * (0.06 + 0.00264), 1e-3);
    EXPECT_NEAR(scan_time("pty:/tmp/a", 40, 10), 40 * (0.06 + 0.00264), 1e-3)
        << "a serial line is its own link";
}

TEST(Ping360Hosts, TheAnswerToATransducerComesWithinTheHostsTimeOut) {
    Bench bench = ping360();
    bench.say(transducer(200,
                         "e803409c" /* 1000 us, 40000 ticks */ "ee02b004"));  // the longest ping there is
    bench.run_to(4s);
    EXPECT_THAT(angles(bench.sent()), ElementsAre(200)) << "200 gradians and 1.2 s of 2R/c";
}

std::string found(Bench& bench, std::size_t port) {
    bench.sent();
    bench.say(text("Discovery"), port, {0x7F000001, 6000});
    const auto sent = bench.sent();
    if (sent.empty()) return "";
    EXPECT_EQ(sent[0].to.port, 6000) << "to who asked, not to all";
    return {sent[0].bytes.begin(), sent[0].bytes.end()};
}

std::string told(const std::string& address) {
    return "SONAR PING360  \r\nBlue Robotics\r\nMAC Address:- 54-10-EC-00-00-01\r\nIP Address:- " + address +
           "\r\n";
}

TEST(Ping360Discovery, IsFourLinesThatHostsTakeApart) {
    Bench bench(make_device("ping360", {"pty:/tmp/a", "udp-listen://127.0.0.2:12345"}));
    const auto ports = bench.device().ports();
    ASSERT_EQ(ports.size(), 4u);
    EXPECT_EQ(ports[2].bind, (Address{0x7F000002, 30303}));
    EXPECT_EQ(ports[3].bind, (Address{0x7FFFFFFF, 30303})) << "broadcasts on loopback";
    EXPECT_EQ(found(bench, 2), told("127.000.000.002"));
    EXPECT_EQ(found(bench, 3), told("127.000.000.002"));
    bench.say(text("discovery?"), 2);
    bench.say(text("Discovery of something else"), 2);
    bench.say(frame(4), 2);
    EXPECT_TRUE(bench.sent().empty()) << "nothing else is answered";
}

TEST(Ping360Discovery, TellsTheAddressThatAHostHasSet) {
    Bench bench = ping360({{"discovery", std::string("192.168.2.9")}});
    EXPECT_EQ(bench.device().ports().at(1).bind, (Address{0, 30303})) << "broadcasts come to all addresses";
    EXPECT_EQ(found(bench, 1), told("192.168.002.009"));
    bench.say(text("SetSS1IP 010.000.000.123"), 1);
    EXPECT_TRUE(bench.sent().empty()) << "no reply";
    EXPECT_EQ(found(bench, 1), told("010.000.000.123"));
    for (const char* wrong :
         {"SetSS1IP 010.000.000.256", "SetSS1IP 10.0.0", "SetSS1IP", "SetSS1IP 1.2.3.4.5"})
        bench.say(text(wrong), 1);
    EXPECT_EQ(found(bench, 1), told("010.000.000.123"));
    bench.say(text("SetSS1IP 000.000.000.000"), 1);
    EXPECT_EQ(found(bench, 1), told("192.168.002.009")) << "DHCP";
}

TEST(Ping360Discovery, IsSilentWithoutAnEndpointThatHostsWouldFind) {
    for (const char* uri : {"pty:/tmp/a", "udp-listen://127.0.0.1:1234", "tcp-listen://127.0.0.1:12345"})
        EXPECT_EQ(make_device("ping360", {uri})->ports().size(), 1u) << uri;
    const std::vector<std::string> there{"udp-listen://127.0.0.1:12345"};
    EXPECT_EQ(make_device("ping360", there, {{"discovery", std::string("off")}})->ports().size(), 1u);
    for (const char* wrong : {"", "on", "127.0.0.256", "localhost", "0.0.0.0"})
        EXPECT_THROW(make_device("ping360", there, {{"discovery", std::string(wrong)}}),
                     std::invalid_argument);
}

}  // namespace
}  // namespace echoloop::test
