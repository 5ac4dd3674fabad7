#include "render/acoustics/random.h"

#include <algorithm>
#include <bit>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <utility>

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

/// Of each number: a step of the golden ratio of all 32-bit words (Weyl's sequence).
constexpr std::uint32_t golden_step = 0x9E3779B9U;

/// A hash of two multiplications, with a part of the key before each (form and constants: Wellons,
/// Prospecting for Hash Functions, 2018, as improved since). `place`: the number times golden_step, and
/// seeds.before.
ECHOLOOP_INLINE std::uint32_t word_at(std::uint32_t place, std::uint32_t between) {
    std::uint32_t x = (place ^ place >> 16) * 0x21F0AAADU + between;
    x = (x ^ x >> 15) * 0xD35A2D97U;
    return x ^ x >> 15;
}

/// Normal numbers of variance 1/2 in random order: the quantiles, so that together they are distributed as
/// exactly as so many can be. The first ones stand again behind the last.
class NormalPool {
  public:
    static constexpr int size_log2 = 14;
    static constexpr std::size_t size = std::size_t{1} << size_log2;

    NormalPool() {
        double energy = 0;
        for (std::size_t i = 0; i < size / 2; ++i) {
            const double share = (static_cast<double>(i) + 0.5) / size;
            const double quantile = boost::math::erfc_inv(2 * share);
            values_[i] = static_cast<float>(quantile), values_[size - 1 - i] = static_cast<float>(-quantile);
            energy += 2 * quantile * quantile / size;
        }
        const auto scale = static_cast<float>(std::sqrt(0.5 / energy));
        for (std::size_t i = size - 1; i > 0; --i) std::swap(values_[i], values_[mix(size, i) % (i + 1)]);
        for (std::size_t i = 0; i < size; ++i) values_[i] *= scale;
        std::copy_n(values_, normals_tile, values_ + size);
    }
    const float* values() const { return values_; }

  private:
    alignas(64) float values_[size + normals_tile];
};

/// Of some tiles, where in the pool their two stretches begin, and the signs of their numbers: so no two
/// numbers go together, whatever the pool's neighbours do.
struct Tiles {
    static constexpr std::size_t count = 16;
    std::uint32_t places[count], signs[count];

    ECHOLOOP_INLINE void find(Seeds seeds, std::uint32_t first_tile) {
        const std::uint32_t first = first_tile * 2 * golden_step + seeds.before;
        for (std::uint32_t i = 0; i < count; ++i) {
            places[i] = word_at(first + 2 * i * golden_step, seeds.between);
            signs[i] = word_at(first + (2 * i + 1) * golden_step, seeds.between);
        }
    }
};

/// Numbers of one tile, times a weight.
struct TileNumbers {
    const float *one, *other;
    std::uint32_t signs;
    float weight;

    ECHOLOOP_INLINE TileNumbers(const float* pool, const Tiles& tiles, std::size_t tile, float times)
        : one(pool + (tiles.places[tile] >> (32 - NormalPool::size_log2))),
          other(pool + tiles.places[tile] % NormalPool::size),
          signs(tiles.signs[tile]),
          weight(times) {}
    ECHOLOOP_INLINE float at(std::uint32_t i) const {
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>((one[i] + other[i]) * weight) ^
                                    (signs << i & 0x80000000U));
    }
};

/// Of whole tiles.
ECHOLOOP_SIMD void fill_normals(const float* pool, Seeds seeds, std::uint32_t first_tile, std::size_t tiles,
                                float* out) {
    Tiles some;
    for (std::size_t begin = 0; begin < tiles; begin += Tiles::count) {
        some.find(seeds, first_tile + static_cast<std::uint32_t>(begin));
        const std::size_t these = std::min(Tiles::count, tiles - begin);
        for (std::size_t tile = 0; tile < these; ++tile, out += normals_tile) {
            const TileNumbers numbers(pool, some, tile, 1);
            for (std::uint32_t i = 0; i < normals_tile; ++i) out[i] = numbers.at(i);
        }
    }
}

ECHOLOOP_SIMD void fill_mixed_normals(const float* pool, std::array<Seeds, 2> seeds,
                                      std::array<float, 2> weights, std::uint32_t first_tile,
                                      std::size_t tiles, float* out) {
    Tiles a, b;
    for (std::size_t begin = 0; begin < tiles; begin += Tiles::count) {
        const std::uint32_t first = first_tile + static_cast<std::uint32_t>(begin);
        a.find(seeds[0], first), b.find(seeds[1], first);
        const std::size_t these = std::min(Tiles::count, tiles - begin);
        for (std::size_t tile = 0; tile < these; ++tile, out += normals_tile) {
            const TileNumbers one(pool, a, tile, weights[0]), other(pool, b, tile, weights[1]);
            for (std::uint32_t i = 0; i < normals_tile; ++i) out[i] = one.at(i) + other.at(i);
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

namespace {

const float* pool_values() {
    static const NormalPool pool;
    return pool.values();
}

/// The tiles that hold numbers first..first + count - 1.
struct WholeTiles {
    std::uint32_t first;
    std::size_t count, before;  ///< `before`: numbers of the first tile before number `first`

    WholeTiles(std::int64_t first_number, std::size_t numbers) {
        constexpr auto tile = static_cast<std::int64_t>(normals_tile);
        const std::int64_t within = (first_number % tile + tile) % tile;
        before = static_cast<std::size_t>(within);
        first = static_cast<std::uint32_t>((first_number - within) / tile);
        count = (before + numbers + normals_tile - 1) / normals_tile;
    }
};

}  // namespace

std::size_t normals(const RandomStream& stream, std::int64_t first, std::size_t count, float* out) {
    const WholeTiles tiles(first, count);
    fill_normals(pool_values(), seeds_of(stream), tiles.first, tiles.count, out);
    return tiles.before;
}

std::size_t mixed_normals(const std::array<RandomStream, 2>& streams, std::array<float, 2> weights,
                          std::int64_t first, std::size_t count, float* out) {
    const WholeTiles tiles(first, count);
    fill_mixed_normals(pool_values(), {seeds_of(streams[0]), seeds_of(streams[1])}, weights, tiles.first,
                       tiles.count, out);
    return tiles.before;
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
