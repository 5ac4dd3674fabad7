// What the tests of the Surveyor 240-16 share: frames as hosts send them and a look at replies by the offsets
// of the published definitions, without the project's own codec.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <numeric>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
using namespace std::chrono_literals;

inline constexpr int ack = 1, nack = 2, utc_request = 14, water_stats = 118, attitude_report = 504,
                     yz_points = 3011, atof_points = 3012, ping_parameters = 3023;
inline constexpr std::size_t tcp = 0, udp = 1;
inline constexpr Address host{0x7F000001, 40000};

inline std::uint64_t number_at(const Bytes& b, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | b.at(at + i);
    return value;
}
inline int u16(const Bytes& b, std::size_t at) { return static_cast<int>(number_at(b, at, 2)); }
inline std::uint32_t u32(const Bytes& b, std::size_t at) {
    return static_cast<std::uint32_t>(number_at(b, at, 4));
}
inline float f32(const Bytes& b, std::size_t at) { return std::bit_cast<float>(u32(b, at)); }

inline std::string le(std::uint64_t value, std::size_t size) {
    Bytes bytes;
    for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i));
    return to_hex(bytes);
}
inline std::string le(float value) { return le(std::bit_cast<std::uint32_t>(value), 4); }

/// Payload in hex to a frame from host 0 to device 0.
inline Bytes frame(int id, const std::string& payload = "") {
    const Bytes content = from_hex(payload);
    Bytes bytes = from_hex("4252" + le(content.size(), 2) + le(static_cast<std::uint64_t>(id), 2) + "0000");
    bytes.insert(bytes.end(), content.begin(), content.end());
    const Bytes sum = from_hex(le(std::accumulate(bytes.begin(), bytes.end(), 0U), 2));
    bytes.insert(bytes.end(), sum.begin(), sum.end());
    return bytes;
}

/// set_ping_parameters; what a test does not name has the value that hosts usually send.
struct Set {
    int start = 0, end = 10000;  // mm
    float sound_speed = 1500;
    int gain = -1, period = 100;
    int injected = 0;
    bool enable = true, raw = false, yz = false, atof = true;
    int hz = 240000, steps = 400;
    float pulse = 1.5F;
};

inline Bytes frame(const Set& set) {
    const auto i32 = [](int value) { return le(static_cast<std::uint32_t>(value), 4); };
    const auto i16 = [](int value) { return le(static_cast<std::uint16_t>(value), 2); };
    const auto flag = [](int value) { return le(static_cast<std::uint8_t>(value), 1); };
    return frame(ping_parameters, i32(set.start) + i32(set.end) + le(set.sound_speed) + i16(set.gain) +
                                      i16(set.period) + "0000" + flag(set.injected) + flag(set.enable) +
                                      "00" + flag(set.raw) + flag(set.yz) + flag(set.atof) + i32(set.hz) +
                                      i16(set.steps) + "0000" + le(set.pulse));
}

inline Bench surveyor(const Options& changes = {}) {
    return Bench(make_device("surveyor240", {"tcp-listen://127.0.0.1:62312", "udp-listen://127.0.0.1:62312"},
                             changes));
}

/// The shot of the first ping after these settings.
inline Shot shot_of(const Set& settings, const Options& changes = {}) {
    Bench bench = surveyor(changes);
    bench.say(frame(settings));
    bench.run_to(bench.now);
    EXPECT_TRUE(bench.ping);
    return bench.ping ? bench.ping->shot : Shot{};
}

inline std::vector<Send> of_id(const std::vector<Send>& sent, int id) {
    std::vector<Send> found;
    for (const Send& s : sent)
        if (u16(s.bytes, 4) == id) found.push_back(s);
    return found;
}

/// Echoes so many metres away, by 1500 m/s, in every direction.
inline void place_echo(Bench& bench, const Shot& shot, double metres, float power = 1e13F) {
    bench.echo_bin = static_cast<std::size_t>((2 * metres / 1500 - shot.first_bin_time) / shot.bin_interval);
    bench.echo_power = power;
}

}  // namespace echoloop::test
