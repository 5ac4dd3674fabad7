// What the tests of the Omniscan 450 and the S500 share: frames as hosts send them, replies read by the
// offsets of the published definitions, without the project's own codec.
#pragma once

#include "tests/emulator/devices/noisy_line.h"
#include "tests/emulator/devices/surveyor240_bench.h"

namespace echoloop::test {

/// On TCP and on UDP.
inline Bench cerulean_sonar(const std::string& model, const Options& changes) {
    return Bench(
        make_device(model, {"tcp-listen://127.0.0.1:51200", "udp-listen://127.0.0.1:51200"}, changes));
}

/// os_ping_params; what a test does not name has the value that hosts usually send.
struct OmniscanParams {
    int start = 0, length = 15000, msec = 0;  // mm, ms
    float pulse = 0.002F, filter = 0.0015F;
    int gain = -1, results = 600, enable = 1;
    int reserved = 3;  // bytes at the end
};
inline Bytes frame(const OmniscanParams& p) {
    const auto u32 = [](int value) { return le(static_cast<std::uint32_t>(value), 4); };
    const auto u16 = [](int value) { return le(static_cast<std::uint16_t>(value), 2); };
    std::string payload = u32(p.start) + u32(p.length) + u32(p.msec) + "0000000000000000" + le(p.pulse) +
                          le(p.filter) + u16(p.gain) + u16(p.results) +
                          le(static_cast<std::uint8_t>(p.enable), 1);
    for (int i = 0; i < p.reserved; ++i) payload += "00";
    return frame(2197, payload);
}

/// set_ping_params of an S500.
struct S500Params {
    int start = 0, length = 7500;  // mm
    int gain = -1, msec = 100, pulse = 0, report = 1308, chirp = 0, decimation = 0;
};
inline Bytes frame(const S500Params& p) {
    const auto u32 = [](int value) { return le(static_cast<std::uint32_t>(value), 4); };
    const auto u16 = [](int value) { return le(static_cast<std::uint16_t>(value), 2); };
    const auto u8 = [](int value) { return le(static_cast<std::uint8_t>(value), 1); };
    return frame(1015, u32(p.start) + u32(p.length) + u16(p.gain) + u16(p.msec) + u16(p.pulse) +
                           u16(p.report) + "0000" + u8(p.chirp) + u8(p.decimation));
}

/// All datagrams put together, which a host of a byte stream sees.
inline Bytes joined(const std::vector<Send>& sent) {
    Bytes all;
    for (const Send& s : sent) all.insert(all.end(), s.bytes.begin(), s.bytes.end());
    return all;
}

/// The messages of an id in what was sent on a byte stream.
inline std::vector<Bytes> messages(const std::vector<Send>& sent, int id) {
    std::vector<Bytes> found;
    for (const Send& s : sent)
        if (u16(s.bytes, 4) == id) found.push_back(s.bytes);
    return found;
}

}  // namespace echoloop::test
