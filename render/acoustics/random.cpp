#include "render/acoustics/random.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/acoustics/vector_math.h"

namespace echoloop {
namespace {

using vector_math::direction;

constexpr std::size_t blocks = 16;  ///< at once

/// Word w of block i.
struct alignas(32) Words {
    std::uint32_t word[4][blocks];
};

struct Counter {
    std::uint32_t x0, x1, x2, x3;
};

struct Key {
    std::uint32_t word[5];  ///< the fifth as the algorithm extends it
};

ECHOLOOP_INLINE Key extended(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    return {{a, b, c, d, 0x1BD11BDAU ^ a ^ b ^ c ^ d}};
}

ECHOLOOP_INLINE void stir(std::uint32_t& a, std::uint32_t& b, int bits) {
    a += b;
    b = (b << bits | b >> (32 - bits)) ^ a;
}

ECHOLOOP_INLINE Counter threefry_rounds(Counter c, const Key& key) {
    constexpr int bits[8][2] = {{10, 26}, {11, 21}, {13, 27}, {23, 5}, {6, 20}, {17, 11}, {25, 10}, {18, 20}};
    c = {c.x0 + key.word[0], c.x1 + key.word[1], c.x2 + key.word[2], c.x3 + key.word[3]};
#pragma GCC unroll 13
    for (std::uint32_t round = 0; round < 13; ++round) {
        stir(c.x0, round % 2 == 0 ? c.x1 : c.x3, bits[round % 8][0]);
        stir(c.x2, round % 2 == 0 ? c.x3 : c.x1, bits[round % 8][1]);
        if (round % 4 != 3) continue;
        const std::uint32_t r = round / 4 + 1;
        c = {c.x0 + key.word[r % 5], c.x1 + key.word[(r + 1) % 5], c.x2 + key.word[(r + 2) % 5],
             c.x3 + key.word[(r + 3) % 5] + r};
    }
    return c;
}

ECHOLOOP_INLINE Key key_of(const RandomStream& stream) {
    return extended(static_cast<std::uint32_t>(stream.key), static_cast<std::uint32_t>(stream.key >> 32),
                    static_cast<std::uint32_t>(stream.place), static_cast<std::uint32_t>(stream.place >> 32));
}

/// Numbers of one layer of a stream, from a block on.
ECHOLOOP_INLINE void fill(const RandomStream& stream, std::uint32_t layer, std::size_t first_block,
                          Words& out) {
    const Key key = key_of(stream);
    const auto first = static_cast<std::uint32_t>(first_block);
    for (std::uint32_t i = 0; i < blocks; ++i) {
        const Counter c = threefry_rounds({first + i, stream.lane, stream.kind, layer}, key);
        out.word[0][i] = c.x0;
        out.word[1][i] = c.x1;
        out.word[2][i] = c.x2;
        out.word[3][i] = c.x3;
    }
}

/// What a stream adds to the numbers that its words are made of.
struct Seeds {
    std::uint32_t before, between;
};

Seeds seeds_of(const RandomStream& stream) {
    const std::uint64_t hash = mix(mix(mix(0, stream.key), stream.place),
                                   std::uint64_t{stream.lane} << 32 | std::uint64_t{stream.kind});
    return {static_cast<std::uint32_t>(hash), static_cast<std::uint32_t>(hash >> 32)};
}

/// Of each number: a step of the golden ratio of all 32-bit words (Weyl's sequence; without it sums of 512
/// numbers have 1.5 % too little energy).
constexpr std::uint32_t golden_step = 0x9E3779B9U;

/// A hash of two multiplications, with a part of the key before each (form and constants: Wellons,
/// Prospecting for Hash Functions, 2018, as improved since). `place`: the number times golden_step, and
/// seeds.before.
ECHOLOOP_INLINE std::uint32_t word_at(std::uint32_t place, std::uint32_t between) {
    std::uint32_t x = (place ^ place >> 16) * 0x21F0AAADU + between;
    x = (x ^ x >> 15) * 0xD35A2D97U;
    return x ^ x >> 15;
}

struct Pair {
    float real, imaginary;
};

/// Of a word the 23 upper bits give the radius, and the 12 lower ones the angle: 11 within half a circle, and
/// a sign. Polynomials by least squares with weights that even out the error (own fit): of ln within 2e-5, of
/// sine and cosine within 7e-5.
ECHOLOOP_INLINE Pair box_muller(std::uint32_t word) {
    constexpr float half_circle = 3.14159265F;
    const auto bits =
        std::bit_cast<std::int32_t>(static_cast<float>(static_cast<std::int32_t>(word >> 8 | 1)));
    const std::int32_t exponent = (bits - 0x3F3504F3) >> 23;  // of sqrt(1/2): see vector_math::log()
    const float t = std::bit_cast<float>(bits - exponent * (1 << 23)) - 1.0F;
    const float q = ((0.17968725F * t - 0.27225918F) * t + 0.33587286F) * t - 0.49933242F;
    const float log = (q * t + 1.0F) * t + 0.69314718F * static_cast<float>(exponent - 24);
    const float r = std::sqrt(-2.0F * log);
    const float a =
        (static_cast<float>(static_cast<std::int32_t>(word & 0x7FFU)) - 1023.5F) * (half_circle / 2048);
    const float z = a * a;
    const float s = ((0.00751433F * z - 0.16567298F) * z + 0.99969673F) * a;
    const float c = ((-0.0012712F * z + 0.04148772F) * z - 0.49991242F) * z + 0.99999329F;
    const float either = std::bit_cast<float>(std::bit_cast<std::uint32_t>(r) ^ (word << 20 & 0x80000000U));
    return {either * c, either * s};
}

/// Of whole tiles.
ECHOLOOP_SIMD void fill_normals(Seeds seeds, std::uint32_t first_tile, std::size_t tiles, float* out) {
    constexpr std::uint32_t half = normals_tile / 2;
    for (std::size_t tile = 0; tile < tiles; ++tile, out += normals_tile) {
        const std::uint32_t first = (first_tile + static_cast<std::uint32_t>(tile)) * half;
        const std::uint32_t place = first * golden_step + seeds.before;
        for (std::uint32_t i = 0; i < half; ++i) {
            const Pair pair = box_muller(word_at(place + i * golden_step, seeds.between));
            out[i] = pair.real;
            out[i + half] = pair.imaginary;
        }
    }
}

ECHOLOOP_SIMD void fill_cosines(const RandomStream& stream, std::size_t count, float* cosine) {
    Words words;
    for (std::size_t i = 0; i < count; i += 4 * blocks) {
        fill(stream, 0, i / 4, words);
        float tile[4 * blocks];
        for (std::size_t w = 0; w < 4; ++w)
            for (std::size_t k = 0; k < blocks; ++k)
                tile[w * blocks + k] = direction(words.word[w][k]).cosine;
        std::copy_n(tile, std::min(4 * blocks, count - i), cosine + i);
    }
}

}  // namespace

std::array<std::uint32_t, 4> threefry(std::array<std::uint32_t, 4> counter,
                                      std::array<std::uint32_t, 4> key) {
    const Counter c = threefry_rounds({counter[0], counter[1], counter[2], counter[3]},
                                      extended(key[0], key[1], key[2], key[3]));
    return {c.x0, c.x1, c.x2, c.x3};
}

std::size_t normals(const RandomStream& stream, std::int64_t first, std::size_t count, float* out) {
    constexpr auto tile = static_cast<std::int64_t>(normals_tile);
    const std::int64_t within = (first % tile + tile) % tile;
    const auto from = static_cast<std::size_t>(within);
    fill_normals(seeds_of(stream), static_cast<std::uint32_t>((first - within) / tile),
                 (from + count + normals_tile - 1) / normals_tile, out);
    return from;
}

void random_cosines(const RandomStream& stream, std::size_t count, float* cosine) {
    fill_cosines(stream, count, cosine);
}

std::array<float, 2> random_direction(const RandomStream& stream, std::uint32_t index) {
    const auto [cosine, sine] =
        direction(threefry_rounds({index, stream.lane, stream.kind, 0}, key_of(stream)).x0);
    return {cosine, sine};
}

}  // namespace echoloop
