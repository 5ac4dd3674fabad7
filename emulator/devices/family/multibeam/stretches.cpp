#include "emulator/devices/family/multibeam/stretches.h"

#include <cstring>

#include "render/simd.h"

namespace echoloop::multibeam {
namespace {

using Vector2 [[maybe_unused]] = double __attribute__((vector_size(16)));
using Vector4 [[maybe_unused]] = double __attribute__((vector_size(32)));
using Vector8 [[maybe_unused]] = double __attribute__((vector_size(64)));

/// The greatest to[i] - from[i] of so many, at least -1. `Vector` is no wider than the processor's.
template <class Vector>
ECHOLOOP_INLINE double greatest_difference_of(const double* from, const double* to, std::size_t count) {
    constexpr std::size_t lanes = sizeof(Vector) / sizeof(double), at_once = 2;
    Vector most[at_once] = {Vector{} - 1, Vector{} - 1};
    std::size_t i = 0;
    for (; i + at_once * lanes <= count; i += at_once * lanes)
#pragma GCC unroll 2
        for (std::size_t k = 0; k < at_once; ++k) {
            Vector less, more;
            std::memcpy(&less, from + i + k * lanes, sizeof less);
            std::memcpy(&more, to + i + k * lanes, sizeof more);
            const Vector difference = more - less;
            most[k] = most[k] < difference ? difference : most[k];
        }
    double greatest = -1;
    for (const Vector& one : most)
        for (std::size_t k = 0; k < lanes; ++k) greatest = std::max(greatest, one[k]);
    for (; i < count; ++i) greatest = std::max(greatest, to[i] - from[i]);
    return greatest;
}

#ifdef ECHOLOOP_SIMD_VERSIONS
__attribute__((target("arch=x86-64-v4"))) double greatest_difference(const double* from, const double* to,
                                                                     std::size_t count) {
    return greatest_difference_of<Vector8>(from, to, count);
}

__attribute__((target("arch=x86-64-v3"))) double greatest_difference(const double* from, const double* to,
                                                                     std::size_t count) {
    return greatest_difference_of<Vector4>(from, to, count);
}

__attribute__((target("default")))
#endif
double
greatest_difference(const double* from, const double* to, std::size_t count) {
    return greatest_difference_of<Vector2>(from, to, count);
}

}  // namespace

std::size_t Stretches::peak(double least) {
    constexpr std::size_t block = 128;  // bins whose greatest mean tells whether they are looked at
    std::size_t best = 0;
    double most = -1;
    const auto take = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double power = mean(i);
            if (!(power > least)) continue;
            const double gained = with_gain(power, i);
            if (gained > most || (gained == most && i < best)) best = i, most = gained;
        }
    };
    blocks_.clear();
    for (std::size_t begin = 0; begin < size();) {
        const std::size_t h = half(begin), end = next_length(begin);
        // The window's begin cuts the footprint off before these, and its end behind them.
        const std::size_t last = std::clamp(size() - std::min(size(), h), begin, end);
        const std::size_t first = std::clamp(h, begin, last);
        take(begin, first);
        for (std::size_t at = first; at < last; at += block) {
            const std::size_t count = std::min(block, last - at);
            const double *from = &sum_[at - h], *to = &sum_[at + h + 1];
            const double greatest = greatest_difference(from, to, count);
            const double power = greatest / static_cast<double>(2 * h + 1);
            if (power > least) blocks_.push_back({at, count, with_gain(power, at + count - 1)});
        }
        take(last, end);
        begin = end;
    }
    // The one that promises most comes first: then hardly any other does.
    const auto promise = std::ranges::max_element(blocks_, {}, &Block::most);
    if (promise != blocks_.end()) take(promise->begin, promise->begin + promise->count);
    for (const Block& one : blocks_)
        if (one.most >= most) take(one.begin, one.begin + one.count);
    return best;
}

std::size_t Stretches::next_length(std::size_t i) const {
    if (!(slope_ > 0)) return size();
    const double next = std::ceil((static_cast<double>(half(i)) - first_half_) / slope_);
    return static_cast<std::size_t>(
        std::clamp(next, static_cast<double>(i + 1), static_cast<double>(size())));
}

}  // namespace echoloop::multibeam
