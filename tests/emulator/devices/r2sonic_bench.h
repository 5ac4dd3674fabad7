// What the Sonic's tests share: commands as hosts send them and a look at datagrams by the offsets of the
// R2Sonic notes, without the project's own codec.
#pragma once

#include <bit>
#include <cmath>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
using namespace std::chrono_literals;

inline constexpr Address gui{0x7F000001, 65400};

inline std::uint32_t u32(const Bytes& b, std::size_t at) {
    return std::uint32_t{b.at(at)} << 24 | b.at(at + 1) << 16 | b.at(at + 2) << 8 | b.at(at + 3);
}
inline std::uint16_t u16(const Bytes& b, std::size_t at) {
    return static_cast<std::uint16_t>(b.at(at) << 8 | b.at(at + 1));
}
inline float f32(const Bytes& b, std::size_t at) { return std::bit_cast<float>(u32(b, at)); }
inline std::string name(const Bytes& b, std::size_t at, std::size_t size) {
    return {b.begin() + at, b.begin() + at + size};
}

inline void put(Bytes& out, std::uint32_t word) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(word >> shift));
}
inline void put(Bytes& out, const std::string& text, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
        out.push_back(i < text.size() ? static_cast<std::uint8_t>(text[i]) : 0);
}

inline Bytes command(const std::string& what, std::uint32_t value) {
    Bytes bytes;
    put(bytes, "CMD0", 4);
    put(bytes, what, 4);
    put(bytes, value);
    return bytes;
}
inline Bytes command(const std::string& what, float value) {
    return command(what, std::bit_cast<std::uint32_t>(value));
}

inline std::vector<Send> named(const std::vector<Send>& sent, const std::string& packet) {
    std::vector<Send> found;
    for (const Send& s : sent)
        if (name(s.bytes, 0, 4) == packet) found.push_back(s);
    return found;
}

/// A head that hangs from a vehicle with its port side `roll` rad up and its nose `pitch` rad down.
inline Echogram hanging(const Shot& shot, double roll, double pitch) {
    Echogram e = echo_of(shot, 99999, 0);
    e.world_from_sonar = {{0, 0, -7}, from_rpy(roll, pitch, 0) * from_rpy(0, deg_to_rad(90), 0)};
    return e;
}

/// Where a SIM hears commands: behind the head's ports, which are commands, discovery and five of products.
inline constexpr std::size_t sim_port = 7;

inline Bench head(const Options& changes = {}, std::vector<std::string> endpoints = {}) {
    return Bench(make_device("r2sonic-2024", std::move(endpoints), changes));
}

}  // namespace echoloop::test
