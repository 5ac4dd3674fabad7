// What an S500 answers: its own messages, those of a Ping1D, and what it does not know.
#include "tests/emulator/devices/cerulean_bench.h"

namespace echoloop::test {
namespace {

Bench s500(const Options& changes = {}) { return cerulean_sonar("s500", changes); }

TEST(S500, AnswersEveryGetInBothWaysOfAsking) {
    Bench bench = s500();
    const auto answer = [&](int id) {
        bench.say(frame(6, le(static_cast<std::uint64_t>(id), 2)));
        bench.say(frame(id));
        const auto sent = bench.sent();
        EXPECT_EQ(sent.size(), 2U) << id;
        EXPECT_EQ(sent.at(0).bytes, sent.at(1).bytes) << id;
        EXPECT_EQ(u16(sent.at(0).bytes, 4), id);
        const Bytes& b = sent.at(0).bytes;
        return to_hex(ByteView(b).subspan(8, b.size() - 10));
    };
    EXPECT_EQ(answer(4), "c60101000000");
    EXPECT_EQ(answer(5), "01000000");
    EXPECT_EQ(answer(1200), "c60101000000");
    EXPECT_EQ(answer(1203), "60e31600");
    EXPECT_EQ(answer(1204), "0000000010270000");
    EXPECT_EQ(answer(1206), "0000");
    EXPECT_EQ(answer(1207), "06000000");
    EXPECT_EQ(answer(1211), "0000000000");
    EXPECT_EQ(answer(1213), "a00f") << "as an owner saw it";
    EXPECT_EQ(answer(1223).size(), 32U);
    EXPECT_EQ(answer(1308).size(), 132U);
    bench.say(frame(S500Params{.start = 500, .length = 7500, .gain = 9, .msec = 250}));
    EXPECT_EQ(answer(1204), "f40100004c1d0000");
    EXPECT_EQ(answer(1206), "fa00");
    EXPECT_EQ(answer(1207), "09000000");
}

TEST(S500, AHostOfAPing1dConnects) {
    Bench bench = s500();
    bench.echo_bin = 307;  // of 1024 in 10 m
    bench.echo_power = 1e13F;
    bench.say("42520000ba0400005201");  // general_info, as a public host asks first
    auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U);
    // firmware 1.0, 5000 mV, 0 ms, gain 6, automatic
    EXPECT_EQ(to_hex(ByteView(sent[0].bytes).subspan(8, 10)), "01000000881300000601");
    for (const auto& [id, value] :
         {std::pair{1000, "0a"}, {1002, "a0081600"}, {1003, "00"}, {1004, "6400"}, {1006, "01"}}) {
        bench.say(frame(id, value));
        sent = bench.sent();
        ASSERT_EQ(sent.size(), 1U) << id;
        EXPECT_EQ(u16(sent[0].bytes, 4), 1) << "ack";
        EXPECT_EQ(u16(sent[0].bytes, 8), id);
    }
    bench.run_to(1s);
    EXPECT_TRUE(bench.sent().empty()) << "nobody asked for reports";
    EXPECT_NEAR(static_cast<double>(bench.shots.size()), 10, 1);
    bench.say(frame(1212));
    const Bytes distance = bench.sent().at(0).bytes;
    EXPECT_EQ(distance[6], 10) << "the id that was set";
    EXPECT_NEAR(u32(distance, 8), 3000, 15);
    EXPECT_EQ(u16(distance, 12), 100);
    bench.say(frame(1006, "00"));
    bench.sent();
    const auto pings = bench.shots.size();
    bench.run_to(3s);
    EXPECT_LE(bench.shots.size(), pings + 1);
    bench.say(frame(1003, "02"));
    EXPECT_EQ(u16(bench.sent().at(0).bytes, 4), nack);
}

TEST(S500, AnUnknownIdIsAnsweredInWords) {
    Bench bench = s500();
    bench.say(frame(4321));
    auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_EQ(u16(sent[0].bytes, 4), 3);
    EXPECT_EQ(std::string(sent[0].bytes.begin() + 8, sent[0].bytes.end() - 2), "Unknown message id 4321");
    bench.say(sent[0].bytes);
    EXPECT_TRUE(bench.sent().empty()) << "words are never answered";
}

TEST(S500, RefusesWhatIsOutOfRange) {
    for (const auto& params : {S500Params{.length = 500001}, S500Params{.gain = 14}, S500Params{.gain = -2},
                               S500Params{.msec = -2}, S500Params{.report = 1300}}) {
        Bench bench = s500();
        bench.say(frame(params));
        const auto sent = bench.sent();
        ASSERT_EQ(u16(sent.at(0).bytes, 4), nack);
        EXPECT_EQ(u16(sent.at(0).bytes, 8), 1015);
        bench.run_to(1s);
        EXPECT_TRUE(bench.shots.empty());
    }
    Bench bench = s500({{"invalid_settings", std::string("accept")}});
    bench.say(frame(S500Params{.length = -1, .gain = 99}));
    bench.run_to(bench.now);
    EXPECT_TRUE(bench.ping);
}

}  // namespace
}  // namespace echoloop::test
