#include "render/acoustics/chain_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/simd.h"

namespace echoloop::kernels {

namespace {

constexpr int law_terms = 9;        ///< BinLaw::law_terms
constexpr float law_end = 5.7F;     ///< standard deviations; a law is made for no more
constexpr float smallest = 1e-30F;  ///< uPa^2; keeps silence from being divided by itself
constexpr std::size_t most_together = 5;

ECHOLOOP_INLINE float cube(float x) { return x * x * x; }

/// weighted_sum() of so many fields in one loop.
template <std::size_t N>
ECHOLOOP_INLINE void sum_of(const float* const* fields, const float* weights, std::size_t count, float* out) {
    float w[N];
    const float* f[N];
    for (std::size_t k = 0; k < N; ++k) w[k] = weights[k], f[k] = fields[k];
    for (std::size_t i = 0; i < count; ++i) {
        float sum = w[0] * f[0][i];
#pragma GCC unroll 5
        for (std::size_t k = 1; k < N; ++k) sum += w[k] * f[k][i];
        out[i] = sum;
    }
}

}  // namespace

namespace {

constexpr std::size_t bins_at_once = 256;  // a whole number of tiles of any vectors

/// Of so many bins normal variables, which become roots by the law, and the echo's shares in the mean power.
/// Whole vectors of them are worked out, so what lies behind the last bin at hand is a number, too.
struct Tile {
    float z[bins_at_once], share[bins_at_once];
};

/// Cube roots by the law: a polynomial in z, whose coefficients are those of `base` and, `between` two laws,
/// as much of `more` as the share says. Even and odd terms apart, of four vectors in turns: each step waits
/// for the step before, and a processor does not look so far ahead that it finds the next bins by itself.
template <class Vector, bool between>
ECHOLOOP_INLINE void find_roots_of(const float* base, const float* more, Tile& tile, std::size_t count) {
    constexpr std::size_t across = 4, lanes = sizeof(Vector) / sizeof(float);
    static_assert(bins_at_once % (across * lanes) == 0 && law_terms % 2 == 1);
    for (std::size_t at = 0; at < count; at += across * lanes) {
        Vector square[across], even[across], odd[across], share[across] = {};
        const auto term = [&](int k, std::size_t i, Vector& out) {
            out = Vector{} + base[k];
            if constexpr (between) out += share[i] * more[k];
        };
        const auto read = [&](std::size_t i, Vector& z) {
            std::memcpy(&z, tile.z + at + i * lanes, sizeof z);
        };
#pragma GCC unroll 4
        for (std::size_t i = 0; i < across; ++i) {
            Vector z;
            read(i, z);
            square[i] = z * z;
            if constexpr (between) std::memcpy(&share[i], tile.share + at + i * lanes, sizeof share[i]);
            term(law_terms - 1, i, even[i]), term(law_terms - 2, i, odd[i]);
        }
#pragma GCC unroll 4
        for (int k = law_terms - 3; k >= 0; k -= 2) {
#pragma GCC unroll 4
            for (std::size_t i = 0; i < across; ++i) {
                Vector next;
                term(k, i, next);
                even[i] = even[i] * square[i] + next;
                if (k == 0) continue;
                term(k - 1, i, next);
                odd[i] = odd[i] * square[i] + next;
            }
        }
#pragma GCC unroll 4
        for (std::size_t i = 0; i < across; ++i) {
            Vector z;
            read(i, z);
            const Vector root = even[i] + odd[i] * z;
            std::memcpy(tile.z + at + i * lanes, &root, sizeof root);
        }
    }
}

template <class Vector>
ECHOLOOP_INLINE void find_roots_by(const float* base, const float* more, Tile& tile, std::size_t count) {
    more == nullptr ? find_roots_of<Vector, false>(base, more, tile, count)
                    : find_roots_of<Vector, true>(base, more, tile, count);
}

#ifdef ECHOLOOP_SIMD_VERSIONS
__attribute__((target("arch=x86-64-v4"))) void find_roots(const float* base, const float* more, Tile& tile,
                                                          std::size_t count) {
    find_roots_by<Sixteen>(base, more, tile, count);
}

__attribute__((target("arch=x86-64-v3"))) void find_roots(const float* base, const float* more, Tile& tile,
                                                          std::size_t count) {
    find_roots_by<Eight>(base, more, tile, count);
}

__attribute__((target("default")))
#endif
void
find_roots(const float* base, const float* more, Tile& tile, std::size_t count) {
    find_roots_by<Four>(base, more, tile, count);
}

/// Shares, and the z of echo and noise together: see scatter().
ECHOLOOP_SIMD void mix_fields(const float* __restrict echo, const float* __restrict noise, float beside,
                              const float* __restrict within, const float* __restrict mean, std::size_t count,
                              float* __restrict z, float* __restrict shares) {
    for (std::size_t i = 0; i < count; ++i) {
        const float whole = mean[i] + beside,
                    share = std::max(mean[i] - within[i], 0.0F) / (whole + smallest);
        const float rest = std::sqrt(std::max(1 - share * share, 0.0F));
        const float both = share * echo[i] + rest * noise[i];
        z[i] = std::min(std::max(both, -law_end), law_end), shares[i] = share;
    }
}

ECHOLOOP_SIMD void cut_off(const float* __restrict z, std::size_t count, float* __restrict out) {
    for (std::size_t i = 0; i < count; ++i) out[i] = std::min(std::max(z[i], -law_end), law_end);
}

ECHOLOOP_SIMD void cube_times(const float* __restrict root, const float* __restrict mean, float beside,
                              std::size_t count, float* __restrict power) {
    for (std::size_t i = 0; i < count; ++i) power[i] = (mean[i] + beside) * cube(std::max(root[i], 0.0F));
}

ECHOLOOP_SIMD void multiply_by_cube(const float* __restrict root, std::size_t count,
                                    float* __restrict power) {
    for (std::size_t i = 0; i < count; ++i) power[i] *= cube(std::max(root[i], 0.0F));
}

}  // namespace

void scatter(Normals echo, Normals noise, NoisePowers noise_powers, std::size_t count, const float* mean,
             float* power) {
    float more[law_terms];
    for (int k = 0; k < law_terms; ++k) more[k] = echo.root[k] - noise.root[k];
    const bool alike = std::equal(echo.root, echo.root + law_terms, noise.root);
    Tile tile{};
    for (std::size_t at = 0; at < count; at += bins_at_once) {
        const std::size_t these = std::min(bins_at_once, count - at);
        mix_fields(echo.z + at, noise.z + at, noise_powers.beside, noise_powers.within + at, mean + at, these,
                   tile.z, tile.share);
        find_roots(noise.root, alike ? nullptr : more, tile, these);
        cube_times(tile.z, mean + at, noise_powers.beside, these, power + at);
    }
}

void multiply_by_law(const float* root, const float* z, std::size_t count, float* power) {
    Tile tile{};
    for (std::size_t at = 0; at < count; at += bins_at_once) {
        const std::size_t these = std::min(bins_at_once, count - at);
        cut_off(z + at, these, tile.z);
        find_roots(root, nullptr, tile, these);
        multiply_by_cube(tile.z, these, power + at);
    }
}

ECHOLOOP_SIMD void interfere(const float* other, const float* cosine, float looks, std::size_t count,
                             float* power) {
    const float cross = 2 / std::sqrt(looks);
    // Roots first: the product of two powers may be beyond a float.
    for (std::size_t i = 0; i < count; ++i)
        power[i] += other[i] + cross * (std::sqrt(power[i]) * std::sqrt(other[i])) * cosine[i];
}

ECHOLOOP_SIMD void weighted_sum(const float* const* fields, const float* weights, std::size_t fields_count,
                                std::size_t count, float* out) {
    const std::size_t together = std::min(fields_count, most_together);
    switch (together) {
        case 1:
            sum_of<1>(fields, weights, count, out);
            break;
        case 2:
            sum_of<2>(fields, weights, count, out);
            break;
        case 3:
            sum_of<3>(fields, weights, count, out);
            break;
        case 4:
            sum_of<4>(fields, weights, count, out);
            break;
        default:
            sum_of<most_together>(fields, weights, count, out);
    }
    for (std::size_t k = together; k < fields_count; ++k)
        for (std::size_t i = 0; i < count; ++i) out[i] += weights[k] * fields[k][i];
}

ECHOLOOP_SIMD bool is_part(const float* part, const float* power, float least, float noise,
                           std::size_t count) {
    int more = 0;
    for (std::size_t i = 0; i < count; ++i) more |= static_cast<int>(part[i] > least * (power[i] + noise));
    return more != 0;
}

ECHOLOOP_SIMD void renew(const float* fresh, const float* power, const float* z_fresh, std::size_t count,
                         float* z) {
    for (std::size_t i = 0; i < count; ++i) {
        const float share = std::max(1 - fresh[i] / (power[i] + smallest), 0.0F);
        z[i] = share * z[i] + std::sqrt(std::max(1 - share * share, 0.0F)) * z_fresh[i];
    }
}

ECHOLOOP_SIMD void receive(float limit, std::size_t count, float* power) {
    if (limit < INFINITY)
        for (std::size_t i = 0; i < count; ++i) power[i] = std::min(power[i], limit);
}

}  // namespace echoloop::kernels
