// What the SeaNet notes leave open: each option does what it says, seen in literal bytes and times.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/emulator/devices/micron_bench.h"

namespace echoloop::test {
namespace {

using testing::ElementsAre;

Options with(const std::string& name, OptionValue value) { return {{name, std::move(value)}}; }
OptionValue word(const std::string& value) { return value; }

/// Bearings of the first `count` lines, one request after the other.
std::vector<int> bearings_of(Bench& bench, std::size_t count) {
    std::vector<int> found;
    while (found.size() < count) {
        bench.say(send_data);
        bench.run_to(bench.now + 900ms);
        for (int b : bearings(bench.sent())) found.push_back(b);
    }
    found.resize(count);
    return found;
}

/// HeadInf of the alives of the first `seconds` s.
std::vector<int> head_infs(Bench& bench, int seconds) {
    bench.run_to(std::chrono::seconds(seconds));
    std::vector<int> found;
    for (const Alive& alive : alives(bench.sent())) found.push_back(alive.head_inf);
    return found;
}

/// Seconds from the request to the reply, when the line is free.
double seconds_to_reply(const std::string& command, const Options& changes) {
    Bench bench = scanning(command, changes);
    bench.say(send_data);
    return to_seconds(bench.ping->due - bench.now);
}

TEST(SeanetOptions, StartOfTheAlives) {
    Bench quick = powered_up(with("first_alive", 0.25));
    quick.run_to(249ms);
    EXPECT_TRUE(quick.sent().empty());
    quick.run_to(250ms);
    EXPECT_EQ(quick.sent().size(), 1u);
    Bench none = powered_up(with("recentring_alives", std::int64_t{0}));
    EXPECT_THAT(head_infs(none, 2), ElementsAre(0x4A, 0x4A));
    Bench five = powered_up(with("recentring_alives", std::int64_t{5}));
    EXPECT_THAT(head_infs(five, 6), ElementsAre(0x5D, 0x4D, 0x4D, 0x4D, 0x4D, 0x4A));
}

TEST(SeanetOptions, HomingSequenceIsAList) {
    Bench bench = powered_up({{"homing", word("4D, 5D 4c")}, {"recentring_alives", std::int64_t{4}}});
    EXPECT_THAT(head_infs(bench, 5), ElementsAre(0x4D, 0x5D, 0x4C, 0x4C, 0x4A));
    EXPECT_THROW(powered_up(with("homing", word("5D, 4"))), std::invalid_argument);
    EXPECT_THROW(powered_up(with("homing", word("/no/such/file"))), std::invalid_argument);
}

TEST(SeanetOptions, SentCfgFollowsTheMessageThatIsChosen) {
    const auto bit_after = [](const std::string& option, const std::string& command) {
        Bench bench = powered_up(with("sent_cfg_by", word(option)));
        bench.run_to(4s);
        bench.say(command);
        bench.sent();
        bench.run_to(6s);
        return alives(bench.sent()).back().head_inf & 0x80;
    };
    EXPECT_EQ(bit_after("both", clockwise), 0x80);
    EXPECT_EQ(bit_after("both", send_bb_user), 0x80);
    EXPECT_EQ(bit_after("head-command", clockwise), 0x80);
    EXPECT_EQ(bit_after("head-command", send_bb_user), 0);
    EXPECT_EQ(bit_after("bb-user", clockwise), 0);
    EXPECT_EQ(bit_after("bb-user", send_bb_user), 0x80);
}

TEST(SeanetOptions, AlivesGoOnWhileScanning) {
    Bench bench = scanning(clockwise, with("alives_while_scanning", true));
    for (int i = 0; i < 20; ++i) {
        bench.say(send_data);
        bench.run_to(bench.now + 150ms);
    }
    EXPECT_EQ(alives(bench.sent()).size(), 3u);
}

TEST(SeanetOptions, ParametersAreRefusedWhileCentring) {
    Bench bench = powered_up(with("refuse_while_centring", true));
    bench.run_to(1500ms);
    bench.sent();
    bench.say(clockwise);
    EXPECT_TRUE(bench.sent().empty());
    EXPECT_EQ(bench.device().counters().rejected, 1u);
    bench.run_to(4s);
    bench.sent();
    bench.say(clockwise);
    bench.run_to(4300ms);
    EXPECT_THAT(alives(bench.sent()), ElementsAre(Alive{0x80, 0xCA}));
}

TEST(SeanetOptions, CommandsWithAWrongLengthAreDroppedOrTakenById) {
    const std::string reboot_of_000c = "40303030430c00ff02031080020a";  // 14 bytes that claim 18
    Bench dropping = scanning(clockwise);
    dropping.run_to(dropping.now + 500ms);
    dropping.sent();
    dropping.say(reboot_of_000c);
    dropping.run_to(dropping.now + 1100ms);
    EXPECT_THAT(alives(dropping.sent()), ElementsAre(Alive{0x00, 0x8A}));
    Bench by_id = scanning(clockwise, with("short_commands", word("by-id")));
    by_id.say(reboot_of_000c);
    by_id.run_to(by_id.now + 1100ms);
    EXPECT_THAT(alives(by_id.sent()), ElementsAre(Alive{0x80, 0x5D}));
}

TEST(SeanetOptions, ASleepingMotorDelaysTheFirstLineOnly) {
    Bench bench = scanning(clockwise, {{"motor_off_after", 5.0}, {"motor_start", 0.8}});
    bench.run_to(bench.now + 3500ms);
    EXPECT_EQ(alives(bench.sent()).back().head_inf, 0x8A);
    bench.run_to(bench.now + 4s);
    EXPECT_EQ(alives(bench.sent()).back().head_inf, 0x82) << "MotorOn is gone";
    const Time asked = bench.now;
    bench.say(send_data);
    bench.say(send_data);
    EXPECT_FALSE(bench.ping);
    bench.run_to(asked + 799ms);
    EXPECT_FALSE(bench.ping);
    bench.run_to(asked + 800ms);
    EXPECT_TRUE(bench.ping);
    bench.run_to(bench.now + 900ms);
    bench.say(send_data);
    EXPECT_TRUE(bench.ping) << "awake again";
    EXPECT_EQ(lines(bench.sent()).size(), 2u) << "both early requests are one";
}

TEST(SeanetOptions, VersionNumbersAreThoseOfTheOptions) {
    Bench bench = powered_up({{"software_version", std::int64_t{3}},
                              {"serial_number", std::int64_t{0x0201}},
                              {"program_length", std::int64_t{0x01020304}},
                              {"program_checksum", std::int64_t{0x0605}},
                              {"node", std::int64_t{2}}});
    bench.say(send_version);
    EXPECT_EQ(to_hex(bench.sent().at(0).bytes),
              "40303031331300"
              "02ff0e0180020301010204030201050602"
              "0a");
}

TEST(SeanetOptions, UserBlockComesInBothFormsAndWithGivenContent) {
    Bench older = powered_up(with("user_block_form", word("175")));
    older.say(send_bb_user);
    EXPECT_EQ(older.sent().at(0).bytes.size(), 175u);
    Bench half = powered_up(with("half_duplex", true));
    half.say(send_bb_user);
    EXPECT_EQ(half.sent().at(0).bytes[146], 1);
    Bench given = powered_up({{"user_block", word("ff00 3412 4000 0f06")},
                              {"fpga_cal_data", word("0102")},
                              {"fpga_version_data", word("0a0b0c")}});
    given.say(send_bb_user);
    const auto sent = given.sent();
    EXPECT_EQ(to_hex(ByteView(sent.at(0).bytes).subspan(13, 8)),
              "ff003412"
              "40000f06");
    EXPECT_EQ(to_hex(ByteView(sent.at(1).bytes).subspan(13, 3)), "010200");
    EXPECT_EQ(to_hex(ByteView(sent.at(2).bytes).subspan(13, 4)), "0a0b0c00");
    EXPECT_THROW(powered_up(with("fpga_version_data", word(std::string(30, '0')))), std::invalid_argument)
        << "15 bytes where 14 fit";
}

TEST(SeanetOptions, ContentMayStandInAFile) {
    const auto path = std::filesystem::temp_directory_path() / "echoloop_fpga_test.hex";
    std::ofstream(path) << "# calibration\n01 02 # two bytes\n03\n";
    Bench bench = powered_up(with("fpga_cal_data", word(path.string())));
    std::filesystem::remove(path);
    bench.say(send_bb_user);
    EXPECT_EQ(to_hex(ByteView(bench.sent().at(1).bytes).subspan(13, 4)), "01020300");
}

TEST(SeanetOptions, HalfDuplexAnswersWithOneLine) {
    Bench bench = scanning(clockwise, with("half_duplex", true));
    bench.say(send_data);
    bench.run_to(bench.now + 900ms);
    EXPECT_EQ(lines(bench.sent()).size(), 1u);
    Bench one = scanning(clockwise, with("replies", std::int64_t{1}));
    one.say(send_data);
    one.run_to(one.now + 900ms);
    EXPECT_EQ(lines(one.sent()).size(), 1u);
}

TEST(SeanetOptions, RotationMayBeForcedRight) {
    Bench obeying = scanning(continuous);
    EXPECT_THAT(bearings_of(obeying, 3), ElementsAre(3200, 3169, 3138));
    Bench forced = scanning(continuous, with("force_right", true));
    EXPECT_THAT(bearings_of(forced, 3), ElementsAre(3200, 3231, 3262));
}

TEST(SeanetOptions, LimitsTwiceWholeStepsAndSectorStart) {
    const std::string narrow = changed(changed(sector, 37, "5f09"), 39, "9f09");  // 2399 to 2463 by 31
    Bench once = scanning(narrow);
    EXPECT_THAT(bearings_of(once, 7), ElementsAre(2399, 2430, 2461, 2463, 2432, 2401, 2399));
    Bench twice = scanning(narrow, with("limits_twice", true));
    EXPECT_THAT(bearings_of(twice, 9), ElementsAre(2399, 2430, 2461, 2463, 2463, 2432, 2401, 2399, 2399));
    Bench whole = scanning(narrow, with("whole_steps", true));
    EXPECT_THAT(bearings_of(whole, 6), ElementsAre(2399, 2430, 2461, 2430, 2399, 2430));
    Bench here = scanning(sector, with("sector_start", word("position")));
    EXPECT_THAT(bearings_of(here, 2), ElementsAre(3200, 3231));
}

TEST(SeanetOptions, StareAndInvert) {
    Bench stare = scanning(changed(sector, 15, "33"));
    EXPECT_THAT(bearings_of(stare, 3), ElementsAre(2399, 2399, 2399));
    const std::string inverted = changed(continuous, 14, "8b");
    Bench obeying = scanning(inverted);
    bearings_of(obeying, 2);
    EXPECT_NEAR(obeying.shots[1].pan, 31 * deg_to_rad(0.05625), 1e-9);
    Bench deaf = scanning(inverted, with("obey_invert", false));
    bearings_of(deaf, 2);
    EXPECT_NEAR(deaf.shots[1].pan, -31 * deg_to_rad(0.05625), 1e-9);
}

TEST(SeanetOptions, PeriodLaws) {
    // window 13.312 ms, motor 7.75 ms, line 245 bytes = 21.267 ms
    EXPECT_NEAR(seconds_to_reply(continuous, {}), 0.021062, 1e-6);
    EXPECT_NEAR(seconds_to_reply(continuous, with("period_scale", 2.0)), 0.042124, 1e-6);
    EXPECT_NEAR(seconds_to_reply(continuous, with("period_law", word("B"))), 0.042124 - 0.021267, 1e-6);
    EXPECT_NEAR(seconds_to_reply(continuous, {{"period_law", word("fixed")}, {"fixed_period", 0.5}}),
                0.5 - 0.021267, 1e-6);
    EXPECT_NEAR(seconds_to_reply(continuous, {{"period_law", word("fixed")}, {"fixed_period", 0.001}}),
                0.013312, 1e-6)
        << "never before the echoes are in";
}

TEST(SeanetOptions, BytesOfTheReply) {
    const auto reply = [](const Options& changes, const std::string& command = continuous) {
        Bench bench = scanning(command, changes);
        bench.echo_bin = 120;
        bench.echo_power = 3.65e11F;  // 24.8 dB of 80 with the gain of 40 %
        bench.say(send_data);
        bench.hear();
        return lines(bench.sent()).at(0);
    };
    EXPECT_EQ(reply(with("device_type", std::int64_t{0x0B}))[15], 0x0B);
    EXPECT_EQ(reply(with("device_type", std::int64_t{-1}))[15], 2) << "HdType of the command";
    EXPECT_EQ(reply({})[9], 0);
    EXPECT_EQ(reply(with("head_data_byte9", word("low-byte")))[9], 245 - 6 - 5);
    EXPECT_EQ(u16(reply({{"hd_ctrl_set", std::int64_t{0x14}}, {"hd_ctrl_clear", std::int64_t{0x80}}}), 18),
              0x2317);
    // ADSpan 81, ADLow 8: 78 counts are (78 - 8) * 15 / 81 = 12; on the other scale 81 * 17 and 8 * 17: 0
    EXPECT_EQ(reply({}, four_bit)[44 + 60], 0xC0);
    EXPECT_EQ(reply(with("nibble_order", word("low-first")), four_bit)[44 + 60], 0x0C);
    EXPECT_EQ(reply(with("ad_span_scale", word("15")), four_bit)[44 + 60], 0x00);
    const std::string of_15 = changed(changed(four_bit, 41, "0f"), 42, "00");  // span 15, low 0: 78 / 17
    EXPECT_EQ(reply(with("ad_span_scale", word("15")), of_15)[44 + 60], 0x40);
    EXPECT_EQ(reply({}, changed(four_bit, 41, "00"))[44 + 60], 0xF0) << "ADSpan 0 does not divide by zero";
}

TEST(SeanetOptions, V3bOrTheMainFieldsCount) {
    const std::string filled = changed(continuous, 65,
                                       "50510908"
                                       "5a5b");
    const auto values = [&](const Options& changes) {
        Bench bench = scanning(filled, changes);
        bench.say(send_data);
        bench.hear();
        const Bytes line = lines(bench.sent()).at(0);
        return std::vector<int>{line[29], line[30], line[26]};
    };
    EXPECT_THAT(values({}), ElementsAre(0x51, 0x08, 0x54));
    EXPECT_THAT(values(with("v3b", word("v3b"))), ElementsAre(0x50, 0x09, 0x5A));
}

TEST(SeanetOptions, MotorErrorLastsUntilNewParameters) {
    Bench bench = scanning(clockwise, with("motor_error_after", std::int64_t{3}));
    const auto statuses = [&](int requests) {
        std::vector<int> found;
        for (int i = 0; i < requests; ++i) {
            bench.say(send_data);
            bench.run_to(bench.now + 900ms);
        }
        for (const Bytes& line : lines(bench.sent())) found.push_back(line[16]);
        return found;
    };
    EXPECT_THAT(statuses(3), ElementsAre(0x10, 0x10, 0x10, 0x12, 0x12, 0x12));
    bench.say(clockwise);
    EXPECT_THAT(statuses(1), ElementsAre(0x10, 0x10));
    Bench losing = scanning(clockwise, with("power_loss_every", std::int64_t{2}));
    losing.say(send_data);
    losing.say(send_data);
    losing.run_to(losing.now + 2s);
    const auto found = lines(losing.sent());
    ASSERT_EQ(found.size(), 4u);
    EXPECT_EQ(found[0][16], 0x10);
    EXPECT_EQ(found[1][16], 0x11);
    EXPECT_EQ(found[3][16], 0x11);
}

TEST(SeanetOptions, AnyHdTypeIsAccepted) {
    for (const char* type : {"02", "03", "0b", "11", "ff"}) {
        Bench bench = scanning(changed(clockwise, 16, type));
        bench.say(send_data);
        EXPECT_TRUE(bench.ping) << type;
    }
}

TEST(SeanetOptions, NodeIsTheHeadsOwn) {
    Bench bench = powered_up(with("node", std::int64_t{7}));
    bench.say(send_version);
    EXPECT_TRUE(bench.sent().empty());
    bench.say(changed(changed(send_version, 8, "07"), 12, "07"));
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_EQ(sent[0].bytes[7], 7);
    EXPECT_EQ(sent[0].bytes[12], 7);
}

}  // namespace
}  // namespace echoloop::test
