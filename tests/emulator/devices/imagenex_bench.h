// A host of Imagenex heads on the bench: literal commands with some bytes changed, replies read by the
// offsets of the serial interface specification.
#pragma once

#include <map>
#include <random>
#include <string>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {

using Changes = std::map<int, int>;  ///< offset in the command: value

inline Bytes changed(const std::string& hex, const Changes& changes) {
    Bytes bytes = from_hex(hex);
    for (const auto& [at, value] : changes)
        bytes.at(static_cast<std::size_t>(at)) = static_cast<std::uint8_t>(value);
    return bytes;
}

/// Low byte first, 7 bits each.
inline int u14(const Bytes& bytes, std::size_t at) {
    return (bytes.at(at) & 0x7F) | (bytes.at(at + 1) & 0x7F) << 7;
}

/// Says one command and hears the reply to it; none: empty. The time moves on to the reply.
inline Bytes ask(Bench& bench, const Bytes& command) {
    bench.sent();
    bench.say(command);
    if (bench.wake != Time::max()) bench.run_to(bench.wake);
    if (bench.ping) bench.hear();
    const auto sent = bench.sent();
    return sent.empty() ? Bytes{} : sent.front().bytes;
}

/// The command with every setting drawn by chance; 253 is only its end.
inline Bytes with_any_switches(Bytes command, std::mt19937& random) {
    for (std::size_t at = 3; at + 1 < command.size(); ++at) {
        const auto value = static_cast<std::uint8_t>(random());
        command[at] = value == 0xFD ? std::uint8_t{0} : value;
    }
    return command;
}

}  // namespace echoloop::test
