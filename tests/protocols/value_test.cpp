// Values as people read them.
#include "protocols/wire/value.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "protocols/wire/text.h"

namespace echoloop::wire {
namespace {

std::string text_of(Value value, Format format = Format::plain, std::size_t size = 4) {
    return value_text({.name = "x", .size = size, .format = format, .value = std::move(value)});
}

TEST(Value, AFloatPrintsAsItsShortestDecimal) {
    EXPECT_EQ(text_of(readable(0.1F)), "0.1");
    EXPECT_EQ(text_of(readable(400000.0F)), "400000");
    EXPECT_EQ(text_of(readable(35e-6F)), "3.5e-05");
    EXPECT_EQ(text_of(readable(-0.0F)), "-0");
    EXPECT_EQ(text_of(readable(std::numeric_limits<float>::infinity())), "inf");
    EXPECT_EQ(text_of(std::nan("")), "nan");
}

TEST(Value, AReadableFloatReadsBackAsTheSameFloat) {
    for (std::uint32_t bits = 1; bits < 0x7F800000; bits += 999983) {
        const auto value = std::bit_cast<float>(bits);
        ASSERT_EQ(static_cast<float>(readable(value)), value) << bits;
    }
}

TEST(Value, FormatsFollowTheField) {
    EXPECT_EQ(text_of(std::uint64_t{0xBEEF}, Format::hex, 2), "0xbeef");
    EXPECT_EQ(text_of(std::uint64_t{0x0A000166}, Format::ipv4), "10.0.1.102");
    EXPECT_EQ(text_of(std::int64_t{-26}), "-26");
    EXPECT_EQ(text_of(std::vector<double>(9, 0.5)), "[9] 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.5 ...");
    EXPECT_EQ(text_of(std::vector<double>{}), "[0]");
}

TEST(Value, BitsWithoutANameStillShowInTheNumber) {
    static constexpr NamedValue names[] = {{1, "one"}, {4, "four"}};
    FieldView view{
        .name = "x", .size = 1, .format = Format::bits, .names = names, .value = std::uint64_t{0x0D}};
    EXPECT_EQ(value_text(view), "0x0d (one four)");
    view.format = Format::plain;
    view.value = std::uint64_t{4};
    EXPECT_EQ(value_text(view), "4 (four)");
    view.value = std::uint64_t{5};
    EXPECT_EQ(value_text(view), "5");
}

TEST(Text, KeepsBytesBehindTheFirstNul) {
    Text<4> text("abcdef");
    EXPECT_EQ(text.view(), "abcd");
    text.chars[1] = '\0';
    EXPECT_EQ(text.view(), "a");
    EXPECT_NE(text, Text<4>("a"));
    EXPECT_EQ(Text<4>("a"), "a");
}

}  // namespace
}  // namespace echoloop::wire
