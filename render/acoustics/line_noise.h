// Random numbers for what a whole line or a few of its bins have in common: few of them, so that a hash is
// enough.
#pragma once

#include <cstdint>

#include "render/acoustics/random.h"

namespace echoloop {

enum class LineNoise : std::uint32_t { ring_down, lift, dash, added };

/// Names a line's numbers of one kind.
constexpr std::uint64_t line_hash(std::uint64_t key, std::uint64_t ping, std::uint32_t beam, LineNoise kind) {
    return mix(mix(key, ping), std::uint64_t{beam} << 32 | static_cast<std::uint32_t>(kind));
}

/// Within (0, 1).
constexpr double uniform_of(std::uint64_t hash) { return (static_cast<double>(hash >> 12) + 0.5) * 0x1p-52; }

/// Nearly Gaussian, of mean 0, variance 1 and within +-3.5: the sum of four uniform numbers.
constexpr float normal_of(std::uint64_t hash) {
    constexpr float root_3 = 1.7320508F;
    const auto sum = static_cast<std::int32_t>((hash & 0xFFFF) + (hash >> 16 & 0xFFFF) +
                                               (hash >> 32 & 0xFFFF) + (hash >> 48));
    return static_cast<float>(sum - 2 * 0xFFFF) * (root_3 * 0x1p-16F);
}

}  // namespace echoloop
