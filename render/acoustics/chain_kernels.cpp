#include "render/acoustics/chain_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "render/acoustics/vector_math.h"

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

/// z of echo and noise together, see scatter(); and what of the mean power is echo.
struct Together {
    float whole, share, z;
};

ECHOLOOP_INLINE Together together(float power, NoisePowers noise_powers, float echo, float noise) {
    const float whole = power + noise_powers.beside,
                share = std::max(power - noise_powers.within, 0.0F) / (whole + smallest);
    const float rest = std::sqrt(std::max(1 - share * share, 0.0F));
    const float z = share * echo + rest * noise;
    return {whole, share, std::min(std::max(z, -law_end), law_end)};
}

/// Echo and noise have one law.
ECHOLOOP_SIMD void scatter_alike(const float* law, const float* __restrict echo,
                                 const float* __restrict noise, NoisePowers noise_powers, std::size_t count,
                                 float* __restrict power) {
    float terms_of[law_terms];
    for (int k = 0; k < law_terms; ++k) terms_of[k] = law[k];
    for (std::size_t i = 0; i < count; ++i) {
        const Together both = together(power[i], noise_powers, echo[i], noise[i]);
        float root = terms_of[law_terms - 1];
#pragma GCC unroll 8
        for (int k = law_terms - 2; k >= 0; --k) root = root * both.z + terms_of[k];
        power[i] = both.whole * cube(std::max(root, 0.0F));
    }
}

ECHOLOOP_SIMD void scatter_between(Normals echo, Normals noise, NoisePowers noise_powers, std::size_t count,
                                   float* power) {
    float base[law_terms], more[law_terms];
    for (int k = 0; k < law_terms; ++k) base[k] = noise.root[k], more[k] = echo.root[k] - noise.root[k];
    for (std::size_t i = 0; i < count; ++i) {
        const Together both = together(power[i], noise_powers, echo.z[i], noise.z[i]);
        float root = base[law_terms - 1] + both.share * more[law_terms - 1];
#pragma GCC unroll 8
        for (int k = law_terms - 2; k >= 0; --k) root = root * both.z + (base[k] + both.share * more[k]);
        power[i] = both.whole * cube(std::max(root, 0.0F));
    }
}

}  // namespace

void scatter(Normals echo, Normals noise, NoisePowers noise_powers, std::size_t count, float* power) {
    if (std::equal(echo.root, echo.root + law_terms, noise.root))
        scatter_alike(echo.root, echo.z, noise.z, noise_powers, count, power);
    else
        scatter_between(echo, noise, noise_powers, count, power);
}

ECHOLOOP_SIMD void multiply_by_law(const float* law, const float* z, std::size_t count, float* power) {
    float terms_of[law_terms];
    for (int k = 0; k < law_terms; ++k) terms_of[k] = law[k];
    for (std::size_t i = 0; i < count; ++i) {
        const float x = std::min(std::max(z[i], -law_end), law_end);
        float root = terms_of[law_terms - 1];
#pragma GCC unroll 8
        for (int k = law_terms - 2; k >= 0; --k) root = root * x + terms_of[k];
        power[i] *= cube(std::max(root, 0.0F));
    }
}

ECHOLOOP_SIMD void interfere(const float* other, const float* cosine, float looks, std::size_t count,
                             float* power) {
    const float cross = 2 / std::sqrt(looks);
    // Roots first: the product of two powers may be beyond a float.
    for (std::size_t i = 0; i < count; ++i)
        power[i] += other[i] + cross * (std::sqrt(power[i]) * std::sqrt(other[i])) * cosine[i];
}

ECHOLOOP_SIMD void blend(std::array<float, 4> weights, const float* a, const float* b, std::size_t count,
                         float* out) {
    for (std::size_t i = 0; i < count; ++i)
        out[i] = (weights[0] * a[i] + weights[1] * a[i + 1]) + (weights[2] * b[i] + weights[3] * b[i + 1]);
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

namespace {

constexpr std::size_t heard_together = 32;

/// hear_cells() of some bins, no more than `heard_together`, whose sums stay in registers where that number
/// is known.
ECHOLOOP_INLINE void hear_some(const CellFields& cells, const float* places, std::size_t begin,
                               std::size_t count, float* out) {
    float sum[heard_together], energy[heard_together];
    const auto weight_at = [&](std::size_t k, std::size_t i) {
        const float distance = places[begin + i] - static_cast<float>(cells.first + static_cast<int>(k));
        const float s = std::min(distance * distance * cells.per_reach, 1.0F), rest = 1 - s;
        return rest * rest * (1 + cells.middle * s);
    };
    for (std::size_t i = 0; i < count; ++i) {
        const float weight = weight_at(0, i);
        sum[i] = weight * cells.fields[0][begin + i];
        energy[i] = weight * weight;
    }
    for (std::size_t k = 1; k < cells.count; ++k) {
        const float* field = cells.fields[k] + begin;
        for (std::size_t i = 0; i < count; ++i) {
            const float weight = weight_at(k, i);
            sum[i] += weight * field[i];
            energy[i] += weight * weight;
        }
    }
    for (std::size_t i = 0; i < count; ++i) out[begin + i] = sum[i] / std::sqrt(energy[i]);
}

}  // namespace

ECHOLOOP_SIMD void hear_cells(const CellFields& cells, const float* places, std::size_t count, float* out) {
    const std::size_t whole = count / heard_together * heard_together;
    for (std::size_t begin = 0; begin < whole; begin += heard_together)
        hear_some(cells, places, begin, heard_together, out);
    hear_some(cells, places, whole, count - whole, out);
}

ECHOLOOP_SIMD bool differ(const float* a, const float* b, float ratio, float least, std::size_t count) {
    int more = 0;
    for (std::size_t i = 0; i < count; ++i)
        more |= static_cast<int>(a[i] > ratio * b[i] + least) | static_cast<int>(b[i] > ratio * a[i] + least);
    return more != 0;
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

ECHOLOOP_SIMD void add_log_ratio(float scale, const float* a, const float* b, std::size_t count, float* out) {
    constexpr float nothing = 1e-12F;
    for (std::size_t i = 0; i < count; ++i)
        out[i] += scale * vector_math::log(std::max(a[i], nothing) / std::max(b[i], nothing));
}

ECHOLOOP_SIMD void limit(float most, std::size_t count, float* values) {
    for (std::size_t i = 0; i < count; ++i) values[i] = std::min(std::max(values[i], -most), most);
}

/// Part of shift(): a pair in memory keeps the loop from becoming vectors, and so do the least and the
/// greatest of floats. Of whole numbers they do not.
ECHOLOOP_SIMD void shift_and_bound(float by, std::size_t count, float* __restrict places, std::int32_t* least,
                                   std::int32_t* most) {
    std::int32_t low = std::numeric_limits<std::int32_t>::max(),
                 high = std::numeric_limits<std::int32_t>::min();
    for (std::size_t i = 0; i < count; ++i) {
        const float place = places[i] + by;
        places[i] = place;
        const auto whole = static_cast<std::int32_t>(place);
        const std::int32_t below = whole - static_cast<std::int32_t>(place < static_cast<float>(whole));
        low = below < low ? below : low;
        high = below > high ? below : high;
    }
    *least = low, *most = high;
}

std::pair<int, int> shift(float by, std::size_t count, float* places) {
    std::int32_t least = 0, most = 0;
    shift_and_bound(by, count, places, &least, &most);
    return {least, most};
}

ECHOLOOP_SIMD void receive(float limit, std::size_t count, float* power) {
    if (limit < INFINITY)
        for (std::size_t i = 0; i < count; ++i) power[i] = std::min(power[i], limit);
}

}  // namespace echoloop::kernels
