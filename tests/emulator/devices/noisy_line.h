// A line that flips 5 % of the bytes of everything a host says, and the request that must be answered
// afterwards. Knows no protocol: words, request and answer come from the device's own test.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {

/// What a host of the model says in a row, and how it knows that it is served. All frames are literal hex.
struct NoisyHost {
    std::vector<std::string> words;              ///< settings, commands, requests; drawn by chance
    std::string request;                         ///< arrives undamaged, once
    std::function<bool(const Send&)> is_answer;  ///< to that request, and to no word before it
    Time patience{};                             ///< from the request to its answer: the ping, the line
    Time quiet{};  ///< silence before the request, for devices that frame by time
    Time longest_pause = std::chrono::milliseconds(50);  ///< between two words
    std::size_t port = 0;
    Address from{};
};

inline Bytes with_flipped_bytes(Bytes bytes, std::mt19937& random) {
    for (std::uint8_t& byte : bytes)
        if (random() % 20 == 0) byte ^= static_cast<std::uint8_t>(1 + random() % 255);
    return bytes;
}

/// True if one undamaged request is answered within the host's patience.
inline bool is_served(Bench& bench, const NoisyHost& host) {
    bench.run_to(bench.now + host.quiet);
    bench.sent();
    bench.say(host.request, host.port, host.from);
    bench.run_to(bench.now + host.patience);
    for (const Send& send : bench.sent())
        if (host.is_answer(send)) return true;
    return false;
}

/// Fails at the first round of five damaged words whose host is not served again within one request.
inline void expect_no_wedge(Bench& bench, const NoisyHost& host, int rounds = 2000) {
    std::mt19937 random(7);
    const auto longest = static_cast<std::uint64_t>(host.longest_pause.count());
    for (int round = 0; round < rounds; ++round) {
        for (int i = 0; i < 5; ++i) {
            const Bytes word = from_hex(host.words[random() % host.words.size()]);
            bench.say(with_flipped_bytes(word, random), host.port, host.from);
            bench.run_to(bench.now + Time(random() % (longest + 1)));
            bench.sent();
        }
        ASSERT_TRUE(is_served(bench, host)) << "round " << round;
        bench.shots.clear();
    }
}

}  // namespace echoloop::test
