// Imagenex commands and replies: round trips, truncations, damage, and a head's ear on a noisy line.
#include <algorithm>

#include "protocols/imagenex/codec.h"
#include "protocols/imagenex/framer.h"
#include "protocols/imagenex/layouts.h"
#include "protocols/inspect.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::imagenex {
namespace {

// Sizes of the serial interface specification.
static_assert(wire::fixed_size<SwitchCommand>() == 27 && wire::fixed_size<AzimuthCommand>() == 27);
static_assert(wire::fixed_size<AzimuthReply>() == 13 && wire::fixed_size<Packed14>() == 2);
static_assert(wire::fixed_size<Signed14>() == 2);

const wire::Bytes command = from_hex("FE44100500004300140114 3C1408060000000032080600000064FD");
const wire::Bytes profile = from_hex("49505810415844 0A5E020000FC");

/// What rapidcheck made up, bent to what may stand on the line.
void make_legal(SwitchCommand& c) {
    if (c.head_id == azimuth_head_id) c.head_id = 0x10;
}
void make_legal(AzimuthCommand&) {}
void make_legal(AzimuthReply&) {}
void make_legal(Reply& r) {
    constexpr std::size_t sizes[] = {0, 128, 250, 252, 500};
    constexpr Kind kinds[] = {Kind::imx, Kind::igx, Kind::ipx};
    r.kind = kinds[r.status % 3];
    r.data.resize(sizes[r.head_id % 5], r.range);
    r.data_bytes = Packed14(r.data.size());
    if (r.head_id < 2) r.head_id = 0x10;  // where an 831L has its type
}
void make_legal(PipeReply& r) {
    r.kind = r.status % 2 == 0 ? Kind::imx : Kind::ipx;
    r.sonar_type %= 2;
    r.data.resize(r.kind == Kind::imx ? 250 : 0, r.range_code);
    r.data_bytes = Packed14(r.data.size());
}

template <class M>
M legal() {
    M message = arbitrary<M>();
    make_legal(message);
    return message;
}

template <class M>
class ImagenexMessage : public ::testing::Test {};
TYPED_TEST_SUITE(ImagenexMessage, TypesOf<Message>::type);

TYPED_TEST(ImagenexMessage, SurvivesARoundTrip) {
    EXPECT_TRUE(rc::check([] {
        const auto message = legal<TypeParam>();
        const wire::Bytes bytes = encode(Message(message));
        const auto parsed = parse(bytes);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(std::get<TypeParam>(*parsed) == message);
    }));
}

TYPED_TEST(ImagenexMessage, EveryTruncationAndExtensionIsRejected) {
    EXPECT_TRUE(rc::check([] {
        wire::Bytes bytes = encode(Message(legal<TypeParam>()));
        for (std::size_t size = 0; size < bytes.size(); ++size)
            RC_ASSERT(!parse(wire::ByteView(bytes).first(size)));
        bytes.push_back(0xFC);
        RC_ASSERT(!parse(bytes));
    }));
}

TEST(ImagenexPacked, IsDecodedAsTheSpecificationSays) {
    for (unsigned value = 0; value < 0x4000; ++value) {
        const Packed14 packed{std::uint64_t{value}};
        const unsigned low = (packed.high & 1U) << 7 | (packed.low & 0x7FU),
                       high = (packed.high & 0x7EU) >> 1;
        ASSERT_EQ(high << 8 | low, value);
        ASSERT_EQ(std::uint64_t{packed}, value);
        ASSERT_EQ((packed.low | packed.high) & 0x80, 0) << "bit 7 belongs to the control bytes";
    }
    EXPECT_EQ(head_position(600, true).low, 0x58);
    EXPECT_EQ(head_position(600, true).high, 0x44);
}

TEST(ImagenexSigned, HasFourteenBitsBelowTwoFlags) {
    for (int value = Signed14::least; value <= Signed14::most; ++value) {
        const Signed14 one(value, Signed14::is_new);
        ASSERT_EQ(one.value(), value);
        ASSERT_EQ(one.high & 0xC0, 0x80);
    }
    // A real shot's: -65.25 deg.
    EXPECT_EQ(signed14(-65.25, 0.025, Signed14::is_new), Signed14(-2610, Signed14::is_new));
    EXPECT_EQ(Signed14(-2610).low, 0xCE);
    EXPECT_EQ(Signed14(-2610).high, 0x35);
    EXPECT_EQ(signed14(1e9, 0.025, 0).value(), 8191) << "the end of the scale";
    EXPECT_EQ(signed14(-1e9, 0.025, 0).value(), -8192);
}

/// Frames found in `bytes`, the stream cut at `at`.
std::vector<wire::Bytes> frames_of(wire::ByteView bytes, std::size_t at = 0,
                                   Framer::Takes takes = Framer::Takes::everything) {
    return found_in_two(Framer(takes), bytes, at);
}

TEST(ImagenexFramer, BothDirectionsComeOutOfNoiseWhereverTheStreamIsSplit) {
    const auto stream =
        joined({from_hex("FE FE 49 49 4D 38 35"), command, from_hex("FC FD 00"), profile, command});
    for (std::size_t at = 0; at <= stream.size(); ++at)
        EXPECT_EQ(frames_of(stream, at), (std::vector<wire::Bytes>{command, profile, command})) << at;
    EXPECT_EQ(frames_of(stream, 0, Framer::Takes::commands), (std::vector<wire::Bytes>{command, command}));
}

TEST(ImagenexFramer, ACommandIs27BytesUpToTheFirstFD) {
    auto early = command;
    early[10] = 0xFD;  // an absorption of 253
    EXPECT_TRUE(frames_of(early).empty());
    auto late = command;
    late.insert(late.begin() + 20, 0);  // FD is the 28th byte
    EXPECT_TRUE(frames_of(late).empty());
    auto none = command;
    none.back() = 0;
    EXPECT_TRUE(frames_of(none).empty());
    EXPECT_EQ(frames_of(joined({early, late, none, command}), 0, Framer::Takes::commands),
              std::vector<wire::Bytes>{command});
}

TEST(ImagenexFramer, NoDamageToACommandCostsTheOneBehindIt) {
    for (std::size_t at = 0; at < command.size(); ++at)
        for (int value = 0; value < 256; ++value) {
            auto damaged = command;
            damaged[at] = static_cast<std::uint8_t>(value);
            Framer ear(Framer::Takes::commands);
            ear.feed(damaged);
            while (ear.next()) {
            }
            ear.feed(command);
            ASSERT_EQ(ear.next(), command) << at << ": " << value;
            auto shorter = command;
            shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(at));
            ASSERT_EQ(frames_of(joined({shorter, command}), 0, Framer::Takes::commands).back(), command)
                << at;
        }
}

TEST(ImagenexFramer, TheWordsOfOtherHeadsDoNotHoldUpAnEar) {
    Framer ear(Framer::Takes::commands);
    ear.feed(from_hex("49475811 45780A0A 40037403 0102"));  // the begin of 513 bytes
    EXPECT_FALSE(ear.next());
    EXPECT_EQ(ear.pending_bytes(), 0U);
    ear.feed(command);
    EXPECT_TRUE(ear.next());
}

TEST(ImagenexFramer, AReplyMayHoldFCAndMustEndWithIt) {
    Reply reply{.kind = Kind::imx, .data = wire::Bytes(252, 0xFC)};
    auto bytes = encode(Message(reply));
    EXPECT_EQ(bytes.size(), 265U);
    EXPECT_EQ(frames_of(bytes), std::vector<wire::Bytes>{bytes});
    bytes.back() = 0;
    EXPECT_TRUE(frames_of(bytes).empty());
    reply.data.resize(251);
    EXPECT_TRUE(frames_of(encode(Message(reply))).empty()) << "no head sends 251 bytes";
    EXPECT_EQ(parse(encode(Message(reply))).error(),
              (wire::Error{"Reply", "data_bytes", 10, wire::Reason::wrong_count}));
}

TEST(ImagenexFramer, AnEightThirtyOneLHasTwentyBytesMoreThanOtherHeads) {
    PipeReply reply{.data = wire::Bytes(250, 0xFC)};
    reply.data_bytes = Packed14(250);
    const auto imx = encode(Message(reply));
    EXPECT_EQ(imx.size(), 283U);
    const auto ipx = encode(Message(PipeReply{.kind = Kind::ipx}));
    EXPECT_EQ(ipx.size(), 33U);
    // Old firmware of an 881A has an IMX of 250 bytes, too: its id tells it from an 831L's.
    const auto old = encode(Message(Reply{.head_id = 0x10, .data = wire::Bytes(250, 1)}));
    EXPECT_EQ(old.size(), 263U);
    const auto stream = joined({imx, old, ipx, profile, imx});
    for (std::size_t at = 0; at <= stream.size(); at += 7)
        EXPECT_EQ(frames_of(stream, at), (std::vector<wire::Bytes>{imx, old, ipx, profile, imx})) << at;
    auto short_data = imx;
    short_data[10] = 0;  // 128 bytes
    EXPECT_FALSE(parse(short_data));
    EXPECT_TRUE(frames_of(short_data).empty());
}

TEST(ImagenexFramer, EveryByteIsAccountedForAndMemoryIsBounded) {
    Framer framer;
    const auto claim = from_hex("3831410302 80 0201");  // a shot of 640 bytes that never comes right
    for (int i = 0; i < 40000; ++i) framer.feed(claim);
    EXPECT_LE(framer.pending_bytes(), std::size_t{128} << 10);
    EXPECT_FALSE(framer.next());
    EXPECT_EQ(framer.skipped_bytes() + framer.pending_bytes(), 40000 * claim.size());
    framer.clear();
    framer.feed(command);
    EXPECT_TRUE(framer.next());
    EXPECT_EQ(framer.frame_offset(), 40000 * claim.size());
}

}  // namespace
}  // namespace echoloop::imagenex
