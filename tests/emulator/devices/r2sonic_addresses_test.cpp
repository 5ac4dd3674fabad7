// Where a Sonic and its SIM are found, and what of a host's R2DC they take over.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/r2sonic_bench.h"

namespace echoloop::test {
namespace {

const std::vector<std::string> with_sim{"udp-listen://127.0.0.1:65500", "udp://127.0.0.1:65400",
                                        "udp-listen://127.0.0.1:65300"};

Bytes discovery_request() {
    Bytes bytes;
    put(bytes, "R2DD", 4);
    put(bytes, 0x7F000001u);
    put(bytes, 65400u << 16);
    for (int i = 0; i < 8; ++i) put(bytes, 0u);
    return bytes;
}

struct R2dc {
    std::string serial = "100017";
    Address gui{0x7F000001, 65400}, head{0x7F000001, 65500};
    std::array<std::uint16_t, 2> daq_ports{4100, 4200};  // on 127.0.0.1
};
Bytes configuration(const R2dc& what) {
    Bytes b;
    const auto zeros = [&](int words) {
        for (int i = 0; i < words; ++i) put(b, 0u);
    };
    put(b, "R2DC", 4);
    put(b, what.serial, 12);
    put(b, 99u);  // ConfigID
    zeros(2);
    put(b, what.gui.ip);
    put(b, std::uint32_t{what.gui.port} << 16);
    put(b, what.head.ip);  // 36
    zeros(3);
    put(b, std::uint32_t{what.head.port} << 16);  // 52
    zeros(1 + 6);                                 // 60: SIMs
    put(b, 0x7F000001u);                          // 84: data acquisition
    put(b, 0x7F000001u);
    zeros(6);
    put(b, std::uint32_t{what.daq_ports[0]} << 16 | what.daq_ports[1]);  // 116
    zeros(3 + 8);
    return b;
}

TEST(R2SonicDiscovery, AnswersTheSender) {
    Bench bench = head({{"trigger", std::string("command")}}, with_sim);
    bench.run_to(1ms);
    bench.sent();
    bench.say(discovery_request(), 1, {0x7F000001, 41000});
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
    bench.say(configuration({.gui = {0x7F000002, 4000}}), 1);
    bench.sent();
    bench.run_to(1500ms);
    auto sent = named(bench.sent(), "R2DS");
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_EQ(sent[0].to, (Address{0x7F000002, 4002}));
    EXPECT_EQ(u32(sent[0].bytes, 16), 99u) << "ConfigID";
    bench.say(configuration({.gui = {0x0A000166, 65400}}), 1);
    bench.say(configuration({.serial = "999999", .gui = {0x7F000001, 5000}}), 1);
    bench.run_to(2600ms);
    sent = named(bench.sent(), "R2DS");
    EXPECT_EQ(sent.at(0).to, (Address{0x7F000002, 4002}));
}

TEST(R2SonicAddresses, DataAcquisitionHostsGetTheirOwn) {
    Bench bench = head({{"range", 15.0}, {"data_hosts", std::string("configured")}});
    for (const char* what : {"WCM0", "TPM0"}) bench.say(command(what, std::uint32_t{1}));
    bench.say(configuration({}), 1);
    bench.echo_bin = 500;
    bench.echo_power = 1e12F;
    bench.run_to(100ms);
    const auto sent = bench.sent();
    EXPECT_EQ(named(sent, "TPX0").back().to.port, 4101);
    EXPECT_EQ(named(sent, "WCD0").back().to.port, 4205);
    EXPECT_EQ(named(sent, "BTH0").back().to, gui);
}

/// The ConfigID that the head tells in its next R2DS.
std::uint32_t config_id(Bench& bench) {
    bench.sent();
    bench.run_to(bench.now + 1300ms);
    return u32(named(bench.sent(), "R2DS").back().bytes, 16);
}

TEST(R2SonicAddresses, AnotherAddressForTheHeadItselfIsNotTakenOver) {
    Bench bench = head({{"range", 15.0}});
    bench.say(configuration({.head = {0x7F000001, 60000}}), 1);
    EXPECT_EQ(config_id(bench), 0u) << "the control program asks again rather than believe it";
    EXPECT_EQ(bench.device().counters().rejected, 1u);
    bench.say(configuration({}), 1);
    EXPECT_EQ(config_id(bench), 99u);
}

TEST(R2SonicAddresses, AHeadOnAllAddressesOfItsMachineMayBeGivenAnyOfThem) {
    Bench bench =
        head({{"trigger", std::string("command")}}, {"udp-listen://0.0.0.0:65500", "udp://10.0.1.102:65400"});
    const Address host{0x0A000166, 65400};
    bench.say(configuration({.gui = host, .head = {0x0A000056, 65300}}), 1);
    EXPECT_EQ(config_id(bench), 0u) << "it listens at another port";
    EXPECT_EQ(bench.device().counters().rejected, 1u);
    bench.say(configuration({.gui = host, .head = {0x0A000056, 65500}}), 1);
    EXPECT_EQ(config_id(bench), 99u);
    EXPECT_EQ(bench.device().counters().rejected, 1u);
}

TEST(R2SonicAddresses, AnEntryWithoutAnIpGivesTheHeadNone) {
    Bench bench = head({{"trigger", std::string("command")}});
    bench.say(configuration({.head = {0, 65300}}), 1);
    EXPECT_EQ(config_id(bench), 99u);
}

TEST(R2SonicAddresses, BasePortsWithTooFewPortsAboveThemAreRefused) {
    Bench bench = head({{"trigger", std::string("command")}, {"data_hosts", std::string("configured")}});
    bench.say(configuration({.gui = {0x7F000001, 65529}}), 1);
    bench.say(configuration({.daq_ports = {65529, 4200}}), 1);
    bench.say(configuration({.daq_ports = {4100, 65535}}), 1);
    EXPECT_EQ(config_id(bench), 0u);
    EXPECT_EQ(bench.device().counters().rejected, 3u);
    bench.say(configuration({.gui = {0x7F000001, 65528}, .daq_ports = {65528, 65528}}), 1);
    bench.sent();
    bench.run_to(bench.now + 1300ms);
    const auto sent = named(bench.sent(), "R2DS");
    EXPECT_EQ(sent.at(0).to.port, 65530);
    EXPECT_EQ(u32(sent[0].bytes, 16), 99u);
}

TEST(R2SonicDiscovery, EachPartAnswersFromItsOwnAddress) {
    const std::string any = "udp://127.0.0.1:65400";
    Bench bench = head({{"trigger", std::string("command")}},
                       {"udp-listen://127.0.0.2:65500", any, "udp-listen://127.0.0.3:65300"});
    const auto ports = bench.device().ports();
    ASSERT_EQ(ports.size(), 10u);
    bench.run_to(1ms);
    bench.sent();
    for (const std::size_t asked : {1, 8, 9}) {  // the head's, the SIM's, where broadcasts arrive
        bench.say(discovery_request(), asked, {0x7F000001, 41000});
        const auto sent = named(bench.sent(), "R2DI");
        ASSERT_EQ(sent.size(), 2u);
        EXPECT_EQ(ports[sent[0].port].bind, (Address{0x7F000002, 53810}));
        EXPECT_EQ(ports[sent[1].port].bind, (Address{0x7F000003, 53810}));
    }
    EXPECT_EQ(ports[9].bind, (Address{0x7FFFFFFF, 53810}));
    const auto remote =
        head({}, {"udp-listen://10.0.0.86:65500", any, "udp-listen://10.0.0.99:65500"}).device().ports();
    EXPECT_EQ(remote[1].bind, (Address{0x0A000056, 53810}));
    EXPECT_EQ(remote[8].bind, (Address{0x0A000063, 53810}));
    EXPECT_EQ(remote[9].bind, (Address{0, 53810}));
}

// As a recording of a Sonic 2022 has them.
TEST(R2SonicAddresses, EachProductLeavesFromItsOwnPort) {
    Bench bench = head({{"range", 4.0},
                        {"image_height", std::int64_t{100}},
                        {"water_column", std::string("magnitude")},
                        {"snippets", true},
                        {"truepix", std::string("magnitude")}});
    bench.echo_bin = 100, bench.echo_power = 1e14F;
    bench.run_to(1300ms);
    const auto ports = bench.device().ports();
    const auto sent = bench.sent();
    for (const auto& [packet, offset] : {std::pair{"BTH0", 0},
                                         {"TPX0", 1},
                                         {"STH0", 2},
                                         {"R2DS", 2},
                                         {"AID0", 3},
                                         {"WCD0", 5},
                                         {"SNI0", 6}}) {
        const auto found = named(sent, packet);
        ASSERT_FALSE(found.empty()) << packet;
        EXPECT_EQ(ports[found[0].port].bind,
                  (Address{0x7F000001, static_cast<std::uint16_t>(65500 + offset)}))
            << packet;
        EXPECT_EQ(found[0].to.port, 65400 + offset) << packet;
    }
}

TEST(R2SonicAddresses, AHeadThatIsSwitchedOffNeitherAnswersNorIsConfigured) {
    Bench bench = head({{"trigger", std::string("command")}}, with_sim);
    bench.run_to(1ms);
    bench.say(command("SPO0", std::uint32_t{0}), sim_port);
    bench.sent();
    bench.say(discovery_request(), 1, {0x7F000001, 41000});
    const auto found = named(bench.sent(), "R2DI");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(name(found[0].bytes, 4, 6), "100117") << "the SIM";
    bench.say(configuration({}), 1);
    bench.say(configuration({.serial = "100117", .head = {}}), 1);
    bench.say(command("SPO0", std::uint32_t{1}), sim_port);
    bench.run_to(bench.now + 1300ms);
    const auto brief = named(bench.sent(), "R2DS");
    ASSERT_EQ(brief.size(), 2u);
    EXPECT_EQ(name(brief[0].bytes, 4, 6), "100017");
    EXPECT_EQ(u32(brief[0].bytes, 16), 0u);
    EXPECT_EQ(name(brief[1].bytes, 4, 6), "100117");
    EXPECT_EQ(u32(brief[1].bytes, 16), 99u);
    bench.say(discovery_request(), 1, {0x7F000001, 41000});
    EXPECT_EQ(named(bench.sent(), "R2DI").size(), 2u);
}

}  // namespace
}  // namespace echoloop::test
