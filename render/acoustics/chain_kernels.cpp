#include "render/acoustics/chain_kernels.h"

#include <algorithm>
#include <cmath>

#include "render/acoustics/vector_math.h"

namespace echoloop::kernels {

ECHOLOOP_SIMD void modulate(const float* power, const float* field_real, const float* field_imaginary,
                            std::size_t count, float* real, float* imaginary) {
    for (std::size_t i = 0; i < count; ++i) {
        const float amplitude = std::sqrt(power[i]);
        real[i] = amplitude * field_real[i];
        imaginary[i] = amplitude * field_imaginary[i];
    }
}

ECHOLOOP_SIMD void add(float scale, const float* a, const float* b, std::size_t count, float* real,
                       float* imaginary) {
    for (std::size_t i = 0; i < count; ++i) {
        real[i] += scale * a[i];
        imaginary[i] += scale * b[i];
    }
}

ECHOLOOP_SIMD void blend(float weight, const float* a, float other_weight, const float* b, std::size_t count,
                         float* out) {
    for (std::size_t i = 0; i < count; ++i) out[i] = weight * a[i] + other_weight * b[i];
}

ECHOLOOP_SIMD void intensity(const float* real, const float* imaginary, std::size_t count, float* power) {
    for (std::size_t i = 0; i < count; ++i) power[i] = real[i] * real[i] + imaginary[i] * imaginary[i];
}

ECHOLOOP_SIMD void add_intensity(const float* real, const float* imaginary, std::size_t count, float* power) {
    for (std::size_t i = 0; i < count; ++i) power[i] += real[i] * real[i] + imaginary[i] * imaginary[i];
}

ECHOLOOP_SIMD void multiply(const float* factor, std::size_t count, float* power) {
    for (std::size_t i = 0; i < count; ++i) power[i] *= factor[i];
}

ECHOLOOP_SIMD void square_root(const float* power, std::size_t count, float* amplitude) {
    for (std::size_t i = 0; i < count; ++i) amplitude[i] = std::sqrt(power[i]);
}

ECHOLOOP_SIMD void interfere(float scale, float* power, float other_scale, const float* other,
                             const float* cosine, float looks, std::size_t count) {
    const float cross = 2 / std::sqrt(looks);
    for (std::size_t i = 0; i < count; ++i) {
        // Roots first: the product of two powers may be beyond a float.
        const float a = scale * power[i], b = other_scale * other[i];
        power[i] = a + b + cross * (std::sqrt(a) * std::sqrt(b)) * cosine[i];
    }
}

ECHOLOOP_SIMD bool differ(const float* a, const float* b, float ratio, float least, std::size_t count) {
    int more = 0;
    for (std::size_t i = 0; i < count; ++i)
        more |= static_cast<int>(a[i] > ratio * b[i] + least) | static_cast<int>(b[i] > ratio * a[i] + least);
    return more != 0;
}

ECHOLOOP_SIMD void add_log_ratio(float scale, const float* a, const float* b, std::size_t count, float* out) {
    constexpr float nothing = 1e-12F;
    for (std::size_t i = 0; i < count; ++i)
        out[i] += scale * vector_math::log(std::max(a[i], nothing) / std::max(b[i], nothing));
}

ECHOLOOP_SIMD void limit(float most, std::size_t count, float* values) {
    for (std::size_t i = 0; i < count; ++i) values[i] = std::min(std::max(values[i], -most), most);
}

/// Part of shift(): a pair in memory keeps the loop from becoming vectors.
ECHOLOOP_SIMD void shift_and_bound(float by, std::size_t count, float* places, float* least, float* most) {
    float low = places[0] + by, high = low;
    for (std::size_t i = 0; i < count; ++i) {
        places[i] += by;
        low = std::min(low, places[i]);
        high = std::max(high, places[i]);
    }
    *least = low;
    *most = high;
}

std::pair<int, int> shift(float by, std::size_t count, float* places) {
    float least = 0, most = 0;
    shift_and_bound(by, count, places, &least, &most);
    return {static_cast<int>(std::floor(least)), static_cast<int>(std::floor(most))};
}

ECHOLOOP_SIMD void add_cell(const float* place, float cell, const float* field, std::size_t count,
                            float* out) {
    for (std::size_t i = 0; i < count; ++i) {
        const float weight = std::max(1 - std::abs(place[i] - cell), 0.0F);
        out[i] += weight * field[i];
    }
}

ECHOLOOP_SIMD void even_out(const float* place, std::size_t count, float* real, float* imaginary) {
    for (std::size_t i = 0; i < count; ++i) {
        const float share = place[i] - std::floor(place[i]), rest = 1 - share;
        const float scale = 1 / std::sqrt(rest * rest + share * share);
        real[i] *= scale;
        imaginary[i] *= scale;
    }
}

ECHOLOOP_SIMD void interfere_between(const float* place, float cell, const float* a, const float* b,
                                     const float* cosine, float looks, std::size_t count, float* out) {
    const float cross = 2 / std::sqrt(looks);
    for (std::size_t i = 0; i < count; ++i) {
        const float share = place[i] - cell, rest = 1 - share;
        const float scale = 1 / (rest * rest + share * share);
        const float mixed = scale * (rest * rest * a[i] + share * share * b[i] +
                                     cross * rest * share * std::sqrt(a[i] * b[i]) * cosine[i]);
        out[i] = share >= 0 && share < 1 ? mixed : out[i];
    }
}

ECHOLOOP_SIMD void receive(float limit, std::size_t count, float* power) {
    if (limit < INFINITY)
        for (std::size_t i = 0; i < count; ++i) power[i] = std::min(power[i], limit);
}

}  // namespace echoloop::kernels
