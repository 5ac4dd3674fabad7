// MAVLink frames of both versions, written by pymavlink 2.4 (system 7, component 9), read field by field;
// noise, damage and messages of other kinds between them.
#include <gtest/gtest.h>

#include <string>

#include "protocols/mavlink/codec.h"
#include "protocols/mavlink/framer.h"

namespace echoloop::mavlink {
namespace {

// LOCAL_POSITION_NED: 1001 ms, 1.5 m north, -2.25 m east, 9 m down, 0.5 m/s north.
const std::string position1 = "fe1c00070920e90300000000c03f000010c0000010410000003f00000000000000008a87";
const std::string position2 = "fd140000000709200000e90300000000c03f000010c0000010410000003f76d3";
const std::string heartbeat1 = "fe0900070900000000000c03000403703a";
const std::string heartbeat2 = "fd090000000709000000000000000c0300040366b9";
const std::string attitude2 = "fd1000000007091e0000e80300000000003f000080be000040408c55";

wire::Bytes from_hex(const std::string& hex) {
    wire::Bytes bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    return bytes;
}

std::vector<Frame> frames(wire::ByteView bytes, std::size_t piece = 1000) {
    Framer framer;
    std::vector<Frame> all;
    while (!bytes.empty()) {
        framer.feed(bytes.first(std::min(piece, bytes.size())));
        bytes = bytes.subspan(std::min(piece, bytes.size()));
        while (auto frame = framer.next()) all.push_back(*std::move(frame));
    }
    return all;
}

TEST(MavlinkChecksum, IsThePublishedOne) {
    const std::string digits =
        "12345678";  // CRC-16/MCRF4XX of "123456789" is 0x6F91; the seed is its last byte
    const wire::ByteView bytes(reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size());
    EXPECT_EQ(checksum(bytes, '9'), 0x6F91);
}

TEST(MavlinkFramer, ReadsBothVersionsInPiecesOfAnySize) {
    for (const auto& hex : {position1, position2})
        for (std::size_t piece = 1; piece < 40; ++piece) {
            const auto found = frames(from_hex(hex + hex), piece);
            ASSERT_EQ(found.size(), 2U);
            EXPECT_EQ(found[0].system, 7);
            EXPECT_EQ(found[0].component, 9);
            EXPECT_EQ(found[0].version, hex == position1 ? 1 : 2);
            const auto m = std::get<LocalPositionNed>(parse(found[0]).value());
            EXPECT_EQ(m.time_boot_ms, 1001U);
            EXPECT_EQ(m.x, 1.5F);
            EXPECT_EQ(m.y, -2.25F);
            EXPECT_EQ(m.z, 9);
            EXPECT_EQ(m.vx, 0.5F);
            EXPECT_EQ(m.vz, 0);  // version 2 has cut it off
        }
}

TEST(MavlinkFramer, PassesOverOtherMessagesWithoutCallingThemNoise) {
    Framer framer;
    framer.feed(from_hex(heartbeat1 + position1 + heartbeat2 + attitude2));
    EXPECT_EQ(framer.next()->id, 32U);
    const auto attitude = std::get<Attitude>(parse(framer.next().value()).value());
    EXPECT_EQ(attitude.roll, 0.5F);
    EXPECT_EQ(attitude.pitch, -0.25F);
    EXPECT_EQ(attitude.yaw, 3);
    EXPECT_EQ(framer.skipped_bytes(), 0U);
}

TEST(MavlinkFramer, ADamagedFrameCostsItselfOnly) {
    const wire::Bytes good = from_hex(position1 + attitude2);
    for (std::size_t i = 0; i < position1.size() / 2; ++i) {
        wire::Bytes bytes = good;
        bytes[i] ^= 0x41;
        const auto found = frames(bytes);
        ASSERT_EQ(found.size(), 1U) << i;
        EXPECT_EQ(found[0].id, 30U) << i;
    }
}

TEST(MavlinkFramer, NoiseThatLooksLikeABeginningHoldsNothingUp) {
    for (const std::string noise : {"fe", "fd", "fefd", "feffffffffffff", "fdff000000000000ff00"}) {
        const auto found = frames(from_hex(noise + position2));
        ASSERT_EQ(found.size(), 1U) << noise;
    }
}

TEST(MavlinkFramer, HalfAFrameIsNone) {
    const auto bytes = from_hex(position2);
    for (std::size_t n = 0; n < bytes.size(); ++n)
        EXPECT_TRUE(frames(wire::ByteView(bytes).first(n)).empty()) << n;
}

TEST(MavlinkCodec, WhatALaterDefinitionAddsIsPassedOver) {
    Frame frame{2, 0, 7, 9, 31, wire::Bytes(48, 0)};  // ATTITUDE_QUATERNION with its extension of 16 bytes
    EXPECT_TRUE(std::holds_alternative<AttitudeQuaternion>(parse(frame).value()));
    frame.payload.clear();
    EXPECT_EQ(std::get<AttitudeQuaternion>(parse(frame).value()).q[0], 0);
    frame.id = 0;
    EXPECT_FALSE(parse(frame));
}

}  // namespace
}  // namespace echoloop::mavlink
