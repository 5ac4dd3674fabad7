#include "render/acoustics/random.h"

#include <algorithm>
#include <cmath>

#include "render/acoustics/vector_math.h"

namespace echoloop {
namespace {

using vector_math::direction;
using vector_math::uniform;

constexpr int angle_shift = 20;                   ///< leaves 12 bits for the angle
constexpr std::size_t blocks = normals_tile / 8;  ///< of a tile

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

/// The upper bits of a word give the radius, the lower ones the angle.
ECHOLOOP_INLINE void box_muller(const std::uint32_t* word, float* real, float* imaginary) {
    for (std::size_t i = 0; i < blocks; ++i) {
        const float r = std::sqrt(-2 * vector_math::log(uniform(word[i])));
        const auto [c, s] = direction(word[i] << angle_shift);
        real[i] = r * c;
        imaginary[i] = r * s;
    }
}

/// Of whole tiles, the numbers from..to - 1 and some around them.
ECHOLOOP_SIMD void fill_normals(const RandomStream& stream, std::int64_t first_tile, std::size_t from,
                                std::size_t to, float* out) {
    constexpr std::size_t pairs = 2 * blocks;  // of one word
    Words words;
    for (std::size_t tile = 0; tile * normals_tile < to; ++tile) {
        const auto block = static_cast<std::size_t>(first_tile + static_cast<std::int64_t>(tile)) * blocks;
        fill(stream, 0, block, words);
        for (std::size_t w = 0; w < 4; ++w) {
            const std::size_t at = tile * normals_tile + w * pairs;
            if (at < to && at + pairs > from) box_muller(words.word[w], out + at, out + at + blocks);
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
    fill_normals(stream, (first - within) / tile, from, from + count, out);
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
