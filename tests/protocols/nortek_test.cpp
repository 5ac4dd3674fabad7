// Nortek's frames: sums, truncations, and a stream of everything in pieces. The golden bytes of
// tests/data/nortek are read by golden_test.cpp.
#include <gtest/gtest.h>

#include "protocols/nortek/codec.h"
#include "protocols/nortek/inspect.h"
#include "protocols/nortek/sentences.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::nortek {
namespace {

wire::Bytes golden(const std::string& name) {
    for (const auto& path : hex_files("nortek"))
        if (path.stem() == name) return read_hex_file(path).bytes;
    return {};
}

TEST(NortekFrame, HasTheValuesThatTheMakersDriverReads) {
    const auto frame = parse(golden("bottom_track"));
    ASSERT_TRUE(frame);
    const auto& track = std::get<Track>(frame->data);
    EXPECT_FLOAT_EQ(track.velocity[0], 0.12F);
    EXPECT_FLOAT_EQ(track.velocity[1], -0.04F);
    EXPECT_FLOAT_EQ(track.velocity[2], 0.015F);
    EXPECT_FLOAT_EQ(track.distance[1], 5.4F);
    EXPECT_FLOAT_EQ(std::get<Altimeter>(parse(golden("altimeter"))->data).distance, 5.34F);
}

TEST(NortekFrame, IsRefusedWhenCutOrDamaged) {
    for (const char* name :
         {"bottom_track", "altimeter", "ahrs", "other", "dvl_bottom_track", "dvl_water_track"}) {
        const wire::Bytes bytes = golden(name);
        ASSERT_TRUE(parse(bytes)) << name;
        for (std::size_t size = 0; size < bytes.size(); ++size)
            EXPECT_FALSE(parse(wire::ByteView(bytes).first(size))) << size;
        for (std::size_t at = 0; at < bytes.size(); ++at) {
            wire::Bytes damaged = bytes;
            ++damaged[at];
            EXPECT_FALSE(parse(damaged)) << name << ' ' << at;
        }
    }
}

TEST(NortekFrame, OfAnotherVersionIsKeptAsItIs) {
    auto frame = *parse(golden("ahrs"));
    std::get<Ahrs>(frame.data).version = 1;
    const auto again = parse(encode(frame));
    ASSERT_TRUE(again);
    EXPECT_EQ(std::get<Other>(again->data).values.size(), 108U);
}

TEST(NortekFrame, OfADvlHasItsOwnTable) {
    const auto frame = parse(golden("dvl_bottom_track"));
    ASSERT_TRUE(frame);
    const auto& track = std::get<DvlTrack>(frame->data);
    EXPECT_FLOAT_EQ(track.velocity[0], 0.5F);
    EXPECT_FLOAT_EQ(track.velocity[1], 0.2F);
    EXPECT_FLOAT_EQ(track.velocity[3], 0.1F);
    EXPECT_FLOAT_EQ(track.distance[3], 5.0F);
    EXPECT_FLOAT_EQ(track.beam_from_output[0], -0.0515F);
    // 2026-11-27 12:30:15.25
    EXPECT_DOUBLE_EQ(unix_time(track), 1795782615.25);
    // The start of a published frame without a bottom, header included but for the sum of its data.
    wire::Bytes bytes = golden("dvl_no_bottom");
    const wire::Bytes published{0xA5, 0x0A, 0x1B, 0x10, 0xD4, 0x00, 0x0C, 0x0D, 0x2C, 0xDE};
    EXPECT_EQ(checksum(wire::ByteView(published).first(8)), 0xDE2C);
    EXPECT_TRUE(std::equal(published.begin(), published.begin() + 6, bytes.begin()));
    auto other = *frame;
    other.family = nucleus_family;
    const auto unknown = parse(encode(other));
    ASSERT_TRUE(unknown);
    EXPECT_TRUE(std::holds_alternative<Other>(unknown->data)) << "a Nucleus has no such table";
}

TEST(NortekLines, AreThePublishedOnes) {
    DvlTrack track;
    track.year = 116, track.month = 0, track.day = 8, track.hour = 9, track.minute = 8, track.second = 36;
    track.fraction = 7508;
    track.from_trigger.fill(0.001234F), track.from_output.fill(-0.001234F);
    track.velocity.fill(0.1234F), track.merit.fill(12.34F), track.distance.fill(23.45F);
    track.sound_speed = 1567.8F, track.pressure = 1.2F, track.temperature = 12.3F, track.status = 0x000FFFFF;
    const auto said = [&](int format) {
        const auto lines = track_lines(track, line_address(format), 23.4);
        return lines.size() == 1 ? lines[0] : "";
    };
    // The maker's examples, as pynmea2 has them, but for the decimals of the merit, of which published lines
    // have five.
    const auto with_sum = [](const std::string& body) {
        unsigned sum = 0;
        for (const char c : body) sum ^= static_cast<unsigned char>(c);
        char end[8];
        std::snprintf(end, sizeof end, "*%02X\r\n", sum);
        return '$' + body + end;
    };
    const std::string values =
        ",1452244116.7508,1.234,-1.234,0.1234,0.1234,0.1234,12.34000,23.45,23.45,23.45,23.45";
    EXPECT_EQ(said(357), with_sum("PNORBT7" + values));
    EXPECT_EQ(said(359), with_sum("PNORBT9" + values + ",23.4,1567.8,1.2,12.3,0x000FFFFF"));
    EXPECT_EQ(said(407), with_sum("PNORWT7" + values));
    EXPECT_TRUE(said(356).starts_with("$PNORBT6,TIME=1452244116.7508,DT1=1.234,DT2=-1.234,VX=0.1234,"));
    EXPECT_EQ(said(21), "") << "no lines";
    track = {};
    track.year = 119, track.month = 10, track.day = 5, track.hour = 15, track.minute = 58, track.second = 12,
    track.fraction = 9;
    track.from_trigger.fill(0.021516F), track.from_output.fill(-0.134398F);
    track.velocity.fill(no_velocity), track.merit.fill(no_merit);
    const wire::Bytes published = golden("line_of_velocity");
    EXPECT_EQ(said(357), std::string(published.begin(), published.end())) << "of a DVL1000 without a bottom";
    EXPECT_EQ(track_lines(track, "PNORBT0", 0).size(), 4U) << "one for each beam";
}

TEST(NortekLines, AreCheckedFieldByField) {
    const auto reason = [](const std::string& line) {
        const auto messages = decode(wire::Bytes(line.begin(), line.end()));
        return messages.size() == 1 ? messages[0].reason : "several";
    };
    EXPECT_EQ(reason("$PNORBT4,1.234,-1.234,1.234,23.4,12.34567,12.3*3D\r\n"), "");
    EXPECT_NE(reason("$PNORBT4,1.234,-1.234,1.234,23.4,12.34567,12.3*3E\r\n").find("checksum"),
              std::string::npos);
    EXPECT_NE(reason("$PNORBT4,1.234,-1.234,1.234,23.4,12.34567*5A\r\n"), "");
    EXPECT_NE(reason("$PNORBT4,1.234,-1.234,1.234,23.4,12.34567,12.3,1*10\r\n"), "");
    EXPECT_NE(reason("$PNORBT4,1.234,-1.234,x,23.4,12.34567,12.3*70\r\n"), "");
    EXPECT_EQ(reason("$PNOR,OK*2B\r\n"), "") << "another line";
}

TEST(NortekFramer, FindsEverythingWhateverThePieces) {
    const wire::Bytes track = golden("bottom_track"), other = golden("other");
    wire::Bytes damaged = track;
    ++damaged[60];
    const std::string line = "$PNOR,OK*2B\r\n";
    const wire::Bytes stream = joined(
        {{0xA5, 0xA5, 0x0A, 0x00}, track, wire::Bytes(line.begin(), line.end()), damaged, other, track});
    for (std::size_t size = 1; size <= stream.size(); size += size < 20 ? 1 : 37) {
        std::vector<wire::Bytes> frames;
        std::string first;
        feed_in_pieces(Framer(), stream, size, [&](const Piece& piece) {
            if (piece.kind == Piece::Kind::frame)
                frames.push_back(piece.bytes);
            else if (first.empty())
                first.assign(piece.bytes.begin(), piece.bytes.end());
        });
        EXPECT_EQ(frames, (std::vector<wire::Bytes>{track, other, track})) << size;
        EXPECT_EQ(first, "$PNOR,OK*2B") << size;
    }
}

TEST(NortekInspect, CoversEveryByte) {
    wire::Bytes stream = golden("altimeter");
    stream.insert(stream.begin(), {0x00, 0xA5, 0x0A, 0x01});
    stream.push_back('?');
    expect_all_covered(decode(stream), stream.size());
    EXPECT_FALSE(recognise(wire::Bytes{'O', 'K', '\r', '\n'})) << "a line is anybody's";
}

}  // namespace
}  // namespace echoloop::nortek
