// The Delta T's 83P and EC: round trips, truncations, lying sizes, float order, a row of them as in a file.
#include "protocols/imagenex/delta_t_codec.h"
#include "protocols/imagenex/delta_t_layouts.h"
#include "protocols/inspect.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::imagenex {
namespace {

// Sizes and places of the specification.
static_assert(wire::fixed_size<ExternalControl>() == 256);

wire::Bytes golden(const std::string& name) {
    return read_hex_file(std::string(ECHOLOOP_SOURCE_DIR) + "/tests/data/deltat/" + name + ".hex").bytes;
}

Profile83P legal_profile() {
    auto profile = arbitrary<Profile83P>();
    profile.has_intensity = profile.speed % 2;
    profile.intensities.resize(profile.has_intensity * profile.ranges.size());
    return profile;
}

TEST(DeltaT, MessagesSurviveARoundTrip) {
    EXPECT_TRUE(rc::check([] {
        for (const DeltaTMessage& message :
             {DeltaTMessage(legal_profile()), DeltaTMessage(arbitrary<ExternalControl>())}) {
            const wire::Bytes bytes = encode(message);
            RC_ASSERT(delta_t_bytes(bytes) == bytes.size());
            const auto parsed = parse_delta_t(bytes);
            RC_ASSERT(parsed.has_value());
            RC_ASSERT(*parsed == message);
        }
    }));
}

TEST(DeltaT, EveryTruncationAndExtensionIsNoMessage) {
    for (const char* name : {"profile_83p", "external_control"}) {
        wire::Bytes bytes = golden(name);
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            const wire::ByteView cut = wire::ByteView(bytes).first(size);
            EXPECT_FALSE(parse_delta_t(cut)) << name << ' ' << size;
            EXPECT_EQ(delta_t_bytes(cut), 0U) << name << ' ' << size;
        }
        bytes.push_back(0);
        EXPECT_FALSE(parse_delta_t(bytes)) << name;
    }
}

TEST(DeltaT, ALyingCountOrSizeIsRefusedWithItsPlace) {
    wire::Bytes more = golden("profile_83p");
    more[71] = 121;
    EXPECT_EQ(parse_delta_t(more).error(),
              (wire::Error{"83P", "intensities", 256 + 2 * 121, wire::Reason::truncated}));
    wire::Bytes fewer = golden("profile_83p");
    fewer[71] = 119;
    EXPECT_EQ(parse_delta_t(fewer).error().reason, wire::Reason::trailing_bytes);
    wire::Bytes size = golden("profile_83p");
    size[5] ^= 4;
    EXPECT_EQ(parse_delta_t(size).error().offset, 4U);
    wire::Bytes none = golden("profile_83p");
    none[117] = 0;  // intensities that it denies
    EXPECT_FALSE(parse_delta_t(none));
}

TEST(DeltaT, FloatsStandWhereTheSpecificationPutsThemInEitherOrder) {
    Profile83P profile;
    profile.x_offset = profile.altitude = profile.scan_angle = 1;  // 3F 80 00 00
    profile.external_heading = -2;                                 // C0 00 00 00
    const wire::Bytes big = encode(DeltaTMessage(profile)), little = encode_with_little_floats(profile);
    ASSERT_EQ(big.size(), 256U);
    ASSERT_EQ(little.size(), 256U);
    for (const std::size_t at : {100, 133, 151}) {
        EXPECT_EQ(to_hex(wire::ByteView(big).subspan(at, 4)), "3f800000") << at;
        EXPECT_EQ(to_hex(wire::ByteView(little).subspan(at, 4)), "0000803f") << at;
    }
    EXPECT_EQ(to_hex(wire::ByteView(little).subspan(146, 4)), "000000c0");
}

TEST(DeltaT, AFileIsARowOfThemAndNoiseHidesNone) {
    const wire::Bytes profile = golden("profile_83p"), control = golden("external_control");
    wire::Bytes lie = profile;
    lie[71] = 99;
    const auto messages = inspect::find_family("deltat")->decode(
        joined({profile, profile, from_hex("38 33 50 0a 00"), control, lie, profile, from_hex("45 43")}));
    ASSERT_EQ(messages.size(), 7U);
    const char* names[] = {"83P", "83P", "", "EC", "", "83P", ""};
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(messages[i].name, names[i]) << i;
    EXPECT_EQ(messages[3].offset, 2 * profile.size() + 5);
}

TEST(DeltaT, TwoLettersAloneAreNotGuessed) {
    wire::Bytes text(256, ' ');
    text[0] = 'E', text[1] = 'C';
    EXPECT_NE(inspect::guess_family(text), inspect::find_family("deltat"));
}

}  // namespace
}  // namespace echoloop::imagenex
