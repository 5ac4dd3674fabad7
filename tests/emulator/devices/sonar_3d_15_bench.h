// A Sonar 3D-15 on the bench: requests as text, packets read by the specification's offsets and protobuf's
// wire format, never by the project's codec. Packets are RIP1, which is not compressed.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {

using namespace std::chrono_literals;

constexpr std::size_t image_width = 256, image_height = 64;
inline const std::string integration = "/api/v1/integration";

inline Bytes text_bytes(const std::string& text) { return {text.begin(), text.end()}; }

inline std::string post_text(const std::string& path, const std::string& body) {
    return "POST " + integration + path +
           " HTTP/1.1\r\nHost: 192.168.194.96\r\nContent-Type: application/json\r\n" +
           "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}
inline std::string get_text(const std::string& path) {
    return "GET " + integration + path + " HTTP/1.1\r\nHost: 192.168.194.96\r\n\r\n";
}

inline std::uint64_t varint(const Bytes& bytes, std::size_t& at) {
    std::uint64_t value = 0;
    for (int shift = 0; at < bytes.size(); shift += 7) {
        value |= std::uint64_t{bytes[at] & 0x7FU} << shift;
        if (bytes[at++] < 0x80) break;
    }
    return value;
}

/// The fields of a protobuf message: varints and 32-bit words as numbers, the rest as bytes.
struct Protobuf {
    std::map<int, std::uint64_t> numbers;
    std::map<int, Bytes> blocks;

    explicit Protobuf(const Bytes& bytes) {
        for (std::size_t at = 0; at < bytes.size();) {
            const auto key = varint(bytes, at);
            const int field = static_cast<int>(key >> 3);
            if ((key & 7) == 0) {
                numbers[field] = varint(bytes, at);
            } else {
                const std::size_t size = (key & 7) == 5 ? 4 : varint(bytes, at);
                const Bytes block(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                                  bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
                if ((key & 7) == 5) {
                    std::uint32_t word = 0;
                    std::memcpy(&word, block.data(), 4);
                    numbers[field] = word;
                } else {
                    blocks[field] = block;
                }
                at += size;
            }
        }
    }
    float real(int field) const {
        const auto word = static_cast<std::uint32_t>(numbers.at(field));
        float value = 0;
        std::memcpy(&value, &word, 4);
        return value;
    }
    Protobuf inner(int field) const { return Protobuf(blocks.at(field)); }
};

/// A RIP1 packet: id, length, Packet{Any{type_url, value}}, checksum.
struct SeenImage {
    std::string type_url;
    Protobuf message;

    explicit SeenImage(const Bytes& packet) : message(Bytes()) {
        const Bytes payload(packet.begin() + 8, packet.end() - 4);
        const Protobuf any = Protobuf(payload).inner(1);
        type_url.assign(any.blocks.at(1).begin(), any.blocks.at(1).end());
        message = any.inner(2);
    }
    std::uint64_t sequence() const {
        const Protobuf header = message.inner(1);
        return header.numbers.contains(2) ? header.numbers.at(2) : 0;
    }
    double seconds() const {
        const Protobuf time = message.inner(1).inner(1);
        const double nanos = time.numbers.contains(2) ? static_cast<double>(time.numbers.at(2)) : 0;
        return static_cast<double>(time.numbers.at(1)) + nanos * 1e-9;
    }
    /// m; of a range image.
    std::vector<double> distances() const {
        std::vector<double> out;
        const Bytes packed = message.blocks.at(10);
        for (std::size_t at = 0; at < packed.size();)
            out.push_back(static_cast<double>(varint(packed, at)) * message.real(9));
        return out;
    }
};

class SonarBench {
  public:
    explicit SonarBench(Options changes = {}, std::vector<std::string> endpoints = {}) {
        changes.emplace("packets", std::string("RIP1"));
        const Model& row = *find_model("sonar-3d-15");
        DeviceConfig config = make_config(row, changes);
        config.unix_start = 1.75e9 + 0.25;
        if (!endpoints.empty()) config.endpoints = parse_endpoints(endpoints);
        bench.emplace(row.make(config));
        bench->echo_power = 1e16F;  // 160 dB
        bench->echo_bin = 100;
    }

    /// Status line, headers and body of the only answer.
    std::string ask(const std::string& text) {
        bench->say(text_bytes(text));
        std::string answers;
        for (const Send& send : bench->sent())
            if (send.port == 0) answers.append(send.bytes.begin(), send.bytes.end());
        return answers;
    }
    int status(const std::string& text) {
        const std::string answer = ask(text);
        return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9)) : 0;
    }
    int post(const std::string& path, const std::string& body) { return status(post_text(path, body)); }
    std::string get(const std::string& path) {
        const std::string answer = ask(get_text(path));
        return answer.substr(std::min(answer.find("\r\n\r\n") + 4, answer.size()));
    }
    /// The packets sent while time passes to `end`.
    std::vector<Send> packets_until(Time end) {
        bench->run_to(end);
        std::vector<Send> packets;
        for (Send& send : bench->sent())
            if (send.port == 1) packets.push_back(std::move(send));
        return packets;
    }

    std::optional<Bench> bench;
};

inline const Options pinging{{"acoustics", true}, {"speed_of_sound", 1500.0}};

}  // namespace echoloop::test
