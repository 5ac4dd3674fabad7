// A Ping360 on the bench, and the frames of the published definitions that its tests send and read by their
// offsets.
#pragma once

#include <numeric>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {

inline int u16(const Bytes& bytes, std::size_t at) { return bytes.at(at) | bytes.at(at + 1) << 8; }

/// Payload in hex to a frame from host 0 to device 0.
inline Bytes frame(int id, const std::string& payload = "") {
    Bytes bytes{'B', 'R', 0, 0, static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id >> 8), 0, 0};
    const Bytes content = from_hex(payload);
    bytes[2] = static_cast<std::uint8_t>(content.size());
    bytes.insert(bytes.end(), content.begin(), content.end());
    const int sum = std::accumulate(bytes.begin(), bytes.end(), 0);
    bytes.push_back(static_cast<std::uint8_t>(sum));
    bytes.push_back(static_cast<std::uint8_t>(sum >> 8));
    return bytes;
}

inline std::string le16(int value) {
    const Bytes bytes{static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8)};
    return to_hex(bytes);
}

// 2 m: 11 us, 88 ticks, 750 kHz, 1200 samples
inline const std::string two_metres = "0b005800ee02b004";
inline Bytes transducer(int angle, const std::string& settings = two_metres, int transmit = 1) {
    return frame(2601, "0000" + le16(angle) + settings + (transmit ? "0100" : "0000"));
}
inline Bytes auto_transmit(int start, int stop, int step, int delay = 0) {
    const Bytes tail{static_cast<std::uint8_t>(step), static_cast<std::uint8_t>(delay)};
    return frame(2602, "0100" + two_metres + le16(start) + le16(stop) + to_hex(tail));
}
inline const Bytes motor_off = frame(2903);

inline Bench ping360(const Options& changes = {}) { return Bench(make_device("ping360", {}, changes)); }

inline std::vector<int> ids(const std::vector<Send>& sent) {
    std::vector<int> found;
    for (const Send& s : sent) found.push_back(u16(s.bytes, 4));
    return found;
}

inline std::vector<int> angles(const std::vector<Send>& sent) {
    std::vector<int> found;
    for (const Send& s : sent)
        if (u16(s.bytes, 4) == 2300 || u16(s.bytes, 4) == 2301) found.push_back(u16(s.bytes, 10));
    return found;
}

}  // namespace echoloop::test
