// An Oculus on the bench: messages laid out by hand and read by the offsets of the specification, never by
// the project's codec.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {

using namespace std::chrono_literals;

template <class T>
T at(const Bytes& bytes, std::size_t offset) {
    T value{};
    if (offset + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

template <class T>
void put(Bytes& bytes, T value) {
    const auto raw = std::bit_cast<std::array<std::uint8_t, sizeof value>>(value);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

struct Wish {
    int mode = 1, rate = 0, speed = 255, gamma = 255, flags = 0x09;
    double range = 10, gain = 50, sound_speed = 1500, salinity = 35;
    std::uint32_t ext_flags = 0;
};

inline Bytes fire(const Wish& w, bool v2 = false) {
    Bytes bytes = from_hex(v2 ? "534f0000000015000200490000000000" : "534f0000000015000000250000000000");
    for (const int byte : {w.mode, w.rate, w.speed, w.gamma, w.flags})
        put(bytes, static_cast<std::uint8_t>(byte));
    for (const double number : {w.range, w.gain, w.sound_speed, w.salinity}) put(bytes, number);
    if (v2) put(bytes, w.ext_flags), bytes.resize(89);
    return bytes;
}

inline bool is_result(const Send& send) { return send.port == 0 && at<std::uint16_t>(send.bytes, 6) == 0x23; }
inline bool is_dummy(const Send& send) { return to_hex(send.bytes) == "534fe9030000ff000000000000000000"; }

/// A result by the offsets of its version.
struct Seen {
    Bytes bytes;
    bool v2;
    explicit Seen(Bytes b) : bytes(std::move(b)), v2(at<std::uint16_t>(bytes, 8) == 2) {}

    template <class T>
    T get(std::size_t v1_offset, std::size_t v2_offset) const {
        return at<T>(bytes, v2 ? v2_offset : v1_offset);
    }
    std::uint32_t ping() const { return get<std::uint32_t>(53, 89); }
    double sound_speed() const { return get<double>(85, 145); }
    std::size_t sample_bytes() const { return get<std::uint8_t>(97, 161) + 1U; }
    double resolution() const { return get<double>(98, 162); }
    std::size_t ranges() const { return get<std::uint16_t>(106, 170); }
    std::size_t beams() const { return get<std::uint16_t>(108, 172); }
    std::size_t image_offset() const { return get<std::uint32_t>(110, 190); }
    std::size_t image_size() const { return get<std::uint32_t>(114, 194); }
    std::int16_t bearing(std::size_t i) const { return at<std::int16_t>(bytes, (v2 ? 202 : 122) + 2 * i); }
    bool gain_words() const { return (bytes[20] & 4) != 0; }
    std::size_t row_at(std::size_t row) const {
        return image_offset() + row * (beams() * sample_bytes() + (gain_words() ? 4 : 0));
    }
    std::uint32_t gain_word(std::size_t row) const { return at<std::uint32_t>(bytes, row_at(row)); }
    double sample(std::size_t row, std::size_t beam) const {
        const std::size_t offset = row_at(row) + (gain_words() ? 4 : 0) + beam * sample_bytes();
        if (sample_bytes() == 1) return bytes.at(offset);
        return sample_bytes() == 2 ? at<std::uint16_t>(bytes, offset) : at<std::uint32_t>(bytes, offset);
    }
};

struct OculusBench : Bench {
    explicit OculusBench(const Options& changes = {}, const std::string& model = "oculus-m1200d")
        : Bench(make_device(model, {}, changes)) {
        device().reconnected(0);
        device().connected(0, {0x7F000001, 40000}, now);
    }
    /// The next result after `bytes`.
    Seen next_after(const Bytes& bytes) {
        say(bytes);
        return next();
    }
    Seen next() {
        for (const Time end = now + 5s; now < end; run_to(now + 1ms))
            for (Send& send : sent())
                if (is_result(send)) return Seen(std::move(send.bytes));
        ADD_FAILURE() << "no result";
        return Seen({});
    }
    std::vector<Send> sent_within(Time time) {
        run_to(now + time);
        return sent();
    }
};

inline std::size_t count(const std::vector<Send>& sends, bool (*what)(const Send&)) {
    return static_cast<std::size_t>(std::count_if(sends.begin(), sends.end(), what));
}

}  // namespace echoloop::test
