// Words of a Wayfinder and its host, made and read at the offsets of the maker's public driver, never by the
// project's codec.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <numeric>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test::wayfinder {

inline unsigned u16(const Bytes& b, std::size_t at) { return b.at(at) + 256U * b.at(at + 1); }
inline unsigned sum_of(const Bytes& b, std::size_t from, std::size_t to) {
    return std::accumulate(b.begin() + static_cast<std::ptrdiff_t>(from),
                           b.begin() + static_cast<std::ptrdiff_t>(to), 0U) &
           0xFFFF;
}
inline float f32(const Bytes& b, std::size_t at) {
    float value = 0;
    std::memcpy(&value, b.data() + at, 4);
    return value;
}
inline void append(Bytes& bytes, const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }
inline Bytes word(unsigned value, int size) {
    Bytes out;
    for (int i = 0; i < size; ++i) out.push_back(static_cast<std::uint8_t>(value >> 8 * i));
    return out;
}
inline Bytes number(float value) {
    Bytes out(4);
    std::memcpy(out.data(), &value, 4);
    return out;
}

/// A packet of that kind around `payload`.
inline Bytes packet(std::uint8_t kind, const Bytes& payload) {
    Bytes out{0xAA, 0x10, 0x01};
    append(out, word(static_cast<unsigned>(payload.size()) + 11, 2));
    append(out, {0x02, kind});
    append(out, word(static_cast<unsigned>(payload.size()) + 4, 2));
    append(out, payload);
    append(out, word(sum_of(out, 0, out.size()), 2));
    return out;
}
inline Bytes command(unsigned id, const Bytes& parameters = {}) {
    Bytes payload = word(id, 4);
    append(payload, parameters);
    return packet(3, payload);
}
inline Bytes setup(int trigger, int baud, float speed, float range) {
    Bytes out{0x22, 0x11, 20, 0, 0, 0, static_cast<std::uint8_t>(trigger), static_cast<std::uint8_t>(baud)};
    for (const float value : {speed, range, 0.0F}) append(out, number(value));
    return out;
}

inline constexpr unsigned stop = 0x0F, start = 0x10, trigger = 0x11, defaults = 0x17,
                          get_features = 0x10000001, get_tests = 0x19000001, get_time = 0x1D000001,
                          set_time = 0x1F000002, get_system = 0x81000001, get_components = 0x81000003,
                          get_setup = 0x85000001, set_speed = 0x86000003, set_setup = 0x87000002;

/// Payloads of one kind out of what was sent; every sum and size is right.
inline std::vector<Bytes> payloads(const std::vector<Send>& sent, std::uint8_t kind) {
    std::vector<Bytes> out;
    for (const Send& send : sent) {
        const Bytes& b = send.bytes;
        EXPECT_EQ(to_hex(Bytes(b.begin(), b.begin() + 3)), "aa1001");
        EXPECT_EQ(u16(b, 3), b.size());
        EXPECT_EQ(b.at(5), 2);
        EXPECT_EQ(u16(b, 7), b.size() - 7);
        EXPECT_EQ(u16(b, b.size() - 2), sum_of(b, 0, b.size() - 2));
        if (b[6] == kind) out.emplace_back(b.begin() + 9, b.end() - 2);
    }
    return out;
}

/// A ping's data.
struct Data {
    std::array<float, 4> velocity{}, range{};
    float mean = 0, speed = 0;
    Bytes bytes;
};
inline std::vector<Data> read_data(const std::vector<Send>& sent) {
    std::vector<Data> out;
    for (const Bytes& b : payloads(sent, 5)) {
        EXPECT_EQ(b.size(), 87U);
        EXPECT_EQ(to_hex(Bytes(b.begin(), b.begin() + 8)), "aa11570000004c00");
        EXPECT_EQ(u16(b, 85), sum_of(b, 0, 85));
        Data data;
        for (std::size_t i = 0; i < 4; ++i) {
            data.velocity[i] = f32(b, 21 + 4 * i);
            data.range[i] = f32(b, 37 + 4 * i);
        }
        data.mean = f32(b, 53);
        data.speed = f32(b, 57);
        data.bytes = b;
        out.push_back(data);
    }
    return out;
}

}  // namespace echoloop::test::wayfinder
