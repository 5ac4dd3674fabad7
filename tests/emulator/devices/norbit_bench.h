// A Norbit WBMS on the bench: literal commands, and packets read by the document's offsets.
#pragma once

#include <gmock/gmock.h>

#include <bit>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {

using namespace std::chrono_literals;

enum Ports : std::size_t { commands, bathymetry, water_column };

inline std::uint64_t number_at(const Bytes& b, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | b.at(at + i);
    return value;
}
inline std::uint32_t u32(const Bytes& b, std::size_t at) {
    return static_cast<std::uint32_t>(number_at(b, at, 4));
}
inline int u16(const Bytes& b, std::size_t at) { return static_cast<int>(number_at(b, at, 2)); }
inline float f32(const Bytes& b, std::size_t at) { return std::bit_cast<float>(u32(b, at)); }
inline double f64(const Bytes& b, std::size_t at) { return std::bit_cast<double>(number_at(b, at, 8)); }

inline Bench norbit(const Options& changes = {}) { return Bench(make_device("norbit-wbms", {}, changes)); }

inline Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

inline constexpr Address host{0x7F000001, 40000}, other_host{0x7F000001, 40001};

/// The answer to a command with a line's end; everything else that was sent is forgotten.
inline std::string ask(Bench& bench, const std::string& command, Address from = host) {
    bench.sent();
    bench.say(bytes_of(command + "\r\n"), commands, from);
    for (const Send& send : bench.sent())
        if (send.port == commands && send.to == from) return {send.bytes.begin(), send.bytes.end()};
    return "";
}

inline std::vector<Bytes> packets(Bench& bench, std::size_t port) {
    std::vector<Bytes> found;
    for (const Send& send : bench.sent())
        if (send.port == port) found.push_back(send.bytes);
    return found;
}

}  // namespace echoloop::test
