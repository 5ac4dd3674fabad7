// What hosts of the 7k multibeam may say, over TCP and UDP, and what they are answered.
#include <map>

#include "tests/emulator/devices/reson7k_bench.h"

namespace echoloop::test {
namespace {

TEST(Reson7k, RefusesWithTheReason) {
    Reson sonar;
    EXPECT_EQ(sonar.answer(control(1003, {f32(1e6)})), 0x7001U);
    EXPECT_EQ(sonar.answer(control(1003, {0x7FC00000})), 0x7001U) << "not a number";
    EXPECT_EQ(sonar.answer(control(1003)), 0x7008U) << "no value";
    EXPECT_EQ(sonar.answer(control(1007, {1})), 0x7001U) << "no chirp";
    EXPECT_EQ(sonar.answer(control(1050, {7027})), 0x700AU);
    EXPECT_EQ(sonar.answer(control(1050, {4711})), 0x7002U);
    EXPECT_EQ(sonar.answer(control(1051, {1, 4711})), 0x7002U);
    EXPECT_EQ(sonar.answer(control(1051, {1000000, 7000})), 0x7008U) << "a lying count";
    EXPECT_EQ(sonar.answer(control(4711)), 0x7007U);
    EXPECT_EQ(sonar.answer(control(1003, {f32(30)}, 8101)), 0x7009U);
    EXPECT_EQ(sonar.answer(control(1003, {f32(30)}, 7000)), 0x7009U) << "settings are the device's";
    EXPECT_EQ(sonar.answer(control(1051, {1, 7000}, 7000)), 0U) << "the centre has the records";
    EXPECT_EQ(sonar.answer(control(1010, {f32(1), f32(2), f32(0), f32(50), f32(0)})), 0x7001U);
    EXPECT_EQ(Reson(Options{{"command_device", std::string("any")}}).answer(control(1003, {f32(30)}, 1)), 0U);
}

TEST(Reson7k, AnswersRequestsBehindTheAcknowledge) {
    Reson sonar;
    sonar.say(control(1003, {f32(25)}));
    sonar.sent();
    sonar.say(control(1050, {7503}));
    auto records = records_of(sonar.sent());
    ASSERT_EQ(records.size(), 2U);
    EXPECT_EQ(records[1].type(), 7503U);
    EXPECT_EQ(records[1].get<std::uint32_t>(8), 0U) << "no ping";
    EXPECT_FLOAT_EQ(records[1].get<float>(52), 25) << "2 bytes earlier than in 7000";
    EXPECT_EQ(records[1].bytes.size(), 64U + 260 + 4);
    sonar.say(control(1050, {7001}, 7000));
    records = records_of(sonar.sent());
    ASSERT_EQ(records.size(), 2U);
    EXPECT_EQ(records[1].get<std::uint32_t>(12), 7125U) << "the device to talk to";
}

TEST(Reson7k, ServesHostsByUdpUntilTheyEndIt) {
    Reson sonar;
    const Address host{0x7F000001, 40000}, third{0x7F000002, 5000};
    EXPECT_EQ(sonar.answer(control(1051, {1, 7018}), 1, host), 0U);
    EXPECT_EQ(sonar.answer(control(1053, {third.ip, third.port, 1, 7000})), 0U);
    sonar.disconnect(0, {});
    sonar.run_to(sonar.now + 200ms);
    const auto sends = sonar.sent();
    Time before{};
    std::size_t to_third = 0;
    for (const Send& send : sends) {
        EXPECT_EQ(send.port, 1U);
        EXPECT_LE(send.bytes.size(), 60000U);
        EXPECT_GE(send.not_before, before + (before > Time{} ? 299us : 0us)) << "paced";
        before = send.not_before;
        to_third += send.to == third;
        EXPECT_TRUE(send.to == third || send.to == host);
    }
    EXPECT_GT(to_third, 0U);
    EXPECT_GT(sends.size(), 30U);
    EXPECT_EQ(sonar.answer(control(1054, {third.ip, third.port})), 0U);
    EXPECT_EQ(sonar.answer(control(1052), 1, host), 0U);
    EXPECT_TRUE(sonar.within(1s).empty());
    EXPECT_EQ(sonar.answer(control(1053, {0x08080808, 53, 1, 7000})), 0x700CU) << "from loopback";
    EXPECT_EQ(sonar.answer(control(1053, {third.ip, 1U << 16 | 5000, 1, 7000})), 0x700CU) << "by TCP";
    EXPECT_EQ(sonar.answer(control(1053, {third.ip, 0, 1, 7000})), 0x7008U) << "no port";
    EXPECT_EQ(sonar.answer(control(1053, {0, 5000, 1, 7000})), 0x7008U) << "no address";
    EXPECT_TRUE(sonar.within(1s).empty());
}

/// Every ping's datagrams to all hosts leave before the next ping.
void expect_bounded_latency(Reson& sonar, Time period) {
    sonar.run_to(sonar.now + 3 * period);
    sonar.sent();
    for (int ping = 0; ping < 20; ++ping) {
        const std::size_t pings = sonar.shots.size();
        while (sonar.shots.size() == pings) sonar.run_to(sonar.now + 1ms);
        const Time heard = sonar.now;
        Time before{};
        std::size_t datagrams = 0;
        for (const Send& send : sonar.sent()) {
            if (send.port == 0) {
                EXPECT_LE(send.not_before, heard) << "TCP does not wait";
                continue;
            }
            EXPECT_LT(send.not_before, heard + period) << "ping " << ping;
            EXPECT_GE(send.not_before, before) << "records do not mix";
            before = send.not_before;
            ++datagrams;
        }
        ASSERT_GT(datagrams, 30U);
        EXPECT_GT(before, heard + period / 2) << "but they are spread";
    }
}

TEST(Reson7k, DatagramsToSixteenHostsAreOutBeforeTheNextPing) {
    Reson sonar;
    sonar.answer(control(1051, {2, 7000, 7018}));
    for (std::uint16_t host = 0; host < 16; ++host)
        ASSERT_EQ(sonar.answer(control(1051, {2, 7018, 7027}), 1,
                               {0x7F000001, static_cast<std::uint16_t>(40000 + host)}),
                  0U);
    expect_bounded_latency(sonar, 71667us);  // 2 x 50 / 1500 s and 5 ms
}

TEST(Reson7k, AGapThatIsTooLargeShrinks) {
    Reson sonar(Options{{"datagram_gap", 0.1}});
    const Address host{0x7F000001, 40000};
    ASSERT_EQ(sonar.answer(control(1051, {1, 7018}), 1, host), 0U);
    expect_bounded_latency(sonar, 71667us);
    sonar.sent();
    sonar.say(control(1003, {f32(40)}), 1, host);
    sonar.say(control(1050, {7503}), 1, host);
    const auto answers = sonar.sent();
    ASSERT_EQ(answers.size(), 3U);
    for (const Send& answer : answers)
        EXPECT_LE(answer.not_before, sonar.now + 71667us) << "answers wait for a ping's datagrams, no longer";
}

TEST(Reson7k, The1053OfTheIntroductionEndsSubscriptionsOnlyWithoutAnAddress) {
    Reson sonar(Options{{"end_subscriptions", std::string("1053")}});
    const Address third{0x7F000002, 5000};
    EXPECT_EQ(sonar.answer(control(1051, {1, 7000})), 0U);
    EXPECT_EQ(sonar.answer(control(1053, {third.ip, third.port, 1, 7027})), 0U);
    std::map<std::uint32_t, std::uint16_t> to;
    for (const Seen& record : sonar.within(500ms)) to[record.type()] = record.to.port;
    EXPECT_EQ(to, (std::map<std::uint32_t, std::uint16_t>{{7000, 0}, {7027, third.port}}));
    EXPECT_EQ(sonar.answer(control(1053)), 0U);
    for (const Seen& record : sonar.within(500ms)) EXPECT_EQ(record.type(), 7027U) << "its own have ended";
    EXPECT_EQ(sonar.answer(control(1052)), 0x7007U);
}

/// MBARI's client (MB-System, mbtrn) subscribes to the centre with offset 64 in its record frame.
TEST(Reson7k, AHostWithItsOwnIdeaOfTheFramesOffsetIsServed) {
    Reson sonar;
    Bytes subscribes = control(1051, {3, 1003, 7000, 7027}, 7000);
    put(subscribes, 38, 64, 2);
    subscribes.resize(subscribes.size() - 4);
    put(subscribes, subscribes.size(), std::accumulate(subscribes.begin() + 36, subscribes.end(), 0U));
    EXPECT_EQ(sonar.answer(subscribes), 0U);
    EXPECT_EQ(sonar.next(7000).get<std::uint32_t>(8), 1U);
    EXPECT_EQ(sonar.next(7027).get<std::uint32_t>(14), 256U);
}

/// A host that knows no device asks the centre for its configuration, looks for the device in it and
/// subscribes there, as the maker's example does.
TEST(Reson7k, ItsConfigurationTellsAHostWhomToSubscribeTo) {
    Reson sonar(Options{{"device", std::int64_t{20}}});
    sonar.say(control(1050, {7001}, 7000));
    const auto records = records_of(sonar.sent());
    ASSERT_EQ(records.size(), 2U);
    const Seen& record = records[1];
    ASSERT_EQ(record.get<std::uint32_t>(8), 1U) << "devices";
    const auto size = record.get<std::uint32_t>(12 + 76);
    ASSERT_EQ(record.bytes.size(), 64U + 12 + 80 + size + 4);
    const std::string xml(record.bytes.begin() + 64 + 92, record.bytes.end() - 4);
    ASSERT_EQ(xml.back(), 0);
    std::size_t at = 0;
    const auto behind = [&](const std::string& word) {
        at = xml.find(word, at);
        EXPECT_NE(at, xml.npos) << word << " in " << xml;
        return at == xml.npos ? std::string() : xml.substr(at + word.size(), 8);
    };
    behind("<Name");
    EXPECT_EQ(std::stoul(behind("deviceid=\"")), 20U);
    EXPECT_TRUE(behind("enumerator=\"").starts_with("0\""));
    behind("<SonarType");
    EXPECT_TRUE(behind("type=\"").starts_with("0\""));
    behind("<RxBeamWidth");
    EXPECT_TRUE(behind(" along=\"").starts_with("0.471238"));
    behind("<PingRate");
    EXPECT_TRUE(behind("min=\"").starts_with("0\""));
    // Where readers of logs look for the serial number: 60 characters.
    const std::string description(record.bytes.begin() + 64 + 16, record.bytes.begin() + 64 + 76);
    EXPECT_TRUE(description.starts_with(std::string("SN2812017\0001\0000\0003\0003\000", 15)));
    EXPECT_EQ(sonar.answer(control(1051, {2, 7027, 7011}, 20)), 0U);
    EXPECT_EQ(sonar.next(7027).get<std::uint32_t>(14), 256U);
    EXPECT_EQ(sonar.next(7011).get<std::uint16_t>(14), 1U) << "byte of a pixel";
}

TEST(Reson7k, HostsOnTcpHaveSubscriptionsOfTheirOwn) {
    Reson sonar;
    const Address one{0x7F000001, 40001}, other{0x7F000001, 40002};
    sonar.connect(0, one);
    sonar.connect(0, other);
    const Bytes subscribes = control(1051, {1, 7027});
    sonar.say(ByteView(subscribes).first(60), 0, one);
    EXPECT_EQ(sonar.answer(control(1051, {1, 7000}), 0, other), 0U) << "between the halves of another's";
    EXPECT_EQ(sonar.answer(Bytes(subscribes.begin() + 60, subscribes.end()), 0, one), 0U);
    std::map<std::uint16_t, std::map<std::uint32_t, std::size_t>> got;
    for (const Seen& record : sonar.within(1s)) ++got[record.to.port][record.type()];
    EXPECT_EQ(got.size(), 2U);
    EXPECT_EQ(got[one.port].size(), 1U);
    EXPECT_GT(got[one.port][7027], 5U);
    EXPECT_EQ(got[other.port].size(), 1U);
    EXPECT_EQ(got[other.port][7000], got[one.port][7027]);
    sonar.answer(control(1052), 0, other);
    for (const Seen& record : sonar.within(500ms)) EXPECT_EQ(record.to, one) << "the other's has ended";
    sonar.answer(control(1051, {1, 7000}), 0, other);
    sonar.disconnect(0, one);
    const auto records = sonar.within(500ms);
    EXPECT_GT(records.size(), 2U);
    for (const Seen& record : records) EXPECT_EQ(record.to, other) << "who is still connected";
}

TEST(Reson7k, LongRangesThinTheSamplesOut) {
    Reson sonar;
    sonar.answer(control(1003, {f32(300)}));
    sonar.answer(control(1051, {1, 7000}));
    sonar.next(7000);
    const float rate = sonar.next(7000).get<float>(18);
    EXPECT_FLOAT_EQ(rate, 34500.0F / 4);
    EXPECT_LE(sonar.shots.back().bins, 4096U);
    EXPECT_DOUBLE_EQ(sonar.shots.back().bin_interval, 4 / 34500.0);
}

TEST(Reson7k, RecordsTellTheEndOfTheTransmission) {
    const Model& row = *find_model("reson-7k");
    DeviceConfig config = make_config(row);
    config.unix_start = 1735689599;  // 31 December 2024, 23:59:59 UTC
    Bench sonar(row.make(config));
    sonar.say(control(1051, {1, 7000}));
    sonar.sent();
    sonar.run_to(90ms);
    const auto records = records_of(sonar.sent());
    ASSERT_EQ(records.size(), 1U);
    EXPECT_EQ(at<std::uint16_t>(records[0].bytes, 20), 2024);
    EXPECT_EQ(at<std::uint16_t>(records[0].bytes, 22), 366);
    EXPECT_NEAR(at<float>(records[0].bytes, 24), 59 + 60e-6, 1e-5);
    EXPECT_EQ(records[0].bytes[28], 23);
    EXPECT_EQ(records[0].bytes[29], 59);
}

TEST(Reson7k, AHostOnANoisyWireIsServedAgainWithinOneRequest) {
    Reson sonar(Options{{"beams", std::int64_t{16}}, {"max_ping_rate", 2.0}});
    NoisyHost host;
    for (const Bytes& word :
         {control(1051, {2, 7000, 7027}), control(1003, {f32(30)}), control(1052), control(1100)})
        host.words.push_back(to_hex(word));
    host.request = to_hex(control(1050, {7503}, 7125, 99));
    host.is_answer = [](const Send& send) {
        return at<std::uint32_t>(send.bytes, 36 + 32) == 7501 && at<std::uint32_t>(send.bytes, 100) == 99;
    };
    host.patience = 1ms;
    expect_no_wedge(sonar, host);
}

}  // namespace
}  // namespace echoloop::test
