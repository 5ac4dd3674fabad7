// A Nortek DVL on the bench, for its tests: frames are read at the offsets of public readers of DF21, lines
// by their commas, never by the project's codec.
#pragma once

#include <gtest/gtest.h>

#include <cstring>

#include "tests/emulator/devices/doppler_echo.h"

namespace echoloop::test::nortek_dvl {

using namespace std::chrono_literals;

enum DvlPort : std::size_t { commands, data, text, line, datagrams };
inline constexpr Address host{0x7F000001, 9005};

inline float f32(const Bytes& b, std::size_t at) {
    float value = 0;
    std::memcpy(&value, b.data() + at, sizeof value);
    return value;
}
inline unsigned u32(const Bytes& b, std::size_t at) {
    unsigned value = 0;
    std::memcpy(&value, b.data() + at, sizeof value);
    return value;
}
inline std::string as_text(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

inline std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields{""};
    for (const char c : line.substr(0, line.find('*')))
        if (c == ',')
            fields.emplace_back();
        else
            fields.back() += c;
    return fields;
}

struct NortekDvl {
    explicit NortekDvl(const Options& changes = {}, const std::string& model = "nortek-dvl1000")
        : bench(make_device(model,
                            {"tcp-listen://127.0.0.1:9000", "tcp-listen://127.0.0.1:9002",
                             "tcp-listen://127.0.0.1:9004", "pty:/tmp/echoloop/n", "udp://127.0.0.1:9005"},
                            changes)) {}

    /// What a port has said since the last call, until `end`.
    std::vector<Bytes> said(Time end, std::size_t port = line) {
        bottom.run(bench, end);
        std::vector<Bytes> out;
        for (const Send& send : bench.sent())
            if (send.port == port) out.push_back(send.bytes);
        return out;
    }
    std::string ask(const std::string& words, std::size_t port = line, const std::string& end = "\r\n") {
        bench.sent();
        const std::string ended = words + end;
        bench.say(Bytes(ended.begin(), ended.end()), port);
        std::string heard;
        for (const Send& send : bench.sent())
            if (send.port == port && send.bytes[0] != 0xA5) heard += as_text(send.bytes);
        return heard;
    }
    void go_to_command_mode() {
        ask("K1W%!Q", line, "");
        EXPECT_EQ(ask("MC"), "OK\r\n");
    }
    /// The data of the last frame with that id until `end`.
    Bytes last(Time end, std::uint8_t id = 0x1B) {
        Bytes out;
        for (const Bytes& one : said(end))
            if (one[0] == 0xA5 && one[2] == id && one[3] == 0x10) out.assign(one.begin() + 10, one.end());
        return out;
    }
    std::string last_line(Time end, std::size_t port = line) {
        std::string out;
        for (const Bytes& one : said(end, port)) out = as_text(one);
        return out;
    }

    Bench bench;
    OverBottom bottom;
};

/// Azimuth of beams 1 to 4, deg clockwise from ahead.
inline constexpr double azimuths[] = {45, -45, -135, 135};

}  // namespace echoloop::test::nortek_dvl
