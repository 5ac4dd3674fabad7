// A Delta T on the bench: its 83P by the offsets of the specification, and EC by its bytes. Knows no codec.
#pragma once

#include <gtest/gtest.h>

#include "tests/emulator/devices/driver.h"
#include "tests/emulator/devices/seabed_echo.h"

namespace echoloop::test {

using namespace std::chrono_literals;

inline unsigned be(const Bytes& bytes, std::size_t at, std::size_t count = 2) {
    unsigned value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8 | bytes.at(at + i);
    return value;
}

inline std::string text_at(const Bytes& bytes, std::size_t at, std::size_t count) {
    return {bytes.begin() + static_cast<std::ptrdiff_t>(at),
            bytes.begin() + static_cast<std::ptrdiff_t>(at + count)};
}

/// Codes of an EC at their offsets; what is not named is 20 m, 120 deg, 240 normal beams, 1500 m/s.
inline Bytes control(const std::map<std::size_t, std::uint8_t>& changes = {}) {
    Bytes bytes(256, 0);
    bytes[0] = 'E', bytes[1] = 'C', bytes[3] = 1;
    bytes[7] = 4, bytes[8] = 3, bytes[11] = 3, bytes[12] = 1, bytes[13] = 1;
    bytes[17] = 0x3A, bytes[18] = 0x98;  // 15000
    bytes[25] = 180;
    for (const auto& [at, value] : changes) bytes.at(at) = value;
    return bytes;
}

inline Bench delta_t(const Options& changes = {}) {
    return Bench(make_device("imagenex-deltat", {}, changes));
}

/// The next 83P.
inline Bytes next_83p(Bench& bench, Time patience = 5s) {
    const Time end = bench.now + patience;
    while (bench.now < end) {
        bench.run_to(bench.now + 1ms);
        const auto sent = bench.sent();
        if (!sent.empty()) return sent.back().bytes;
    }
    return {};
}

/// The first 83P of a ping that goes out after what the host says.
inline Bytes answer(Bench& bench, const Bytes& word) {
    bench.say(word);
    next_83p(bench);
    return next_83p(bench);
}

/// Slant range of a beam in m at 1500 m/s; 0 if there is none.
inline double range_of(const Bytes& bytes, std::size_t beam) {
    return be(bytes, 256 + 2 * beam) * be(bytes, 85) / 1000.0;
}
/// rad, positive to starboard.
inline double angle_of(const Bytes& bytes, std::size_t beam) {
    const double hundredths = be(bytes, 76) + static_cast<double>(beam) * bytes.at(78);
    return deg_to_rad(hundredths / 100 - 180);
}

}  // namespace echoloop::test
