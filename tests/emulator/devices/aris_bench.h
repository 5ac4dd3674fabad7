// An ARIS on the bench: commands as literal bytes, frames put together and read by the offsets of the
// specification, never by the project's codec.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <optional>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {

using namespace std::chrono_literals;

namespace aris_words {
/// Port 56444 of whoever is connected.
inline const std::string receiver = "00000008 0801 1a04 08fcb803";
inline const std::string nobody = "0000000d 0801 1a09 1207 302e302e302e30";
inline const std::string ping = "00000005 080e 820100";
inline const std::string salt = "00000006 0804 3202 0823";
inline const std::string brackish = "00000006 0804 3202 080f";
inline const std::string telephoto = "00000006 0805 3a02 0801";
inline const std::string focus_4_m = "00000009 0806 4205 1500008040";
inline const std::string focus_10_m = "00000009 0806 4205 1500002041";
inline const std::string home_focus = "00000004 0808 5200";
/// Cookie 7, mode 3, 15 frames a second, 1014 samples, 2028 us, 10500 us, 8 us, pulse 11, 18 dB.
inline const std::string acoustics =
    "00000025 0803 2a21 0807 1500007041 18f607 20ec0f 288452 3008 380b 4003 4801 5001 5801 6500009041";
/// Cookie 8, mode 1, the same times, low frequency, no 150 V, 6 dB.
inline const std::string mode_1 =
    "00000021 0803 2a1d 0808 1500007041 18f607 20ec0f 288452 3008 380b 4001 4801 650000c040";
/// As `acoustics` with mode 6, for an ARIS 3000.
inline const std::string mode_6 =
    "00000025 0803 2a21 0807 1500007041 18f607 20ec0f 288452 3008 380b 4006 4801 5001 5801 6500009041";
/// Cookie 9, 10 frames a second, 500 samples of 4 us, cycle 4500 us, pulse 80.
inline const std::string long_pulse =
    "00000025 0803 2a21 0809 1500002041 18f403 20ec0f 289423 3004 3850 4003 4801 5001 5801 6500009041";
/// As `acoustics` with cookie 10 and 1015 samples, for which a cycle has no time.
inline const std::string too_long =
    "00000025 0803 2a21 080a 1500007041 18f707 20ec0f 288452 3008 380b 4003 4801 5001 5801 6500009041";
}  // namespace aris_words

/// Protobuf by hand: fields by number, the last of several.
struct Fields {
    std::map<std::uint64_t, std::uint64_t> numbers;
    std::map<std::uint64_t, Bytes> blocks;

    explicit Fields(const Bytes& bytes) {
        for (std::size_t at = 0; at < bytes.size();) {
            const std::uint64_t key = number(bytes, at);
            if (key % 8 == 0) {
                numbers[key / 8] = number(bytes, at);
            } else if (key % 8 == 5) {
                at += 4;
            } else {
                const std::uint64_t size = number(bytes, at);
                const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(at);
                blocks[key / 8].assign(from, from + static_cast<std::ptrdiff_t>(size));
                at += size;
            }
        }
    }
    static std::uint64_t number(const Bytes& bytes, std::size_t& at) {
        std::uint64_t value = 0;
        for (int shift = 0;; shift += 7) {
            const std::uint8_t byte = bytes.at(at++);
            value |= std::uint64_t{byte & 0x7FU} << shift;
            if (byte < 0x80) return value;
        }
    }
};

/// Of the sonar: 0 available, 1 busy.
inline std::uint64_t state(const Send& beacon) { return Fields(beacon.bytes).numbers[4]; }

/// A whole frame.
struct ArisFrame {
    std::uint64_t number = 0;
    Bytes header, data;
    std::vector<Time> times;  ///< when each part may go
    Address to;

    template <class T>
    T at(std::size_t offset) const {
        T value{};
        if (offset + sizeof value <= header.size()) std::memcpy(&value, header.data() + offset, sizeof value);
        return value;
    }
    std::uint32_t word(std::size_t offset) const { return at<std::uint32_t>(offset); }
};

struct ArisBench : Bench {
    explicit ArisBench(const Options& changes = {}, const std::string& model = "aris-1800",
                       std::vector<std::string> endpoints = {})
        : Bench(make_device(model, std::move(endpoints), changes)) {
        connect_anew();
    }
    void connect_anew(Address controller = {0x7F000001, 40000}) {
        device().reconnected(0);
        connect(0, controller);
    }

    /// Frames put together from what has been sent since the last call; each part must follow the one before.
    std::vector<ArisFrame> frames() {
        std::vector<ArisFrame> out;
        for (Send& send : sent()) {
            if (send.port != 2) continue;
            Fields part(send.bytes);
            EXPECT_LE(send.bytes.size(), 1500U);
            if (part.numbers[5] == 0) out.push_back({part.numbers[1], part.blocks[3], {}, {}, send.to});
            if (out.empty()) continue;
            ArisFrame& frame = out.back();
            EXPECT_EQ(part.numbers[1], frame.number);
            EXPECT_EQ(part.numbers[5], frame.data.size()) << "parts follow one another";
            frame.data.insert(frame.data.end(), part.blocks[4].begin(), part.blocks[4].end());
            EXPECT_LE(frame.data.size(), part.numbers[2]);
            frame.times.push_back(send.not_before);
        }
        return out;
    }
    std::vector<ArisFrame> frames_within(Time time) {
        sent();
        run_to(now + time);
        return frames();
    }
    std::vector<Send> beacons_within(Time time) {
        sent();
        run_to(now + time);
        std::vector<Send> out;
        for (Send& send : sent())
            if (send.port == 1) out.push_back(std::move(send));
        return out;
    }
};

}  // namespace echoloop::test
