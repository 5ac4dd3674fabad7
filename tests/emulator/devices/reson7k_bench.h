// The 7k multibeam on the bench: commands laid out by hand, records read by the offsets of the specification,
// never by the project's codec.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <numeric>

#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
using namespace std::chrono_literals;

template <class T>
T at(const Bytes& bytes, std::size_t offset) {
    T value{};
    if (offset + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

inline void put(Bytes& bytes, std::size_t at, std::uint32_t value, std::size_t size = 4) {
    if (bytes.size() < at + size) bytes.resize(at + size);
    std::memcpy(bytes.data() + at, &value, size);
}

/// A whole 7500 in one packet: parameters are words.
inline Bytes control(std::uint32_t command, const std::vector<std::uint32_t>& parameters = {},
                     std::uint32_t device = 7125, std::uint32_t ticket = 77) {
    Bytes b(36 + 64 + 24);
    put(b, 36, 5, 2), put(b, 38, 60, 2), put(b, 40, 0xFFFF);
    put(b, 36 + 30, 1, 2), put(b, 36 + 32, 7500), put(b, 36 + 36, device), put(b, 36 + 48, 1, 2);
    put(b, 100, command), put(b, 104, ticket), put(b, 108, 0xABCD), put(b, 120, 0x1234);
    for (const std::uint32_t word : parameters) put(b, b.size(), word);
    if (parameters.empty()) b.push_back(0);
    const auto size = static_cast<std::uint32_t>(b.size() + 4 - 36);
    put(b, 44, size);
    put(b, b.size(), std::accumulate(b.begin() + 36, b.end(), 0U));
    put(b, 0, 5, 2), put(b, 2, 36, 2), put(b, 4, 1), put(b, 8, 1, 2), put(b, 10, 9, 2);
    put(b, 12, size + 36), put(b, 16, size);
    return b;
}
/// The same command with parameters of any size.
inline Bytes control_of_bytes(std::uint32_t command, const Bytes& parameters) {
    const std::size_t words = (parameters.size() + 3) / 4;
    Bytes b = control(command, std::vector<std::uint32_t>(words));
    b.resize(b.size() - 4 * words - 4);
    b.insert(b.end(), parameters.begin(), parameters.end());
    const auto size = static_cast<std::uint32_t>(b.size() + 4 - 36);
    put(b, 44, size), put(b, 12, size + 36), put(b, 16, size);
    put(b, b.size(), std::accumulate(b.begin() + 36, b.end(), 0U));
    return b;
}
/// A record of one float in one packet, as a host sends it that sets a loss.
inline Bytes record_of_float(std::uint32_t type, std::uint32_t word) {
    Bytes b = control(0);
    b.resize(36 + 64);
    put(b, 36 + 32, type), put(b, 100, word), put(b, 44, 72), put(b, 12, 108), put(b, 16, 72);
    put(b, b.size(), std::accumulate(b.begin() + 36, b.end(), 0U));
    return b;
}
inline std::uint32_t f32(double value) { return std::bit_cast<std::uint32_t>(static_cast<float>(value)); }

/// A record put together from its packets; offsets are those of the record.
struct Seen {
    Bytes bytes;
    Time sent{};
    std::size_t packets = 0;
    Address to;
    std::uint32_t type() const { return at<std::uint32_t>(bytes, 32); }
    template <class T>
    T get(std::size_t offset) const {
        return at<T>(bytes, 64 + offset);
    }
};

inline std::vector<Seen> records_of(const std::vector<Send>& sends) {
    std::vector<Seen> out;
    for (const Send& send : sends) {
        const Bytes& p = send.bytes;
        EXPECT_LE(p.size(), 60000U);
        EXPECT_EQ(at<std::uint32_t>(p, 12), p.size());
        if (at<std::uint32_t>(p, 20) == 0) out.push_back({{}, send.not_before, 0, send.to});
        Seen& record = out.back();
        EXPECT_EQ(at<std::uint32_t>(p, 20), record.packets++);
        record.bytes.insert(record.bytes.end(), p.begin() + 36, p.end());
        const bool last = at<std::uint32_t>(p, 4) == record.packets;
        EXPECT_EQ(last, record.bytes.size() == at<std::uint32_t>(p, 16));
    }
    for (const Seen& record : out) {
        const auto end = record.bytes.end() - 4;
        EXPECT_EQ(at<std::uint32_t>(record.bytes, 8), record.bytes.size());
        EXPECT_EQ(at<std::uint32_t>(record.bytes, record.bytes.size() - 4),
                  std::accumulate(record.bytes.begin(), end, 0U));
    }
    return out;
}

struct Reson : Bench {
    explicit Reson(const Options& changes = {}) : Bench(make_device("reson-7k", {}, changes)) {
        connect(0, {});
        echo_bin = 400;
        echo_power = 1e12F;
    }
    /// The error of the answer, 0 if it is an acknowledge; ticket and tracking number must come back.
    std::uint32_t answer(const Bytes& bytes, std::size_t port = 0, Address from = {}) {
        sent();
        say(bytes, port, from);
        const auto records = records_of(sent());
        if (records.empty()) return 1;
        EXPECT_EQ(records[0].get<std::uint32_t>(0), 77U);
        EXPECT_EQ(records[0].get<std::uint32_t>(4), 0xABCDU);
        EXPECT_EQ(records[0].get<std::uint32_t>(16), 0x1234U);
        if (records[0].type() == 7501) return 0;
        EXPECT_EQ(records[0].type(), 7502U);
        return records[0].get<std::uint32_t>(20);
    }
    std::vector<Seen> within(Time time) {
        run_to(now + time);
        return records_of(sent());
    }
    /// The next record of a type.
    Seen next(std::uint32_t type) {
        for (const Time end = now + 3s; now < end; run_to(now + 1ms))
            for (Seen& record : records_of(sent()))
                if (record.type() == type) return record;
        ADD_FAILURE() << "no " << type;
        return {};
    }
};

}  // namespace echoloop::test
