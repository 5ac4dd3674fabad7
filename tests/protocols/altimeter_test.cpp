// What altimeters say: in the formats of their hosts, and found among noise.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "protocols/altimeter/inspect.h"
#include "protocols/altimeter/line.h"

namespace echoloop::altimeter {
namespace {

wire::Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// The lines of a stream, written again.
std::string lines_in(const std::string& stream, std::size_t piece = 4096) {
    Framer framer;
    std::string found;
    const auto drain = [&] {
        while (const auto line = framer.next()) found += write_line(*line);
    };
    for (std::size_t at = 0; at < stream.size(); at += piece) {
        framer.feed(bytes_of(stream.substr(at, piece)));
        drain();
        EXPECT_LE(framer.pending_bytes(), 12u);
    }
    framer.finish();
    drain();
    EXPECT_EQ(framer.pending_bytes(), 0u);
    return found;
}

TEST(AltimeterLine, HasTheFormatsOfItsHosts) {
    EXPECT_EQ(write_line({Format::three_decimals, 8.125}), "008.125m\r\n");
    EXPECT_EQ(write_line({Format::two_decimals, 8.126}), "008.13m\r\n");
    EXPECT_EQ(write_line({Format::millimetres, 8.1254}), "8125mm\n");
    EXPECT_EQ(write_line({Format::three_decimals, 0}).size(), 10u);
    EXPECT_EQ(write_line({Format::three_decimals, 1e9}).size(), 10u) << "never longer";
    EXPECT_EQ(write_line({Format::two_decimals, -1}), "000.00m\r\n");
}

TEST(AltimeterLine, HasTheFormatsOfOtherMakers) {
    const std::pair<Reading, std::string> all[] = {
        {{.format = Format::three_decimals, .metres = 5, .letter = 'A'}, "A005.000m\r\n"},
        {{.format = Format::two_digits, .metres = 5}, "05.000m\r\n"},
        {{.format = Format::benthos, .metres = 5}, "R05.00\r\n"},
        {{.format = Format::benthos, .metres = 99.99, .mark = 'E'}, "R99.99E\r\n"},
        {{.format = Format::benthos, .metres = 0.4, .mark = '<'}, "R00.40<\r\n"},
        {{.format = Format::metres, .metres = 5}, "5.000\r\n"},
        {{.format = Format::centimetres, .metres = 5}, "00500\r\n"},
        {{.format = Format::time, .microseconds = 6667, .level = 80}, "\xFF\x1A\x0B\x50"}};
    for (const auto& [reading, text] : all) {
        EXPECT_EQ(write_line(reading), text);
        const auto read = read_line(text);
        ASSERT_TRUE(read) << text;
        EXPECT_EQ(read->format, reading.format) << text;
        EXPECT_EQ(read->metres, reading.metres) << text;
        EXPECT_EQ(write_line(*read), text) << "letter and mark";
    }
    EXPECT_EQ(read_line("\xFF\x1A\x0B\x50")->microseconds, 6667);
    EXPECT_EQ(read_line("\xFF\x1A\x0B\x50")->level, 80);
}

TEST(AltimeterFramer, NumbersAloneBeginTheirLineAndTimesFollowEachOther) {
    EXPECT_EQ(lines_in("5.000\r\nx5.000\r\n,5.000\r\n6.125\r\n00500\r\n"), "5.000\r\n6.125\r\n00500\r\n");
    const std::string times = "\xFF\x1A\x0B\x50\xFF\x1A\x0C\x51";
    EXPECT_EQ(lines_in(times), times);
    EXPECT_EQ(lines_in("\xFF\x1A\x0B\x50"
                       "008.125m\r\n"),
              "008.125m\r\n")
        << "a stray FF takes no line along";
    EXPECT_EQ(lines_in("xA005.000m\r\nI005.000m\r\n"), "A005.000m\r\n005.000m\r\n");
}

TEST(AltimeterLine, IsStrict) {
    for (const char* bad : {"",
                            "m\r\n",
                            "mm\n",
                            "8.125m\r\n",
                            "008.125m\n",
                            "008.125m",
                            "008.1255m\r\n",
                            "008,125m\r\n",
                            "-08.125m\r\n",
                            "+08.125m\r\n",
                            " 08.125m\r\n",
                            "1e3.125m\r\n",
                            "8125 mm\n",
                            "8.5mm\n",
                            "8125mm\r\n",
                            "1234567mm\n",
                            "nan.000m\r\n",
                            "R5.00\r\n",
                            "R05.00X\r\n",
                            "R05.00",
                            "A05.000m\r\n",
                            "I005.000m\r\n",
                            "5.00\r\n",
                            "0500\r\n",
                            "\xFF\x1A\x0B"})
        EXPECT_FALSE(read_line(bad)) << bad;
    const std::string good = "008.125m\r\n";
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_FALSE(read_line(good.substr(0, size))) << size;
}

TEST(AltimeterFramer, FindsLinesInNoiseWhateverThePieces) {
    const std::string stream = "\xff\n08.125m\r\n008.125m\r\nxx7993mm\n1008.125m\r\n" +
                               std::string(500, 'x') + "008.13m\r\n9.000mm\n008.1\r\n25m\r\n12mm\n";
    const std::string expected = "08.125m\r\n008.125m\r\n7993mm\n008.13m\r\n12mm\n";
    EXPECT_EQ(lines_in(stream), expected);
    for (std::size_t piece = 1; piece < 24; ++piece) EXPECT_EQ(lines_in(stream, piece), expected) << piece;
}

RC_GTEST_PROP(AltimeterLine, MakesItsRoundTrip, ()) {
    const auto format = static_cast<Format>(*rc::gen::inRange(0, 3));
    const double metres = *rc::gen::inRange(0, 99999) / 100.0;
    const std::string line = write_line({format, metres});
    const auto read = read_line(line);
    RC_ASSERT(read.has_value());
    RC_ASSERT(read->format == format);
    RC_ASSERT(std::abs(read->metres - metres) < 1e-9);
}

TEST(AltimeterInspect, CoversEveryByte) {
    const std::string stream = "noise008.125m\r\n7993mm\nrest";
    const auto messages = decode(bytes_of(stream));
    ASSERT_EQ(messages.size(), 4u);
    EXPECT_EQ(messages[1].fields.at(0).number, 8.125);
    EXPECT_EQ(messages[1].fields.at(0).unit, "m");
    EXPECT_EQ(messages[2].fields.at(0).number, 7993);
    EXPECT_EQ(messages[2].fields.at(0).unit, "mm");
    EXPECT_EQ(messages[3].offset + messages[3].size, stream.size());
    EXPECT_TRUE(recognise(bytes_of(stream)));
    EXPECT_FALSE(recognise(bytes_of("8.125 m\r\n")));
    EXPECT_FALSE(recognise(bytes_of("8.125\r\n"))) << "anybody's";
}

}  // namespace
}  // namespace echoloop::altimeter
