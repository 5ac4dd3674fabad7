// Sentences read: what a Framer finds among noise, what each holds, and what `echoloop inspect` shows of it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>

#include "protocols/nmea/framer.h"
#include "protocols/nmea/inspect.h"
#include "protocols/nmea/sentence.h"
#include "protocols/nmea/sentences.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::nmea {
namespace {

const std::string dpt_line = "$SDDPT,8.00,12.00,100.0*6F\r\n", mtw_line = "$YXMTW,24.9,C*1D\r\n";

wire::Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

std::vector<std::string> lines_in(const std::string& stream, std::size_t piece = 4096) {
    Framer framer;
    std::vector<std::string> found;
    const auto drain = [&] {
        while (const auto line = framer.next()) found.push_back(line->text);
    };
    for (std::size_t at = 0; at < stream.size(); at += piece) {
        framer.feed(bytes_of(stream.substr(at, piece)));
        drain();
        EXPECT_LE(framer.pending_bytes(), longest_line + 1);
    }
    framer.finish();
    drain();
    return found;
}

using Lines = std::vector<std::string>;

TEST(NmeaFramer, FindsSentencesInNoise) {
    EXPECT_EQ(lines_in("\x80\xff$GP" + dpt_line + "junk\n$ ls\n$a,b\n" + mtw_line + "$SDD"),
              (Lines{"$SDDPT,8.00,12.00,100.0*6F", "$YXMTW,24.9,C*1D"}));
    EXPECT_EQ(lines_in("$SDDPT,8\x01,2\n" + mtw_line), Lines{"$YXMTW,24.9,C*1D"});
    EXPECT_EQ(lines_in("$PSAT\n!AIVDM,1,1,,A,13u?etPv2;0n:dDPwUM1U1Cb069D,0*24\n"),
              (Lines{"$PSAT", "!AIVDM,1,1,,A,13u?etPv2;0n:dDPwUM1U1Cb069D,0*24"}));
}

TEST(NmeaFramer, FindsTheSameWhateverThePieces) {
    const std::string stream = "xx" + dpt_line + "$SDDBT,1\r" + mtw_line + "\r\n" + dpt_line;
    const auto whole = lines_in(stream);
    EXPECT_EQ(whole.size(), 3u);
    for (std::size_t piece = 1; piece < 20; ++piece) EXPECT_EQ(lines_in(stream, piece), whole) << piece;
}

TEST(NmeaFramer, AnUnterminatedLineIsTakenForItsChecksumOnly) {
    for (const std::string& good : {dpt_line, mtw_line}) {
        for (std::size_t size = 0; size < good.size(); ++size) {
            const bool whole = size + 2 >= good.size();  // up to the checksum
            EXPECT_EQ(lines_in(good.substr(0, size)).size(), whole ? 1u : 0u) << good.substr(0, size);
        }
    }
}

TEST(NmeaFramer, GivesUpOnALineWithoutEnd) {
    std::string endless = "$SDDPT,";
    endless.append(100000, '1');
    EXPECT_EQ(lines_in(endless + "\n" + dpt_line, 100), Lines{"$SDDPT,8.00,12.00,100.0*6F"});
}

TEST(NmeaSentence, HasItsParts) {
    const auto s = read_sentence("$SDDBT,,f,,M,,F*28");
    ASSERT_TRUE(s);
    EXPECT_EQ(s->address, "SDDBT");
    EXPECT_EQ(s->fields, (Lines{"", "f", "", "M", "", "F"}));
    EXPECT_EQ(s->checksum, 0x28);
    EXPECT_TRUE(s->checksum_fits());
    EXPECT_FALSE(read_sentence("$SDDBT,,f,,M,,F*29")->checksum_fits());
    EXPECT_TRUE(read_sentence("$SDMTW,10.0,C")->checksum_fits()) << "none";
    for (const char* bad :
         {"", "SDDPT,1,2", "$", "$SDDPT*6", "$SDDPT*6G", "$SDDPT*066", "$SDDPT*-1", "$SDDPT*", "$*00"})
        EXPECT_FALSE(read_sentence(bad)) << bad;
}

TEST(NmeaSentence, NumbersAreStrict) {
    EXPECT_EQ(read_number("0006.29"), 6.29);
    EXPECT_EQ(read_number("-0.5"), -0.5);
    EXPECT_EQ(read_number("+3"), 3.0);
    for (const char* bad : {"", " 1", "1 ", "1e5", "nan", "inf", "0x10", "1,5", "--1", "+-1", "-", "."})
        EXPECT_FALSE(read_number(bad)) << bad;
}

TEST(NmeaSentence, WhatTheSounderWritesIsReadAgain) {
    const Style style{"II", 3};
    const auto number_at = [](const std::string& line, std::size_t place) {
        return read_number(
            read_sentence(std::string_view(line).substr(0, line.size() - 2))->fields.at(place));
    };
    for (int mm = 0; mm < 12000; mm += 37) {
        const double depth = mm / 1000.0;
        EXPECT_NEAR(number_at(dpt(depth, -depth, 50, style), 0).value(), depth, 1e-9);
        EXPECT_NEAR(number_at(dpt(depth, -depth, 50, style), 1).value(), -depth, 1e-9);
        EXPECT_NEAR(number_at(depth_below("DBT", depth, style), 2).value(), depth, 1e-9);
        EXPECT_NEAR(number_at(depth_below("DBK", depth, style), 0).value() * 0.3048, depth, 2e-4);
        EXPECT_NEAR(number_at(mtw(depth, style), 0).value(), depth, 0.0501);
    }
    EXPECT_FALSE(number_at(dpt({}, 0, {}, style), 0));
}

RC_GTEST_PROP(NmeaSentence, MakesItsRoundTrip, ()) {
    const auto letter = rc::gen::elementOf(std::string("ABCXYZ0189"));
    const auto sign = rc::gen::elementOf(std::string("09.-,abcAZ ()^"));
    const auto address = *rc::gen::container<std::string>(5, letter);
    const auto rest = *rc::gen::container<std::string>(*rc::gen::inRange<std::size_t>(0, 60), sign);
    const std::string line = sentence(address + "," + rest);
    RC_ASSERT(lines_in("\xff$" + line + "noise") == Lines{line.substr(0, line.size() - 2)});
    const auto read = read_sentence(line.substr(0, line.size() - 2));
    RC_ASSERT(read.has_value());
    RC_ASSERT(read->checksum_fits());
    RC_ASSERT(write_sentence(*read) == line);
}

TEST(NmeaInspect, CoversEveryByteAndSaysWhatIsWrong) {
    const std::string stream = "noise" + dpt_line +
                               "$SDDPT,8.00,12.00*00\r\n$SDDBT,1,f,2,X,3,F\r\n$SDMTW,warm,C\n" +
                               "$SDDPT,1.5\r\n$SDDPT,1.5*5\r\n$PTNTH,1*4B\r\n";
    const auto messages = decode(bytes_of(stream));
    expect_all_covered(messages, stream.size());
    EXPECT_EQ(told(messages),
              (Lines{"|no complete frame", "DPT|", "DPT|Sentence.checksum at byte 18: the characters make 6C",
                     "DBT|DBT.M at byte 13: not the letter of this unit",
                     "MTW|MTW.temperature at byte 7: not a number",
                     "DPT|DPT.offset at byte 11: the fields end here",
                     "Sentence|Sentence.checksum at byte 11: not two hex digits at the end", "PTNTH|"}));
    const auto& depth = messages[1].fields[1];
    EXPECT_EQ(depth.name, "depth");
    EXPECT_EQ(depth.unit, "m");
    EXPECT_EQ(depth.number, 8.0);
    EXPECT_EQ(stream.substr(depth.offset, depth.size), "8.00");
    const auto& sum = messages[1].fields.back();
    EXPECT_EQ(stream.substr(sum.offset, sum.size), "6F");
}

TEST(NmeaInspect, TakesNoStreamWithoutAGoodChecksumForItsOwn) {
    EXPECT_TRUE(recognise(bytes_of("xx" + dpt_line)));
    EXPECT_FALSE(recognise(bytes_of("$SDDPT,8.00,12.00\r\n")));
    EXPECT_FALSE(recognise(bytes_of("$SDDPT,8.00,12.00*00\r\n")));
}

}  // namespace
}  // namespace echoloop::nmea
