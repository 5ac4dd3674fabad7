// R2Sonic's big data packets: several snippets in a datagram, sections that nobody knows, and sizes as the
// specification gives them.
#include <gtest/gtest.h>

#include "protocols/r2sonic/codec.h"
#include "tests/protocols/data.h"

namespace echoloop::r2sonic {
namespace {

wire::Bytes golden(const std::string& name) {
    for (const auto& path : hex_files("r2sonic"))
        if (path.filename() == name + ".hex") return read_hex_file(path).bytes;
    throw std::runtime_error("no " + name);
}

void put_size(wire::Bytes& bytes, std::size_t size) {
    for (int i = 0; i < 4; ++i) bytes.at(4 + i) = static_cast<std::uint8_t>(size >> (24 - 8 * i));
}

/// The datagram with more bytes at `at`, and the size that follows.
wire::Bytes with(wire::Bytes bytes, std::size_t at, const wire::Bytes& more) {
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), more.begin(), more.end());
    put_size(bytes, bytes.size());
    return bytes;
}

const wire::Bytes unknown_section{'X', '9', 0, 8, 1, 2, 3, 4};

TEST(R2SonicSections, UnknownOnesAreSkippedWhereverTheyStand) {
    for (const char* name : {"bth0_equi_angle", "bth0_equi_distant", "aid0_head", "aid0_data", "wcd0_head",
                             "wcd0_magnitude", "sni0_first", "tpx0_first"}) {
        const wire::Bytes plain = golden(name);
        const auto expected = parse(plain);
        ASSERT_TRUE(expected) << name;
        const auto behind = parse(with(plain, plain.size(), unknown_section));
        ASSERT_TRUE(behind) << name << ": " << behind.error().what();
        EXPECT_EQ(*behind, *expected) << name;
        EXPECT_EQ(to_hex(serialise(*behind)), to_hex(plain));
        if (plain.at(12) != 'H') continue;
        const auto between = parse(with(plain, 12 + (plain.at(15) == 140 ? 140 : 116), unknown_section));
        ASSERT_TRUE(between) << name;
        EXPECT_EQ(*between, *expected) << name;
    }
}

TEST(R2SonicSections, SensorsAreReadInEitherCase) {
    const wire::Bytes plain = golden("sth0");
    wire::Bytes capitals = plain;
    ASSERT_EQ(capitals.at(15), 'a');  // of SENa
    capitals[15] = 'A';
    const auto expected = parse(plain), packet = parse(capitals);
    ASSERT_TRUE(expected && packet);
    EXPECT_EQ(*packet, *expected);
}

TEST(R2SonicSections, AnotherOrderIsTheSamePacket) {
    const wire::Bytes plain = golden("bth0_equi_angle");  // H0 116, R0 16, A0 36, G0 16, Q0 8
    wire::Bytes turned(plain.begin(), plain.begin() + 12);
    const auto add = [&](std::size_t from, std::size_t size) {
        for (std::size_t i = from; i < from + size; ++i) turned.push_back(plain.at(i));
    };
    add(12 + 116 + 16 + 36 + 16, 8);
    add(12 + 116 + 16, 36);
    add(12, 116);
    add(12 + 116 + 16 + 36, 16);
    add(12 + 116, 16);
    ASSERT_EQ(turned.size(), plain.size());
    const auto packet = parse(turned);
    ASSERT_TRUE(packet) << packet.error().what();
    EXPECT_EQ(*packet, *parse(plain));
}

TEST(R2SonicSections, LyingSizesOfUnknownOnesAreRefused) {
    const wire::Bytes plain = golden("bth0_equi_angle");
    for (const wire::Bytes& lie : {wire::Bytes{'X', '9', 0, 12, 0, 0, 0, 0}, wire::Bytes{'X', '9', 0, 0},
                                   wire::Bytes{'X', '9', 0, 6, 0, 0}, wire::Bytes{'X', '9', 0xFF, 0xFC}})
        EXPECT_FALSE(parse(with(plain, plain.size(), lie))) << to_hex(lie);
    wire::Bytes twice = plain;
    twice.insert(twice.end(), plain.end() - 8, plain.end());  // Q0 a second time
    put_size(twice, twice.size());
    EXPECT_FALSE(parse(twice));
    EXPECT_EQ(parse(twice).error().reason, wire::Reason::trailing_bytes);
}

TEST(R2SonicSections, ThePacketSizeMayBeZeroInSnippetsAndTruePixOnly) {
    for (const char* name : {"sni0_first", "tpx0_first", "tpx0_direction"}) {
        wire::Bytes bytes = golden(name);
        put_size(bytes, 0);
        const auto packet = parse(bytes);
        ASSERT_TRUE(packet) << name << packet.error().what();
        EXPECT_EQ(*packet, *parse(golden(name)));
    }
    wire::Bytes bathymetry = golden("bth0_equi_angle");
    put_size(bathymetry, 0);
    EXPECT_FALSE(parse(bathymetry));
}

TEST(R2SonicSnippets, SeveralStandInOneDatagramEachWithItsOwnSize) {
    const auto packet = parse(golden("sni0_first"));
    ASSERT_TRUE(packet);
    const auto& snippets = std::get<Sni0>(*packet);
    ASSERT_TRUE(snippets.h0);
    EXPECT_EQ(snippets.h0->settings.points, 4) << "snippets of the ping";
    ASSERT_EQ(snippets.others.size(), 1U);
    EXPECT_EQ(snippets.s1.magnitude, (std::vector<std::uint16_t>{1, 2, 3}));
    EXPECT_EQ(snippets.others[0].magnitude, (std::vector<std::uint16_t>{0x0102, 0x0304}));
    const wire::Bytes whole = golden("sni0_first");
    for (std::size_t size = 0; size < whole.size(); ++size) {
        wire::Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_FALSE(parse(cut)) << size;
        if (size < 8) continue;
        put_size(cut, size);
        // Without the second snippet it is whole again.
        EXPECT_EQ(static_cast<bool>(parse(cut)), size == whole.size() - 36) << size;
    }
}

TEST(R2SonicSizes, ATypicalWaterColumnSectionIs18Or36Kilobytes) {
    M1 magnitude;
    magnitude.samples = 36;
    magnitude.beams = 256;
    EXPECT_EQ(serialise(Wcd0Data{0, magnitude}).size(), 12U + 36 + 2 * 256 * 36);
    M2 phase;
    phase.samples = 36;
    phase.beams = 256;
    EXPECT_EQ(serialise(Wcd0Data{0, phase}).size(), 12U + 36 + 4 * 256 * 36);
}

}  // namespace
}  // namespace echoloop::r2sonic
