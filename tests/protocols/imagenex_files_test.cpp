// .81A, .852 and .31L files: recordings of a real 852 byte for byte, and files made from the words of a line.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "protocols/imagenex/framer.h"
#include "protocols/imagenex/shot_writer.h"
#include "protocols/inspect.h"
#include "tests/protocols/data.h"

namespace echoloop::imagenex {
namespace {

wire::Bytes read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

int u16(const wire::Bytes& bytes, std::size_t at) { return bytes.at(at) << 8 | bytes.at(at + 1); }

std::string text(const wire::Bytes& bytes, std::size_t at, std::size_t size) {
    return std::string(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                       bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
}

struct Recording {
    const char* name;
    std::size_t shots;
    int range;
};
void PrintTo(const Recording& recording, std::ostream* out) { *out << recording.name; }

class Real852 : public ::testing::TestWithParam<Recording> {};

TEST_P(Real852, FileIsReadAndWrittenBackByteForByte) {
    ECHOLOOP_NEED_DATA(path, std::string("imagenex852/") + GetParam().name);
    const auto file = read_file(*path);
    Framer framer;
    wire::Bytes again;
    std::size_t shots = 0;
    for (std::size_t at = 0; at < file.size(); at += 4000) {
        framer.feed(wire::ByteView(file).subspan(at, std::min<std::size_t>(4000, file.size() - at)));
        while (const auto frame = framer.next()) {
            ++shots;
            auto shot = parse_shot(*frame);
            ASSERT_TRUE(shot) << shot.error().what();
            auto& in_file = std::get<Shot852>(*shot);
            const auto message = parse(in_file.reply);
            ASSERT_TRUE(message) << message.error().what();
            const auto& reply = std::get<Reply>(*message);
            EXPECT_EQ(reply.kind, Kind::igx);
            EXPECT_EQ(reply.range, GetParam().range);
            EXPECT_EQ(reply.status, 0x45);
            EXPECT_LE(*std::max_element(reply.data.begin(), reply.data.end()), 127);
            EXPECT_EQ(in_file.sound_speed, 0x8000 | 14600);
            in_file.reply = encode(*message);
            const auto bytes = encode(*shot);
            again.insert(again.end(), bytes.begin(), bytes.end());
        }
    }
    EXPECT_EQ(shots, GetParam().shots);
    EXPECT_TRUE(again == file) << "the file as a whole";
    EXPECT_EQ(framer.skipped_bytes(), 0U);
}

TEST_P(Real852, FileIsInspectedToItsLastByte) {
    ECHOLOOP_NEED_DATA(path, std::string("imagenex852/") + GetParam().name);
    const auto file = read_file(*path);
    EXPECT_EQ(inspect::guess_family(file)->name, "imagenex");
    const auto messages = inspect::find_family("imagenex")->decode(file);
    ASSERT_EQ(messages.size(), GetParam().shots);
    for (const auto& message : messages) {
        EXPECT_EQ(message.name, "Shot852");
        EXPECT_EQ(message.reason, "");
    }
}

INSTANTIATE_TEST_SUITE_P(Cidco, Real852,
                         ::testing::Values(Recording{"19_26_51-2016_11_18-sonar.852", 917, 10},
                                           Recording{"hydroball.852", 177, 50}),
                         [](const auto& recording) {
                             return "Range" + std::to_string(recording.param.range);
                         });

const SwitchCommand settings{.head_id = 0x11,
                             .range = 10,
                             .start_gain = 12,
                             .logf = 2,
                             .absorption = 20,
                             .train_angle = 60,
                             .sector_width = 120,
                             .step_size = 8,
                             .pulse_length = 100,
                             .data_bits = 8,
                             .frequency = 100};
constexpr double at_noon = 1479490150.17;  // 18 November 2016, 17:29:10.17 UTC

Reply reply_of(Kind kind, std::size_t data) {
    Reply reply{.kind = kind, .head_id = 0x11, .status = 0x45, .range = 10, .profile_range = Packed14(448)};
    reply.head_position = head_position(600, true);
    reply.data.assign(data, 7);
    return reply;
}

TEST(ShotWriter, WritesAnEightFiveTwoAsTheNotesLayItOut) {
    ShotWriter writer(ShotFormat::shot_852);
    writer.command(settings);
    const auto reply = reply_of(Kind::igx, 500);
    const auto shot = writer.shot(reply, at_noon);
    ASSERT_EQ(shot.size(), 640U);
    EXPECT_EQ(text(shot, 0, 3), "852");
    EXPECT_EQ(shot[3], 3);
    EXPECT_EQ(u16(shot, 4), 640);
    EXPECT_EQ(u16(shot, 6), 513);
    EXPECT_EQ(text(shot, 8, 12), std::string("18-Nov-2016\0", 12));
    EXPECT_EQ(text(shot, 20, 9), std::string("17:29:10\0", 9));
    EXPECT_EQ(text(shot, 29, 4), std::string(".17\0", 4));
    EXPECT_EQ(shot[38], 12);
    EXPECT_EQ(shot[42], 20);
    EXPECT_EQ(shot[43], 9);
    EXPECT_EQ(shot[44], 100);
    EXPECT_EQ(u16(shot, 46), 0x8000 | 15000);
    EXPECT_EQ(shot[88], 0x11);
    EXPECT_EQ(to_hex(wire::ByteView(shot).subspan(100, 513)), to_hex(encode(Message(reply))));
    EXPECT_TRUE(std::all_of(shot.begin() + 613, shot.end(), [](int byte) { return byte == 0; }));
    EXPECT_EQ(writer.shot(reply_of(Kind::imx, 252), at_noon).size(), 384U);
    EXPECT_EQ(writer.shot(reply_of(Kind::ipx, 0), at_noon).size(), 128U);
}

TEST(ShotWriter, AnEightyOneAPointsBackOverTheShotBefore) {
    ShotWriter writer(ShotFormat::shot_81a);
    writer.command(settings);
    const auto first = writer.shot(reply_of(Kind::imx, 128), at_noon);
    const auto second = writer.shot(reply_of(Kind::igx, 500), at_noon);
    ASSERT_EQ(first.size(), 256U);
    ASSERT_EQ(second.size(), 640U);
    EXPECT_EQ(text(first, 0, 3), "81A");
    EXPECT_EQ(first[3], 1);
    EXPECT_EQ(u16(first, 254), 256);
    EXPECT_EQ(u16(second, 638), 896);
    EXPECT_EQ(first[37], 0x80 | 1 << 3 | 4) << "clockwise, polar, 2.4 deg";
    EXPECT_EQ(first[39], 120);
    EXPECT_EQ(first[40], 60);
    EXPECT_EQ(first[43], 1 << 3 | 2) << "8 bits, LOGF 30";
    EXPECT_EQ(u16(first, 80), 675);
    EXPECT_EQ(u16(first, 91), 1800);
    for (const auto& shot : {first, second}) EXPECT_TRUE(parse_shot(shot));
}

TEST(ShotWriter, WritesAThirtyOneLAsARealOneWasRead) {
    ShotWriter writer(ShotFormat::shot_31l);
    SwitchCommand command = settings;
    command.range = 10, command.step_size = 3, command.train_angle = 120, command.pulse_length = 10;
    writer.command(command);
    PipeReply reply{.range_code = 10, .data = wire::Bytes(250, 7)};
    reply.data_bytes = Packed14(250);
    reply.head_position = head_position(912, true);
    const auto first = writer.shot(reply, at_noon), second = writer.shot(reply, at_noon + 0.1);
    ASSERT_EQ(first.size(), 512U);
    EXPECT_EQ(text(first, 0, 3), "31L");
    EXPECT_EQ(first[3], 2);
    EXPECT_EQ(u16(first, 4), 512);
    EXPECT_EQ(u16(first, 6), 283);
    EXPECT_EQ(text(first, 8, 12), std::string("18-Nov-2016\0", 12));
    EXPECT_EQ(first[37], 0xCA) << "clockwise, transducer up, polar, 0.9 deg";
    EXPECT_EQ(first[38], 12);
    EXPECT_EQ(first[39], 120);
    EXPECT_EQ(first[40], 120);
    EXPECT_EQ(first[41], 10);
    EXPECT_EQ(first[42], 20);
    EXPECT_EQ(first[44], 10);
    EXPECT_EQ(u16(first, 46), 0x8000 | 15000);
    EXPECT_EQ(u16(first, 80), 2250);
    EXPECT_EQ(u16(first, 82), 0) << "no rate is known of the first";
    EXPECT_EQ(u16(second, 82), 1000) << "10 Hz";
    EXPECT_EQ(to_hex(wire::ByteView(first).subspan(228, 283)), to_hex(encode(Message(reply))));
    EXPECT_EQ(first[511], 0);
    EXPECT_TRUE(parse_shot(first));
    for (std::size_t size = 0; size < first.size(); ++size)
        EXPECT_FALSE(parse_shot(wire::ByteView(first).first(size))) << size;
    for (const auto& [at, value] : {std::pair{3, 3}, {4, 1}, {6, 0}, {7, 0x21}}) {
        auto bad = first;
        bad[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(value);
        EXPECT_FALSE(parse_shot(bad)) << at << ": " << value;
    }
}

TEST(ShotFiles, EveryTruncationAndLieIsRefused) {
    ShotWriter writer(ShotFormat::shot_81a);
    const auto good = writer.shot(reply_of(Kind::igx, 500), 0);
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_FALSE(parse_shot(wire::ByteView(good).first(size))) << size;
    for (const auto& [at, value] : {std::pair{3, 4}, {3, 2}, {4, 0xFF}, {5, 0}, {6, 0x7F}, {34, 1}}) {
        auto bad = good;
        bad[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(value);
        EXPECT_FALSE(parse_shot(bad)) << at << ": " << value;
    }
    auto longer = good;
    longer[34] = 1;
    longer.resize(good.size() + 128);
    EXPECT_TRUE(parse_shot(longer)) << "128 extended bytes that the total leaves out";
    longer[4] = 0x03;  // 768
    longer[5] = 0x00;
    EXPECT_TRUE(parse_shot(longer)) << "and that it counts";
}

}  // namespace
}  // namespace echoloop::imagenex
