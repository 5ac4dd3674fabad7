// PD0 ensembles and PD5 blocks: round trips, truncations, offsets that lie, and a stream of everything in
// pieces. The golden bytes of tests/data/teledyne are read by golden_test.cpp.
#include <gtest/gtest.h>

#include "protocols/teledyne/codec.h"
#include "protocols/teledyne/inspect.h"
#include "protocols/waterlinked/pd4.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::teledyne {
namespace {

wire::Bytes golden(const std::string& name) {
    for (const auto& path : hex_files("teledyne"))
        if (path.stem() == name) return read_hex_file(path).bytes;
    return {};
}

void seal(wire::Bytes& bytes) {
    const std::uint16_t checksum = sum(wire::ByteView(bytes).first(bytes.size() - 2));
    bytes[bytes.size() - 2] = static_cast<std::uint8_t>(checksum);
    bytes[bytes.size() - 1] = static_cast<std::uint8_t>(checksum >> 8);
}

TEST(TeledyneEnsemble, IsRefusedWhenCutOrDamaged) {
    for (const char* name : {"pathfinder", "profile"}) {
        const wire::Bytes bytes = golden(name);
        ASSERT_TRUE(parse_ensemble(bytes));
        for (std::size_t size = 0; size < bytes.size(); ++size)
            EXPECT_FALSE(parse_ensemble(wire::ByteView(bytes).first(size))) << size;
        for (std::size_t at = 0; at < bytes.size(); ++at) {
            wire::Bytes damaged = bytes;
            ++damaged[at];
            EXPECT_FALSE(parse_ensemble(damaged)) << at;
        }
    }
}

TEST(TeledyneEnsemble, OffsetsThatLieAreRefusedThoughTheSumFits) {
    // The first one, one that goes back, one behind the end, none at all.
    for (const auto& [at, low, high] :
         {std::tuple{6U, 0x0D, 0}, {8U, 0x0C, 0}, {10U, 0xE3, 0}, {10U, 0, 0xFF}}) {
        wire::Bytes bytes = golden("pathfinder");
        bytes[at] = static_cast<std::uint8_t>(low);
        bytes[at + 1] = static_cast<std::uint8_t>(high);
        seal(bytes);
        EXPECT_FALSE(parse_ensemble(bytes)) << at;
    }
    wire::Bytes none = golden("pathfinder");
    none[5] = 0;
    seal(none);
    EXPECT_FALSE(parse_ensemble(none));
    // A leader that is shorter than its table.
    wire::Bytes brief = golden("pathfinder");
    brief[8] = 0x20;
    seal(brief);
    EXPECT_FALSE(parse_ensemble(brief));
}

TEST(TeledyneEnsemble, UnknownSectionsAreKept) {
    const auto ensemble = parse_ensemble(golden("profile"));
    ASSERT_TRUE(ensemble);
    ASSERT_EQ(ensemble->sections.size(), 8U);
    EXPECT_EQ(std::get<Other>(ensemble->sections[7]).id, 0x5803);
    EXPECT_EQ(std::get<Velocity>(ensemble->sections[2]).cells.at(0).velocity[1], 40);
    EXPECT_EQ(encode(*ensemble), golden("profile"));
}

TEST(TeledynePd5, IsRefusedWithAWrongSumOrCut) {
    wire::Bytes block = golden("pd5");
    ASSERT_TRUE(parse_pd5(block));
    EXPECT_EQ(encode(*parse_pd5(block)), block);
    for (std::size_t size = 0; size < block.size(); ++size)
        EXPECT_FALSE(parse_pd5(wire::ByteView(block).first(size))) << size;
    ++block[10];
    EXPECT_FALSE(parse_pd5(block));
}

TEST(TeledyneFramer, FindsEverythingWhateverThePieces) {
    const wire::Bytes ensemble = golden("pathfinder"), block = golden("pd5"),
                      pd4 = waterlinked::encode(waterlinked::Pd4{.velocity = {1, 2, 3, 4}});
    wire::Bytes damaged = ensemble;
    ++damaged[100];
    wire::Bytes stream{0xFF, 0x00, 0x7F};
    const std::string line = "EX11111\r\n>";
    for (const wire::Bytes& part :
         {wire::Bytes(line.begin(), line.end()), ensemble, damaged, block, pd4, ensemble})
        stream.insert(stream.end(), part.begin(), part.end());
    for (std::size_t size = 1; size <= stream.size(); size += size < 20 ? 1 : 37) {
        std::vector<wire::Bytes> blocks;
        std::string lines;
        feed_in_pieces(Framer(), stream, size, [&](const Piece& piece) {
            if (piece.kind != Piece::Kind::line)
                blocks.push_back(piece.bytes);
            else if (blocks.empty())
                lines += std::string(piece.bytes.begin(), piece.bytes.end()) + '|';
        });
        EXPECT_EQ(blocks, (std::vector<wire::Bytes>{ensemble, block, pd4, ensemble})) << size;
        EXPECT_EQ(lines, "EX11111|>|") << size;
    }
}

TEST(TeledyneInspect, CoversEveryByte) {
    wire::Bytes stream = golden("profile");
    stream.insert(stream.begin(), {0x00, 0x7F, 0x7F, 0x01});
    stream.push_back('?');
    expect_all_covered(decode(stream), stream.size());
    EXPECT_FALSE(recognise(wire::Bytes{'E', 'X', '\r', '\n'})) << "a line is anybody's";
}

}  // namespace
}  // namespace echoloop::teledyne
