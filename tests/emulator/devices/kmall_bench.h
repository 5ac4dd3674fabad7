// A Kongsberg multibeam on the bench, and what stands at the offsets of its datagrams. Offsets are those of
// the specification notes on KMALL.
#pragma once

#include <gtest/gtest.h>

#include <bit>

#include "tests/emulator/devices/driver.h"
#include "tests/emulator/devices/noisy_line.h"
#include "tests/emulator/devices/seabed_echo.h"

namespace echoloop::test {

using namespace std::chrono_literals;

template <class T>
T at(const Bytes& b, std::size_t offset) {
    T value;
    std::copy_n(b.begin() + static_cast<std::ptrdiff_t>(offset), sizeof value,
                reinterpret_cast<std::uint8_t*>(&value));
    return value;
}
inline std::uint16_t u16(const Bytes& b, std::size_t offset) { return at<std::uint16_t>(b, offset); }
inline float f32(const Bytes& b, std::size_t offset) { return at<float>(b, offset); }
inline std::string type(const Send& send) { return {send.bytes.begin() + 4, send.bytes.begin() + 8}; }

/// Without the datagrams of its sensors, unless the test is about them.
inline Bench sounder(Options changes = {}, const std::vector<std::string>& endpoints = {}) {
    changes.try_emplace("sensor_datagrams", false);
    return Bench(make_device("kongsberg-kmall", endpoints, changes));
}
inline Bytes text(const std::string& t) { return {t.begin(), t.end()}; }
inline std::vector<Send> of_type(const std::vector<Send>& sent, const std::string& wanted) {
    std::vector<Send> found;
    for (const Send& send : sent)
        if (type(send) == wanted) found.push_back(send);
    return found;
}

/// Version 3 (as 2) with one sector: header 20, partition 4, body 12, ping info 152, sector 48, rx info 32.
inline constexpr std::size_t ping = 36, rx = ping + 152 + 48, first = rx + 32;

/// Of all soundings of an #MRZ, which begin at `soundings`.
inline std::size_t image_samples(const Bytes& b, std::size_t soundings = first, std::size_t count = 400) {
    std::size_t sum = 0;
    for (std::size_t n = 0; n < count; ++n) sum += u16(b, soundings + n * 120 + 118);
    return sum;
}

}  // namespace echoloop::test
