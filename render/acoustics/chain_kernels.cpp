#include "render/acoustics/chain_kernels.h"

#include <algorithm>
#include <cmath>

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

/// z of echo and noise together, see scatter(); and what of the mean power is echo.
struct Together {
    float whole, share, z;
};

ECHOLOOP_INLINE Together together(float mean, NoisePowers noise_powers, float echo, float noise) {
    const float whole = mean + noise_powers.beside,
                share = std::max(mean - noise_powers.within, 0.0F) / (whole + smallest);
    const float rest = std::sqrt(std::max(1 - share * share, 0.0F));
    const float z = share * echo + rest * noise;
    return {whole, share, std::min(std::max(z, -law_end), law_end)};
}

/// Echo and noise have one law.
ECHOLOOP_SIMD void scatter_alike(const float* law, const float* __restrict echo,
                                 const float* __restrict noise, NoisePowers noise_powers, std::size_t count,
                                 const float* __restrict mean, float* __restrict power) {
    float terms_of[law_terms];
    for (int k = 0; k < law_terms; ++k) terms_of[k] = law[k];
    for (std::size_t i = 0; i < count; ++i) {
        const Together both = together(mean[i], noise_powers, echo[i], noise[i]);
        float root = terms_of[law_terms - 1];
#pragma GCC unroll 8
        for (int k = law_terms - 2; k >= 0; --k) root = root * both.z + terms_of[k];
        power[i] = both.whole * cube(std::max(root, 0.0F));
    }
}

ECHOLOOP_SIMD void scatter_between(Normals echo, Normals noise, NoisePowers noise_powers, std::size_t count,
                                   const float* __restrict mean, float* __restrict power) {
    float base[law_terms], more[law_terms];
    for (int k = 0; k < law_terms; ++k) base[k] = noise.root[k], more[k] = echo.root[k] - noise.root[k];
    for (std::size_t i = 0; i < count; ++i) {
        const Together both = together(mean[i], noise_powers, echo.z[i], noise.z[i]);
        float root = base[law_terms - 1] + both.share * more[law_terms - 1];
#pragma GCC unroll 8
        for (int k = law_terms - 2; k >= 0; --k) root = root * both.z + (base[k] + both.share * more[k]);
        power[i] = both.whole * cube(std::max(root, 0.0F));
    }
}

}  // namespace

void scatter(Normals echo, Normals noise, NoisePowers noise_powers, std::size_t count, const float* mean,
             float* power) {
    if (std::equal(echo.root, echo.root + law_terms, noise.root))
        scatter_alike(echo.root, echo.z, noise.z, noise_powers, count, mean, power);
    else
        scatter_between(echo, noise, noise_powers, count, mean, power);
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
