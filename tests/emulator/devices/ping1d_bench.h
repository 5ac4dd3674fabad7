// A Ping1D on the bench, and the frames of the published definitions that its tests send and read by their
// offsets.
#pragma once

#include <gtest/gtest.h>

#include <numeric>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {

inline int u16(const Bytes& bytes, std::size_t at) { return bytes.at(at) | bytes.at(at + 1) << 8; }
inline long u32(const Bytes& bytes, std::size_t at) { return u16(bytes, at) + 65536L * u16(bytes, at + 2); }

/// Payload in hex to a frame from host 0 to device 1, as one autopilot sends them.
inline Bytes frame(int id, const std::string& payload = "") {
    Bytes bytes{'B', 'R', 0, 0, static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id >> 8), 0, 1};
    const Bytes content = from_hex(payload);
    bytes[2] = static_cast<std::uint8_t>(content.size());
    bytes.insert(bytes.end(), content.begin(), content.end());
    const int sum = std::accumulate(bytes.begin(), bytes.end(), 0);
    bytes.push_back(static_cast<std::uint8_t>(sum));
    bytes.push_back(static_cast<std::uint8_t>(sum >> 8));
    return bytes;
}

inline const Bytes manual = frame(1003, "00");
inline const Bytes ten_metres = frame(1001, "0000000010270000");

inline Bench ping1d(const Options& changes = {}) { return Bench(make_device("ping1d", {}, changes)); }

inline Bytes answer(Bench& bench, const Bytes& question) {
    bench.sent();
    bench.say(question);
    const auto sent = bench.sent();
    EXPECT_EQ(sent.size(), 1u);
    return sent.empty() ? Bytes(64) : sent[0].bytes;
}

inline std::vector<int> ids(const std::vector<Send>& sent) {
    std::vector<int> found;
    for (const Send& s : sent) found.push_back(u16(s.bytes, 4));
    return found;
}

}  // namespace echoloop::test
