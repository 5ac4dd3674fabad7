// What waits to go out: when it goes, how much of it may wait, and what is left of it for the next driver.
#include "emulator/run/outbox.h"

#include <gtest/gtest.h>

namespace echoloop {
namespace {

Mail mail(std::size_t port, Bytes bytes, double due) {
    Send send;
    send.port = port, send.bytes = std::move(bytes), send.not_before = from_seconds(due);
    return {std::move(send), 0, ""};
}

std::vector<std::uint8_t> first_bytes(Outbox& outbox) {
    std::vector<std::uint8_t> all;
    while (!outbox.empty()) all.push_back(outbox.take_first().send.bytes.at(0));
    return all;
}

TEST(Outbox, GoesOutByTimeAndOfOneTimeAsItWasSaid) {
    Outbox outbox(2);
    for (const auto& [byte, due] :
         std::vector<std::pair<std::uint8_t, double>>{{1, 2}, {2, 1}, {3, 2}, {4, 1}})
        ASSERT_NE(outbox.post(mail(byte % 2, {byte}, due), 0), nullptr);
    EXPECT_EQ(outbox.first_due(), from_seconds(1));
    EXPECT_EQ(first_bytes(outbox), (std::vector<std::uint8_t>{2, 4, 1, 3}));
}

TEST(Outbox, OfWhatWasSaidToADriverTheNextOneGetsNothing) {
    Outbox outbox(2);
    outbox.post(mail(0, {1, 1, 1}, 1), 0);
    outbox.post(mail(1, {2, 2}, 2), 0);
    outbox.post(mail(0, {3}, 3), 0);
    outbox.forget(0);
    EXPECT_EQ(outbox.messages(), 1U);
    EXPECT_EQ(outbox.bytes(), 2U);
    EXPECT_EQ(outbox.bytes_for(0), 0U);
    EXPECT_EQ(outbox.bytes_for(1), 2U);
    EXPECT_EQ(outbox.most_messages(), 3U);
    EXPECT_EQ(outbox.most_bytes(), 6U);
    EXPECT_EQ(first_bytes(outbox), std::vector<std::uint8_t>{2});
    EXPECT_EQ(outbox.bytes(), 0U);
}

// Of 9600 Bd, ten bits to a byte, are 1920 bytes in two seconds.
TEST(Outbox, ALineIsToldNoMoreThanItSaysInTwoSeconds) {
    Outbox outbox(2);
    ASSERT_NE(outbox.post(mail(0, Bytes(1920), 0), 9600), nullptr);
    EXPECT_NE(outbox.post(mail(0, {1}, 0), 9600), nullptr);
    EXPECT_EQ(outbox.post(mail(0, {1}, 0), 9600), nullptr);
    EXPECT_NE(outbox.post(mail(1, {1}, 0), 9600), nullptr) << "another line";
    EXPECT_NE(outbox.post(mail(0, {1}, 0), 0), nullptr) << "no line";
    EXPECT_EQ(outbox.messages(), 4U);
}

TEST(Outbox, WhatWaitsIsBounded) {
    constexpr std::size_t piece = 1 << 20;
    Outbox outbox(1);
    std::size_t taken = 0;
    while (taken < 100 && outbox.post(mail(0, Bytes(piece), 0), 0) != nullptr) ++taken;
    EXPECT_EQ(taken, 47U) << "48 MiB hold as many of a MiB and what is kept beside";
    outbox.take_first();
    EXPECT_NE(outbox.post(mail(0, Bytes(piece), 0), 0), nullptr) << "room for one again";
    EXPECT_EQ(outbox.post(mail(0, Bytes(piece), 0), 0), nullptr);
    outbox.clear();
    EXPECT_TRUE(outbox.empty());
    EXPECT_EQ(outbox.bytes() + outbox.bytes_for(0), 0U);
    EXPECT_NE(outbox.post(mail(0, Bytes(40 * piece), 0), 0), nullptr) << "nothing is left of what was there";
}

// Small messages take more for what is kept beside than for their bytes.
TEST(Outbox, SoAreManySmallMessages) {
    Outbox outbox(1);
    std::size_t taken = 0;
    while (taken < 1'000'000 && outbox.post(mail(0, {1}, 0), 0) != nullptr) ++taken;
    EXPECT_LT(taken, 1'000'000U);
    EXPECT_LT(outbox.bytes(), std::size_t{1} << 20);
}

}  // namespace
}  // namespace echoloop
