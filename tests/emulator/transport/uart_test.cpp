// What a UART makes of another rate, against bit patterns worked out by hand.
#include "emulator/transport/uart.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace echoloop::test {
namespace {

using uart::as_heard;
using uart::BadByte;

Bytes heard(const Bytes& sent, double sent_rate, double rate) { return as_heard(sent, sent_rate, {rate}); }

TEST(Uart, TheSameRateGivesEveryByteBack) {
    Bytes all;
    for (int value = 0; value < 256; ++value) all.push_back(static_cast<std::uint8_t>(value));
    EXPECT_EQ(heard(all, 115200, 115200), all);
}

RC_GTEST_PROP(Uart, RatesThatAgreeLoseNothing, (const Bytes& sent)) {
    const double off = *rc::gen::inRange(-300, 301) * 1e-4;
    RC_ASSERT(uart::agree(115200 * (1 + off), 115200));
    RC_ASSERT(heard(sent, 115200 * (1 + off), 115200) == sent);
}

// On the line: 0 1 0 1 0 1 0 1 0 1, each two bits of the receiver long. From the first edge it reads 0, then
// 0 11 00 11 0 as data, and the fourth zero as a missing stop bit; from the edge at bit 6 the rest and the
// silence.
TEST(Uart, AnUAtHalfTheRateIsTwoOtherBytes) { EXPECT_EQ(heard({0x55}, 57600, 115200), (Bytes{0x66, 0xE6})); }

// Low for nine bits, that is for the start bit and two and a half more of the receiver: samples at bits 4.5,
// 7.5 and then 10.5, where the line rests.
TEST(Uart, ZerosAtThreeTimesTheRateLoseTheirLength) {
    EXPECT_EQ(heard({0x00}, 115200, 38400), (Bytes{0xFC}));
}

// A start bit alone is a ninth of what the receiver takes for one.
TEST(Uart, AStartBitThatIsTooShortIsASpike) { EXPECT_EQ(heard({0xFF}, 115200, 12800), Bytes{}); }

TEST(Uart, ABreakIsOneByteHoweverLong) {
    // Sent at a tenth of the rate a zero is low for 90 of the receiver's bits: one break, and then silence.
    EXPECT_EQ(heard({0x00}, 11520, 115200), (Bytes{0x00}));
    EXPECT_EQ(heard({0x00, 0x00}, 11520, 115200), (Bytes{0x00, 0x00})) << "the stop bit between them is seen";
}

TEST(Uart, TheOwnerOfTheReceiverDecidesWhatBecomesOfBadBytes) {
    const auto with = [](BadByte framing_error, BadByte line_break, const Bytes& sent) {
        return as_heard(sent, 57600, {115200, framing_error, line_break});
    };
    EXPECT_EQ(with(BadByte::zero, BadByte::zero, {0x55}), (Bytes{0x00, 0xE6}));
    EXPECT_EQ(with(BadByte::nothing, BadByte::zero, {0x55}), (Bytes{0xE6}));
    EXPECT_EQ(with(BadByte::as_sampled, BadByte::zero, {0x00}), (Bytes{0x00})) << "low for 18 of its bits";
    EXPECT_EQ(with(BadByte::as_sampled, BadByte::nothing, {0x00}), Bytes{});
}

RC_GTEST_PROP(Uart, NoRateMakesMoreThanOneByteOfEachEdge, (const Bytes& sent)) {
    const double sent_rate = *rc::gen::inRange(50, 4'000'000), rate = *rc::gen::inRange(50, 4'000'000);
    RC_ASSERT(heard(sent, sent_rate, rate).size() <= 5 * sent.size());
}

}  // namespace
}  // namespace echoloop::test
