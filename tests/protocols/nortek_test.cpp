// Nortek's frames: sums, truncations, and a stream of everything in pieces. The golden bytes of
// tests/data/nortek are read by golden_test.cpp.
#include <gtest/gtest.h>

#include "protocols/nortek/codec.h"
#include "protocols/nortek/inspect.h"
#include "tests/protocols/data.h"

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
    for (const char* name : {"bottom_track", "altimeter", "ahrs", "other"}) {
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

TEST(NortekFramer, FindsEverythingWhateverThePieces) {
    const wire::Bytes track = golden("bottom_track"), other = golden("other");
    wire::Bytes damaged = track;
    ++damaged[60];
    const std::string line = "$PNOR,OK*2B\r\n";
    wire::Bytes stream{0xA5, 0xA5, 0x0A, 0x00};
    for (const wire::Bytes& part : {track, wire::Bytes(line.begin(), line.end()), damaged, other, track})
        stream.insert(stream.end(), part.begin(), part.end());
    for (std::size_t size = 1; size <= stream.size(); size += size < 20 ? 1 : 37) {
        Framer framer;
        std::vector<wire::Bytes> frames;
        std::string first;
        const auto take = [&] {
            while (const auto piece = framer.next())
                if (piece->kind == Piece::Kind::frame)
                    frames.push_back(piece->bytes);
                else if (first.empty())
                    first.assign(piece->bytes.begin(), piece->bytes.end());
        };
        for (std::size_t at = 0; at < stream.size(); at += size) {
            framer.feed(wire::ByteView(stream).subspan(at, std::min(size, stream.size() - at)));
            take();
        }
        framer.finish();
        take();
        EXPECT_EQ(frames, (std::vector<wire::Bytes>{track, other, track})) << size;
        EXPECT_EQ(first, "$PNOR,OK*2B") << size;
    }
}

TEST(NortekInspect, CoversEveryByte) {
    wire::Bytes stream = golden("altimeter");
    stream.insert(stream.begin(), {0x00, 0xA5, 0x0A, 0x01});
    stream.push_back('?');
    std::size_t covered = 0;
    for (const auto& message : decode(stream)) {
        EXPECT_EQ(message.offset, covered);
        covered += message.size;
    }
    EXPECT_EQ(covered, stream.size());
    EXPECT_FALSE(recognise(wire::Bytes{'O', 'K', '\r', '\n'})) << "a line is anybody's";
}

}  // namespace
}  // namespace echoloop::nortek
