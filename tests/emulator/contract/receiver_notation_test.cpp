// Ring-down and interference as a profile writes them down.
#include "emulator/contract/receiver_notation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace echoloop::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string fault_of(void (*read)(std::string_view), std::string_view text) {
    try {
        read(text);
    } catch (const std::invalid_argument& fault) {
        return fault.what();
    }
    return "";
}
std::string ring_fault(std::string_view text) {
    return fault_of([](std::string_view t) { read_ring_down(t); }, text);
}
std::string interference_fault(std::string_view text) {
    return fault_of([](std::string_view t) { read_interference(t); }, text);
}

TEST(ReceiverNotation, ACurve) {
    const auto ring = read_ring_down("pulse 0.05; 0.2: -60 +-4 ~2, 0.5: -80.5;\n bearings 0.5 1 -1.7");
    ASSERT_EQ(ring->points.size(), 2U);
    EXPECT_DOUBLE_EQ(ring->pulse, 50e-6);
    EXPECT_DOUBLE_EQ(ring->points[0].time, 200e-6);
    EXPECT_EQ(ring->points[0].level, -60);
    EXPECT_EQ(ring->points[0].scatter, 4);
    EXPECT_EQ(ring->points[0].lasting, 2);
    EXPECT_EQ(ring->points[1].level, -80.5);
    EXPECT_EQ(ring->points[1].scatter, 0);
    EXPECT_THAT(ring->bearings, ElementsAre(0.5, 1, -1.7));
    EXPECT_EQ(read_ring_down("none"), nullptr);
}

TEST(ReceiverNotation, WhatIsWrongIsNamedWithItsPlaceAndHowToWriteIt) {
    EXPECT_THAT(ring_fault("0.2: -60, 0.1: -80"),
                AllOf(HasSubstr("later than the one before"), HasSubstr("\"none\"")));
    EXPECT_THAT(ring_fault("0.2 -60"), AllOf(HasSubstr("expected \":\""), HasSubstr("character 5")));
    EXPECT_THAT(ring_fault("0.2: 60"), HasSubstr("must lie between -300 and 0"));
    EXPECT_THAT(ring_fault("0.2: -60 +-nan"), HasSubstr("a scatter in dB"));
    EXPECT_THAT(ring_fault("0.2: -60 bearings 1 2"), HasSubstr("expected the end"));
    EXPECT_THAT(ring_fault("0.2: -60; bearings 1"), HasSubstr("2 to 360 bearings"));
    EXPECT_THAT(ring_fault(""), HasSubstr("expected a time in ms"));
    EXPECT_THAT(ring_fault("pulse 0.05"), HasSubstr("expected \";\""));
    EXPECT_THAT(interference_fault("lines 130 % by 5 dB"), HasSubstr("between 0 and 100"));
    EXPECT_THAT(interference_fault("stripes 1"), HasSubstr("\"lines\", \"dashes\" or \"beams\""));
    EXPECT_THAT(interference_fault("beams 135-128 of 256 by 3 dB"), HasSubstr("the last beam"));
    EXPECT_THAT(interference_fault("beams 128-256 of 256 by 3 dB"), HasSubstr("the number of beams"));
    EXPECT_THAT(interference_fault("lines 13 % by 5"), HasSubstr("expected \"dB\""));
}

TEST(ReceiverNotation, Interference) {
    const auto rule = read_interference(
        "lines 13 % by 5 +-2 dB; dashes 9 per s at 118 +-6 dB; beams 128-135 of 256 by 3.9 dB; "
        "beams 0-0 of 256 by 2 dB");
    EXPECT_DOUBLE_EQ(rule->lines, 0.13);
    EXPECT_EQ(rule->lift, 5);
    EXPECT_EQ(rule->lift_spread, 2);
    EXPECT_EQ(rule->dashes, 9);
    EXPECT_EQ(rule->dash_level, 118);
    EXPECT_EQ(rule->dash_spread, 6);
    ASSERT_EQ(rule->stripes.size(), 2U);
    EXPECT_EQ(rule->stripes[0].first, 0.5);
    EXPECT_EQ(rule->stripes[0].last, 136 / 256.0);
    EXPECT_EQ(read_interference("none"), nullptr);
}

}  // namespace
}  // namespace echoloop::test
