// Sentences of sounders: published and recorded ones, and those worked out by hand from the rules.
#include <gtest/gtest.h>

#include "protocols/nmea/sentences.h"

namespace echoloop::nmea {
namespace {

const Style one_decimal{"SD", 1}, two_decimals{"SD", 2}, three_decimals{"SD", 3};

TEST(NmeaChecksum, IsThatOfPublishedAndRecordedSentences) {
    // A maker's manual (survey sounder), a research ship's log, two small sounders' logs.
    EXPECT_EQ(sentence("SDDBS,67.915,f,20.701,M,11.319,F"), "$SDDBS,67.915,f,20.701,M,11.319,F*32\r\n");
    EXPECT_EQ(sentence("SDDPT,0006.29,002.40"), "$SDDPT,0006.29,002.40*6C\r\n");
    EXPECT_EQ(sentence("YXMTW,24.9,C"), "$YXMTW,24.9,C*1D\r\n");
    EXPECT_EQ(sentence("SDDPT,,"), "$SDDPT,,*57\r\n");
}

TEST(NmeaChecksum, HasTwoCapitalHexDigits) {
    EXPECT_EQ(sentence("SDMTW,10.0,C"), "$SDMTW,10.0,C*05\r\n") << "a leading zero";
    EXPECT_EQ(sentence("SDDBK,24.6,f,7.5,M,4.1,F"), "$SDDBK,24.6,f,7.5,M,4.1,F*2E\r\n") << "capitals";
}

TEST(NmeaDepth, ComesInFeetMetresAndFathoms) {
    // 8 m / 0.3048 = 26.2467 ft, / 6 = 4.3745 fathoms.
    EXPECT_EQ(depth_below("DBT", 8.0, two_decimals), "$SDDBT,26.25,f,8.00,M,4.37,F*0D\r\n");
    EXPECT_EQ(depth_below("DBS", 20.701, three_decimals), "$SDDBS,67.917,f,20.701,M,11.319,F*30\r\n")
        << "a maker's manual rounds its feet down to 67.915";
    EXPECT_EQ(depth_below("DBK", 7.5, one_decimal), "$SDDBK,24.6,f,7.5,M,4.1,F*2E\r\n");
}

TEST(NmeaDepth, IsNullWithoutABottom) {
    EXPECT_EQ(depth_below("DBT", {}, two_decimals), "$SDDBT,,f,,M,,F*28\r\n") << "as recorded";
    EXPECT_EQ(dpt({}, 0.5, {}, one_decimal), "$SDDPT,,0.5*7C\r\n");
}

TEST(NmeaDpt, HasOffsetAndRangeInUse) {
    EXPECT_EQ(dpt(8.0, 12, 100, two_decimals), "$SDDPT,8.00,12.00,100.0*6F\r\n");
    EXPECT_EQ(dpt(8.0, -0.5, {}, one_decimal), "$SDDPT,8.0,-0.5*77\r\n");
    EXPECT_EQ(dpt(8.0, -0.001, {}, one_decimal), "$SDDPT,8.0,0.0*5F\r\n") << "no minus before zero";
}

TEST(NmeaMtw, IsInDegreesCelsius) {
    EXPECT_EQ(mtw(24.9, {"YX", 2}), "$YXMTW,24.9,C*1D\r\n") << "as recorded";
    EXPECT_EQ(mtw(-1.24, two_decimals), "$SDMTW,-1.2,C*1A\r\n");
}

}  // namespace
}  // namespace echoloop::nmea
