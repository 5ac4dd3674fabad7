// Logarithm, exponential, sine and cosine for loops that the compiler turns into SIMD, made of operations
// that IEEE 754 rounds exactly: with contraction to FMA off, every processor gives the same bits. Never calls
// the C library.
#pragma once

#include <bit>
#include <cstdint>

#include "render/simd.h"

namespace echoloop::vector_math {

/// Within (0, 1): an odd multiple of 2^-24, exact.
ECHOLOOP_INLINE float uniform(std::uint32_t word) {
    return static_cast<float>(static_cast<std::int32_t>(word >> 9) * 2 + 1) * 0x1p-24F;
}

/// Natural logarithm of a normal float x > 0, |error| < 2e-7 relative to max(1, |ln x|). Polynomial: S.
/// Moshier's Cephes library, logf (1989).
ECHOLOOP_INLINE float log(float x) {
    const auto bits = std::bit_cast<std::int32_t>(x);
    const std::int32_t shifted = bits - 0x3F3504F3;  // of sqrt(1/2): m is within sqrt(1/2)..sqrt(2)
    const std::int32_t exponent = shifted >> 23;
    const float m = std::bit_cast<float>(bits - exponent * (1 << 23)) - 1.0F,
                e = static_cast<float>(exponent);
    float p = 7.0376836292e-2F;
    p = p * m - 1.1514610310e-1F;
    p = p * m + 1.1676998740e-1F;
    p = p * m - 1.2420140846e-1F;
    p = p * m + 1.4249322787e-1F;
    p = p * m - 1.6668057665e-1F;
    p = p * m + 2.0000714765e-1F;
    p = p * m - 2.4999993993e-1F;
    p = p * m + 3.3333331174e-1F;
    const float square = m * m;
    const float low = p * m * square - 2.12194440e-4F * e - 0.5F * square;
    return m + low + 0.693359375F * e;
}

/// e to the power of x, |relative error| < 2e-7; 0 or infinity come out as 1e-38 and 1e38. Polynomial:
/// Cephes, expf.
ECHOLOOP_INLINE float exp(float x) {
    constexpr float most = 87.3F, rounder = 1.5F * 0x1p23F;
    x = x > most ? most : x;
    x = x < -most ? -most : x;
    const float whole = (x * 1.44269504F + rounder) - rounder;
    const float r = (x - whole * 0.693359375F) + whole * 2.12194440e-4F;
    float p = 1.9875691500e-4F;
    p = p * r + 1.3981999507e-3F;
    p = p * r + 8.3334519073e-3F;
    p = p * r + 4.1665795894e-2F;
    p = p * r + 1.6666665459e-1F;
    p = p * r + 5.0000001201e-1F;
    p = p * r * r + r + 1.0F;
    return p * std::bit_cast<float>((static_cast<std::int32_t>(whole) + 127) * (1 << 23));
}

struct Direction {
    float cosine, sine;
};

/// A unit vector of uniform direction. Polynomials: Cephes, sinf and cosf.
ECHOLOOP_INLINE Direction direction(std::uint32_t word) {
    constexpr float eighth = 0.78539816339744831F;
    const auto fraction = static_cast<float>(static_cast<std::int32_t>(word & 0x3FFFFF00U) >> 7);  // 0..2^23
    const float a = (fraction * 0x1p-22F - 1.0F) * eighth, z = a * a;
    float s = -1.9515295891e-4F, c = 2.443315711809948e-5F;
    s = s * z + 8.3321608736e-3F;
    s = s * z - 1.6666654611e-1F;
    s = s * z * a + a;
    c = c * z - 1.388731625493765e-3F;
    c = c * z + 4.166664568298827e-2F;
    c = c * z * z - 0.5F * z + 1.0F;
    // Turned by the quadrant that the two highest bits say. As masks: of single bits g++ 14 makes truth
    // values, and then no vectors.
    constexpr std::uint32_t sign = 0x80000000U;
    const auto odd = static_cast<std::uint32_t>(static_cast<std::int32_t>(word << 1) >> 31);
    const auto cb = std::bit_cast<std::uint32_t>(c), sb = std::bit_cast<std::uint32_t>(s);
    const std::uint32_t x = (cb & ~odd) | (sb & odd), y = (sb & ~odd) | (cb & odd);
    return {std::bit_cast<float>(x ^ ((word + (sign >> 1)) & sign)), std::bit_cast<float>(y ^ (word & sign))};
}

}  // namespace echoloop::vector_math
