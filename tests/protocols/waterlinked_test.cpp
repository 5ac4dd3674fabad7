// What Water Linked's Doppler logs and their hosts say: published sentences and their sums, objects in
// pieces, and what is no message. The golden bytes of tests/data/waterlinked are read by golden_test.cpp.
#include <gtest/gtest.h>

#include "protocols/waterlinked/framer.h"
#include "protocols/waterlinked/inspect.h"
#include "protocols/waterlinked/json_text.h"
#include "protocols/waterlinked/pd4.h"
#include "protocols/waterlinked/sentence.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::waterlinked {
namespace {

wire::Bytes bytes(const std::string& text) { return {text.begin(), text.end()}; }

std::vector<std::string> pieces_of(const std::string& stream, std::size_t size) {
    std::vector<std::string> out;
    feed_in_pieces(Framer(), bytes(stream), size, [&](const Piece& piece) { out.push_back(piece.text); });
    return out;
}

TEST(WaterlinkedSentence, SumsArePublishedOnes) {
    EXPECT_EQ(crc8("123456789"), 0xf4) << "the check value of CRC-8";
    for (const char* line : {"wcv*fe", "wcw*f9", "wcc*95", "wcr*e2", "wcx*d4", "wcg*89", "wcs,,,,y,,*35",
                             "wcs,,,,,wt,*91", "wra*d9", "wrn*f4", "wr?*44", "wr!*1e", "wrv,2.8.0*b2",
                             "wrc,1475.00,20.00,y,n,auto,y*c1", "wru,0,0.000,-1.00,-40,-95*9f"}) {
        const auto read = read_sentence(line);
        ASSERT_TRUE(read) << line;
        ASSERT_TRUE(read->checksum) << line;
        EXPECT_TRUE(read->checksum_fits()) << line;
        EXPECT_EQ(sentence(read->body()), std::string(line) + "\r\n");
        EXPECT_EQ(write_sentence(*read), std::string(line) + "\r\n");
    }
    EXPECT_FALSE(read_sentence("wcv*ff")->checksum_fits());
    EXPECT_TRUE(read_sentence("wcv")->checksum_fits()) << "none is none that is wrong";
    for (const char* bad :
         {"", "w", "wc", "xcv", "wzv", "wc1", "wc?", "wcv,1*f", "wcv*fg", "wcv*fe0", "wcvx"})
        EXPECT_FALSE(read_sentence(bad)) << bad;
}

TEST(WaterlinkedSentence, EmptyFieldsAreFields) {
    EXPECT_EQ(read_sentence("wcs,,,,,wt,*91")->fields, (std::vector<std::string>{"", "", "", "", "wt", ""}));
    EXPECT_TRUE(read_sentence("wra*d9")->fields.empty());
}

TEST(WaterlinkedFramer, FindsAllProtocolsWhateverThePieces) {
    const std::string block([] {
        const auto encoded = encode(Pd4{.velocity = {1, 2, 3, 4}, .sound_speed = 1475});
        return std::string(encoded.begin(), encoded.end());
    }());
    const std::string object = R"({"command":"set_config","parameters":{"range_mode":"}{\"["}})";
    const std::string stream = "noise" + object + "[1,[2]]\r\nwcv*fe\r\nwcc\r" + block +
                               ":BI,  +123,  -420, +2000,    +0,A\r\nwhat\r\n{\"x\":";
    const std::vector<std::string> wanted{object, "[1,[2]]", "wcv*fe",
                                          "wcc",  block,     ":BI,  +123,  -420, +2000,    +0,A"};
    for (std::size_t size = 1; size <= stream.size(); ++size)
        EXPECT_EQ(pieces_of(stream, size), wanted) << size;
}

TEST(WaterlinkedFramer, GivesUpOnWhatNeverEnds) {
    Framer framer;
    const std::string line(1000, 'w'), object = "{" + std::string(longest_json, ' ');
    framer.feed(bytes(object));
    EXPECT_FALSE(framer.next());
    EXPECT_LT(framer.pending_bytes(), longest_json);
    framer.feed(bytes(line));
    framer.feed(bytes("\nwcv*fe\n"));
    const auto piece = framer.next();
    ASSERT_TRUE(piece);
    EXPECT_EQ(piece->text, "wcv*fe");
}

TEST(WaterlinkedJson, MembersAreThoseOfTheTop) {
    const std::string text = R"( { "a" : 1.5 ,"b":{"a":[1,2]},"c":"x\"}","d":[], "e":null } )";
    const auto members = members_of(text);
    ASSERT_TRUE(members);
    ASSERT_EQ(members->size(), 5U);
    EXPECT_EQ(value_of(*members, "a"), "1.5");
    EXPECT_EQ(value_of(*members, "b"), R"({"a":[1,2]})");
    EXPECT_EQ(unquoted(value_of(*members, "c")), R"(x\"})");
    EXPECT_EQ(value_of(*members, "d"), "[]");
    EXPECT_EQ(value_of(*members, "f"), "");
    EXPECT_TRUE(members_of("{}")->empty());
    for (const char* bad :
         {"", "[]", "{", "{\"a\"}", "{\"a\":}", "{a:1}", "{\"a\":1,}", "{\"a\":1}x", "{\"a\":\"x}"})
        EXPECT_FALSE(members_of(bad)) << bad;
}

TEST(WaterlinkedPd4, IsRefusedWithAWrongSumOrCut) {
    auto block = encode(Pd4{.velocity = {123, -420, 2000, 0}});
    ASSERT_EQ(block.size(), pd4_size);
    ASSERT_TRUE(parse_pd4(block));
    EXPECT_EQ(parse_pd4(block)->velocity[1], -420);
    for (std::size_t size = 0; size < block.size(); ++size)
        EXPECT_FALSE(parse_pd4(wire::ByteView(block).first(size))) << size;
    ++block[10];
    EXPECT_FALSE(parse_pd4(block));
}

TEST(WaterlinkedInspect, CoversEveryByteAndSaysWhatIsWrong) {
    const std::string stream =
        "??wcv*ff\r\n[\"command\",\"get_config\"]{\"type\":\"other\",\"z\":1}\r\nwcv*fe\r\n";
    const auto messages = decode(bytes(stream));
    expect_all_covered(messages, stream.size());
    EXPECT_EQ(told(messages), (std::vector<std::string>{
                                  "|no complete frame", "wcv|wcv.checksum at byte 4: the characters make fe",
                                  "object|object at byte 0: an array, not an object", "object|", "wcv|"}));
}

}  // namespace
}  // namespace echoloop::waterlinked
