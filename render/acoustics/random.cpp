#include "render/acoustics/random.h"

#include <algorithm>
#include <cmath>

#include "render/acoustics/vector_math.h"

namespace echoloop {
namespace {

using vector_math::direction;
using vector_math::uniform;

constexpr int angle_shift = 20;                  ///< leaves 12 bits for the angle
constexpr std::size_t blocks = random_tile / 4;  ///< of a tile

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
        const float r = std::sqrt(-vector_math::log(uniform(word[i])));
        const auto [c, s] = direction(word[i] << angle_shift);
        real[i] = r * c;
        imaginary[i] = r * s;
    }
}

/// Weights of n - 1 equal exponentials and a lesser one, so that the mean is 1 and the variance 1 / looks.
struct LookWeights {
    int whole;
    float each, last;
};

LookWeights weights_of(double looks) {
    const double n = std::ceil(looks - 1e-9), m = n - 1, spread = 1 - 1 / looks;
    if (m < 1) return {0, 0, 1};
    const double each = (m + std::sqrt(std::max(m * m - (m * m + m) * spread, 0.0))) / (m * m + m);
    return {static_cast<int>(m), static_cast<float>(each), static_cast<float>(1 - m * each)};
}

/// Multiplies `product` by the uniform numbers of one more layer: 4 * blocks of them.
ECHOLOOP_INLINE void multiply(const Words& words, float* product) {
    for (std::size_t w = 0; w < 4; ++w)
        for (std::size_t i = 0; i < blocks; ++i) product[w * blocks + i] *= uniform(words.word[w][i]);
}

/// Adds the exponentials of `layers` uniform numbers each. The logarithm of up to four is taken at once.
ECHOLOOP_INLINE void add_exponentials(const RandomStream& stream, std::size_t first_block,
                                      std::uint32_t first_layer, std::uint32_t layers, float weight,
                                      float* sum) {
    Words words;
    float product[4 * blocks];
    for (std::uint32_t done = 0; done < layers;) {
        std::fill_n(product, 4 * blocks, 1.0F);
        for (std::uint32_t n = 0; n < 4 && done < layers; ++n, ++done) {
            fill(stream, first_layer + done, first_block, words);
            multiply(words, product);
        }
        for (std::size_t i = 0; i < 4 * blocks; ++i) sum[i] -= weight * vector_math::log(product[i]);
    }
}

ECHOLOOP_SIMD void fill_complex(const RandomStream& stream, std::size_t count, float* real,
                                float* imaginary) {
    Words words;
    for (std::size_t i = 0; i < count; i += 4 * blocks) {
        fill(stream, 0, i / 4, words);
        for (std::size_t w = 0; w < 4; ++w)
            box_muller(words.word[w], real + i + w * blocks, imaginary + i + w * blocks);
    }
}

ECHOLOOP_SIMD void fill_few_looks(const RandomStream& stream, LookWeights weights, std::size_t count,
                                  float* power) {
    float sum[4 * blocks];
    for (std::size_t i = 0; i < count; i += 4 * blocks) {
        std::fill_n(sum, 4 * blocks, 0.0F);
        add_exponentials(stream, i / 4, 1, 1, weights.last, sum);
        add_exponentials(stream, i / 4, 2, static_cast<std::uint32_t>(weights.whole), weights.each, sum);
        std::copy_n(sum, std::min(4 * blocks, count - i), power + i);
    }
}

/// Wilson & Hilferty: the cube root of a gamma variable is nearly Gaussian.
ECHOLOOP_SIMD void fill_many_looks(const RandomStream& stream, float looks, std::size_t count, float* power) {
    const float ninth = 1 / (9 * looks), deviation = std::sqrt(2 * ninth);  // a real part has variance 1 / 2
    float normal[8 * blocks];
    Words words;
    for (std::size_t i = 0; i < count; i += 8 * blocks) {
        fill(stream, 1, i / 8, words);
        for (std::size_t w = 0; w < 4; ++w)
            box_muller(words.word[w], normal + 2 * w * blocks, normal + (2 * w + 1) * blocks);
        for (float& z : normal) {
            const float root = std::max(1 - ninth + deviation * z, 0.0F);
            z = root * root * root;
        }
        std::copy_n(normal, std::min(8 * blocks, count - i), power + i);
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

void complex_normals(const RandomStream& stream, std::size_t count, float* real, float* imaginary) {
    fill_complex(stream, count, real, imaginary);
}

void mean_of_looks(const RandomStream& stream, double looks, std::size_t count, float* power) {
    if (looks > 2) return fill_many_looks(stream, static_cast<float>(looks), count, power);
    fill_few_looks(stream, weights_of(looks), count, power);
}

void random_cosines(const RandomStream& stream, std::size_t count, float* cosine) {
    fill_cosines(stream, count, cosine);
}

std::array<float, 2> random_direction(const RandomStream& stream, std::uint32_t index) {
    const auto [cosine, sine] =
        direction(threefry_rounds({index, stream.lane, stream.kind, 0}, key_of(stream)).x0);
    return {cosine, sine};
}

double random_gamma(const RandomStream& stream, std::uint32_t index, double shape) {
    const double d = (shape < 1 ? shape + 1 : shape) - 1.0 / 3, c = 1 / std::sqrt(9 * d);
    const Key key = key_of(stream);
    for (std::uint32_t attempt = 0;; ++attempt) {
        const Counter word = threefry_rounds({index, stream.lane, stream.kind, attempt}, key);
        const float u = uniform(word.x0);
        const double normal = std::sqrt(-2.0 * static_cast<double>(vector_math::log(u))) *
                              static_cast<double>(direction(word.x1).cosine);
        const double root = 1 + c * normal, v = root * root * root;
        if (root <= 0) continue;
        const double accept = std::log(static_cast<double>(uniform(word.x2)));
        if (accept >= normal * normal / 2 + d - d * v + d * std::log(v)) continue;
        const double boost = shape < 1 ? std::exp(std::log(static_cast<double>(uniform(word.x3))) / shape)
                                       : 1;  // their section 6
        return d * v * boost / shape;
    }
}

}  // namespace echoloop
