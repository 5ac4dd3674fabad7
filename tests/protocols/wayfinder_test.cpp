// Packets of a Wayfinder: round trips, truncations, damage, and the framer on noisy and split streams. The
// golden bytes of tests/data/wayfinder are read by golden_test.cpp.
#include "protocols/wayfinder/codec.h"
#include "protocols/wayfinder/inspect.h"
#include "protocols/wayfinder/layouts.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::wayfinder {
namespace {

wire::Bytes golden(const std::string& name) {
    for (const auto& path : hex_files("wayfinder"))
        if (path.stem() == name) return read_hex_file(path).bytes;
    return {};
}

template <class M>
constexpr Kind kind_of = std::is_same_v<M, Data>    ? Kind::data
                         : std::is_same_v<M, Other> ? Kind::status
                                                    : requires(M m) {
    m.outcome;
}
? Kind::response : Kind::command;

/// What comes out of a stream that is cut into pieces.
std::vector<wire::Bytes> packets_of(wire::ByteView bytes, std::size_t piece) {
    return found_in_pieces(Framer(), bytes, piece);
}

template <class M>
class WayfinderMessage : public ::testing::Test {};
TYPED_TEST_SUITE(WayfinderMessage, TypesOf<Body>::type);

TYPED_TEST(WayfinderMessage, MakesItsRoundTripAndIsRefusedWhenCut) {
    EXPECT_TRUE(rc::check([] {
        const wire::Bytes bytes = encode({kind_of<TypeParam>, arbitrary<TypeParam>()});
        const auto parsed = parse(bytes);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(encode(*parsed) == bytes);
        for (std::size_t size = 0; size < bytes.size(); ++size)
            RC_ASSERT(!parse(wire::ByteView(bytes).first(size)).has_value());
    }));
}

TEST(WayfinderPacket, HasTheValuesThatTheMakersDriverReads) {
    const auto packet = parse(golden("data"));
    ASSERT_TRUE(packet);
    const auto& data = std::get<Data>(packet->body);
    EXPECT_FLOAT_EQ(data.velocity[0], 0.12F);
    EXPECT_FLOAT_EQ(data.velocity[1], -0.04F);
    EXPECT_FLOAT_EQ(data.range[3], 5.36F);
    EXPECT_EQ(data.serial_number.view(), "001234");
    EXPECT_EQ(std::get<SetSetup>(parse(golden("set_setup"))->body).setup.most_range, 45);
}

TEST(WayfinderPacket, IsRefusedWhenDamaged) {
    for (const char* name : {"data", "get_system", "set_setup", "system"}) {
        const wire::Bytes bytes = golden(name);
        ASSERT_TRUE(parse(bytes)) << name;
        for (std::size_t at = 0; at < bytes.size(); ++at) {
            wire::Bytes damaged = bytes;
            ++damaged[at];
            EXPECT_FALSE(parse(damaged)) << name << ' ' << at;
        }
    }
}

TEST(WayfinderPacket, DataOfAWrongSumInsideIsRefusedThoughThatOfThePacketFits) {
    wire::Bytes bytes = golden("data");
    ++bytes[40];
    const std::uint16_t total = sum(wire::ByteView(bytes).first(bytes.size() - 2));
    bytes[bytes.size() - 2] = static_cast<std::uint8_t>(total);
    bytes[bytes.size() - 1] = static_cast<std::uint8_t>(total >> 8);
    EXPECT_FALSE(parse(bytes));
}

TEST(WayfinderPacket, ParametersThatDoNotFitTheirCommandAreKept) {
    const Command odd{CommandId::set_setup, {1, 2, 3}};
    EXPECT_EQ(std::get<Command>(parse(encode({Kind::command, odd}))->body), odd);
    EXPECT_FALSE(parse(encode({Kind::command, Other{{0x0F, 0, 0}}}))) << "no whole number";
}

TEST(WayfinderFramer, FindsPacketsInNoiseWhateverThePieces) {
    const wire::Bytes data = golden("data"), ask = golden("get_system");
    wire::Bytes damaged = data;
    ++damaged[60];
    wire::Bytes stream{0x00, 0xAA, 0xAA, 0x10, 0x01, 0x00, 0x80, 0x02};
    for (const wire::Bytes& part : {data, damaged, ask, data})
        stream.insert(stream.end(), part.begin(), part.end());
    stream.insert(stream.end(), ask.begin(), ask.end() - 3);
    for (std::size_t piece = 1; piece <= stream.size(); piece += piece < 20 ? 1 : 37)
        EXPECT_EQ(packets_of(stream, piece), (std::vector<wire::Bytes>{data, ask, data})) << piece;
}

TEST(WayfinderFramer, ASizeThatLiesHoldsNothingUp) {
    wire::Bytes stream = golden("get_system");
    stream[4] = 0x70;  // 28 kB
    const wire::Bytes ask = golden("get_system");
    stream.insert(stream.end(), ask.begin(), ask.end());
    Framer framer;
    framer.feed(stream);
    EXPECT_EQ(framer.next(), ask);
}

TEST(WayfinderInspect, CoversEveryByte) {
    wire::Bytes stream = golden("system");
    stream.insert(stream.begin(), {0x00, 0xAA, 0x10, 0x02});
    stream.push_back(0xAA);
    expect_all_covered(decode(stream), stream.size());
    EXPECT_EQ(checksums(golden("data")), (std::vector<ChecksumPlace>{{golden("data").size() - 2, 2, false}}));
}

}  // namespace
}  // namespace echoloop::wayfinder
