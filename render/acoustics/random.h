// Random numbers that are a function of their key alone: who asks first, or on which thread, changes nothing.
// Holds no state and knows no clock.
//
// Threefry4x32 with 13 rounds: Salmon, Moraes, Dror & Shaw, Parallel Random Numbers: As Easy as 1, 2, 3 (SC
// 2011); from 12 rounds on it passes TestU01's BigCrush. Counter-based, so that neighbouring keys give
// independent numbers; made of 32-bit additions, rotations and exclusive ors, which every SIMD unit has
// (Philox needs twice the time, as its 64-bit products must be shuffled).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace echoloop {

/// Names a sequence of random numbers; sequences of different names are independent.
struct RandomStream {
    std::uint64_t key = 0;    ///< of seed and device
    std::uint64_t place = 0;  ///< of a layer of the sonar's view, or of the ping
    std::uint32_t lane = 0;   ///< of the beam or the angular cell
    std::uint32_t kind = 0;   ///< of what the numbers are for
};

/// Spreads every bit of `value` over the result, and mixes it with `hash` (the finaliser of SplitMix64,
/// Steele, Lea & Flood, OOPSLA 2014).
constexpr std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
    std::uint64_t z = (hash ^ value) + 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
}

/// Four words for one counter.
std::array<std::uint32_t, 4> threefry(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 4> key);

/// Floats that a buffer for normals() needs for so many numbers.
constexpr std::size_t normals_tile = 32;
constexpr std::size_t normals_room(std::size_t count) { return count + 2 * normals_tile; }

/// Normal numbers of mean 0 and variance 1, since speckle and noise ask for millions of them a ping: a tile
/// of them is the sum of two stretches of 16,384 quantiles in random order, each number with a sign of its
/// own (README). No two numbers correlate; none is beyond 5.7. Writes the `count` ones from number `first`
/// on, and some around them; returns where in `out` number `first` lies.
std::size_t normals(const RandomStream& stream, std::int64_t first, std::size_t count, float* out);

/// The same numbers of two streams, times weights, added: in one go, since they are made more quickly than
/// they are read again.
std::size_t mixed_normals(const std::array<RandomStream, 2>& streams, std::array<float, 2> weights,
                          std::int64_t first, std::size_t count, float* out);

/// Cosines of uniform angles.
void random_cosines(const RandomStream& stream, std::size_t count, float* cosine);

/// A single angle's cosine and sine, and uniform numbers within 0..1, for what is rare.
std::array<float, 2> random_direction(const RandomStream& stream, std::uint32_t index);

}  // namespace echoloop
