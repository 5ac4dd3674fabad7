// The SeaNet framer on clean, noisy, split and lying streams.
#include "protocols/seanet/framer.h"

#include "protocols/seanet/codec.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"

namespace echoloop::seanet {
namespace {

std::vector<Frame> drain(Framer& framer) {
    std::vector<Frame> out;
    while (auto frame = framer.next()) out.push_back(*std::move(frame));
    return out;
}

std::vector<Frame> frames_of(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    framer.finish();
    return drain(framer);
}

void append(wire::Bytes& to, const wire::Bytes& more) { to.insert(to.end(), more.begin(), more.end()); }

Frame arbitrary_frame() {
    switch (*rc::gen::inRange(0, 4)) {
        case 0:
            return make_frame(arbitrary<HeadData>());
        case 1:
            return make_frame(arbitrary<Alive>());
        case 2:
            return make_frame(arbitrary<HeadCommandDual>());
        default:
            return make_frame(ReBoot{});
    }
}

/// Noise with many '@', LF and digits in it, never with a length that both forms agree on.
wire::Bytes arbitrary_noise() {
    const auto byte = rc::gen::weightedOneOf<std::uint8_t>(
        {{3, rc::gen::element<std::uint8_t>('@', '\n', '0', '8')}, {2, rc::gen::arbitrary<std::uint8_t>()}});
    return *rc::gen::container<wire::Bytes>(byte);
}

TEST(Framer, FramesOfACleanStreamAllComeOut) {
    EXPECT_TRUE(rc::check([] {
        std::vector<Frame> sent(*rc::gen::inRange<std::size_t>(0, 6));
        wire::Bytes stream;
        for (Frame& frame : sent) append(stream, encode(frame = arbitrary_frame()));
        Framer framer;
        framer.feed(stream);
        RC_ASSERT(drain(framer) == sent);
        RC_ASSERT(framer.skipped_bytes() == 0U);
        RC_ASSERT(framer.pending_bytes() == 0U);
    }));
}

TEST(Framer, FramesComeOutWhereverTheStreamIsSplit) {
    EXPECT_TRUE(rc::check([] {
        wire::Bytes stream = arbitrary_noise();
        for (int i = 0; i < 3; ++i) {
            append(stream, encode(arbitrary_frame()));
            append(stream, arbitrary_noise());
        }
        const auto whole = frames_of(stream);
        for (std::size_t at = 0; at <= stream.size(); ++at) {
            Framer framer;
            framer.feed(wire::ByteView(stream).first(at));
            auto got = drain(framer);
            framer.feed(wire::ByteView(stream).subspan(at));
            framer.finish();
            for (auto& frame : drain(framer)) got.push_back(std::move(frame));
            RC_ASSERT(got == whole);
        }
    }));
}

TEST(Framer, NoiseBetweenFramesIsSkippedAndCounted) {
    EXPECT_TRUE(rc::check([] {
        std::vector<Frame> sent;
        std::size_t noise_bytes = 0;
        wire::Bytes stream;
        for (int i = 0; i < 4; ++i) {
            const auto noise = arbitrary_noise();
            noise_bytes += noise.size();
            append(stream, noise);
            append(stream, encode(sent.emplace_back(arbitrary_frame())));
        }
        Framer framer;
        framer.feed(stream);
        framer.finish();
        RC_ASSERT(drain(framer) == sent);
        RC_ASSERT(framer.skipped_bytes() == noise_bytes);
    }));
}

TEST(Framer, AFlippedByteCostsNoOtherFrame) {
    const Frame line = make_frame(HeadData{.bins = wire::Bytes(60, '@')});
    const Frame alive = make_frame(Alive{});
    wire::Bytes good = encode(alive);
    append(good, encode(line));
    append(good, encode(alive));
    const std::size_t second = encode(alive).size();
    for (std::size_t at = second; at < second + encode(line).size(); ++at) {
        wire::Bytes bad = good;
        bad[at] ^= 0x15;
        const auto got = frames_of(bad);
        ASSERT_GE(got.size(), 2U) << at;
        EXPECT_EQ(got.front(), alive) << at;
        EXPECT_EQ(got.back(), alive) << at;
    }
}

TEST(Framer, OneByteAtATimeIsEnoughAndKnowsTheOffset) {
    wire::Bytes stream{'x', '@', '0'};
    append(stream, encode(Alive{}));
    Framer framer;
    std::size_t found = 0;
    for (const std::uint8_t byte : stream) {
        framer.feed({&byte, 1});
        if (framer.next()) {
            ++found;
            EXPECT_EQ(framer.frame_offset(), 3U);
        }
    }
    EXPECT_EQ(found, 1U);
    EXPECT_EQ(framer.skipped_bytes(), 3U);
}

// PeRL's mtReBoot: 14 bytes that claim to be 18.
const wire::Bytes long_claim = from_hex("40 30303043 0C00 FF 02 03 10 80 02 0A");

TEST(Framer, ALengthThatDoesNotEndInLfCostsOnlyThatFrame) {
    const Frame next = make_frame(SendData{0});
    wire::Bytes stream = long_claim;
    append(stream, encode(next));
    Framer framer;
    framer.feed(long_claim);
    EXPECT_FALSE(framer.next());
    framer.feed(encode(next));
    EXPECT_EQ(framer.next(), next);
    EXPECT_EQ(framer.skipped_bytes(), long_claim.size());
}

TEST(Framer, ById_AcceptsAShortCommandWithAWrongLength) {
    Framer framer(Framer::Lengths::by_id);
    framer.feed(long_claim);
    const auto frame = framer.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->header.id, Id::reboot);
    EXPECT_TRUE(parse(*frame));
    framer.feed(encode(Message(Alive{})));
    ASSERT_TRUE(framer.next());
    EXPECT_EQ(framer.skipped_bytes(), 0U);
}

TEST(Framer, LengthsBeyondTheLimitsAreNoFrames) {
    Frame largest = make_frame(AuxData{});
    largest.payload.assign(max_frame_bytes - min_frame_bytes, 1);
    EXPECT_EQ(frames_of(encode(largest)).size(), 1U);
    largest.payload.push_back(1);
    EXPECT_TRUE(frames_of(encode(largest)).empty());
    EXPECT_TRUE(frames_of(from_hex("40 30303037 0700 FF 02 02 10 80 0A")).empty()) << "13 bytes in all";
}

TEST(Framer, BothLengthFormsMustAgree) {
    auto bytes = encode(Message(ReBoot{}));
    bytes[4] = '9';
    EXPECT_TRUE(frames_of(bytes).empty());
    bytes = encode(Message(ReBoot{}));
    bytes[5] = 9;
    EXPECT_TRUE(frames_of(bytes).empty());
}

TEST(Framer, LengthFormsThatDisagreeAreNotWaitedFor) {
    Framer framer;
    framer.feed(from_hex("40 30303038 FA0F"));  // "0008", but 4090
    framer.feed(encode(Message(ReBoot{})));
    EXPECT_TRUE(framer.next());
    EXPECT_EQ(framer.skipped_bytes(), 7U);
}

TEST(Framer, MemoryStaysBoundedWhateverIsFed) {
    Framer framer;
    const wire::Bytes claim = from_hex("40 30464641 FA0F");  // claims 4096 bytes that never come
    for (int i = 0; i < 40000; ++i) framer.feed(claim);
    EXPECT_LE(framer.pending_bytes(), 65536U);
    EXPECT_TRUE(drain(framer).empty());
    EXPECT_LE(framer.pending_bytes(), max_frame_bytes);
    EXPECT_EQ(framer.skipped_bytes() + framer.pending_bytes(), 40000 * claim.size());
}

TEST(Framer, ClearForgetsWhatWasPending) {
    Framer framer;
    const auto bytes = encode(Message(SendData{7}));
    framer.feed(wire::ByteView(bytes).first(10));
    framer.clear();
    framer.feed(bytes);
    ASSERT_TRUE(framer.next());
    EXPECT_EQ(framer.skipped_bytes(), 0U);
    EXPECT_EQ(framer.frame_offset(), 10U);
}

}  // namespace
}  // namespace echoloop::seanet
