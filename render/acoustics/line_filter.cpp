#include "render/acoustics/line_filter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/acoustics/vector_math.h"

namespace echoloop {
namespace {

/// convolve() with so many taps, whose sums stay in registers.
template <std::size_t N>
ECHOLOOP_INLINE void convolve_few(const float* __restrict in, std::size_t count, const float* taps,
                                  float* __restrict out) {
    float tap[N];
    for (std::size_t k = 0; k < N; ++k) tap[k] = taps[k];
    for (std::size_t j = 0; j < count; ++j) {
        float sum = tap[0] * in[j];
#pragma GCC unroll 8
        for (std::size_t k = 1; k < N; ++k) sum += tap[k] * *(in + j - k);
        out[j] = sum;
    }
}

/// The first tap begins the sums: g++ makes zeros with an instruction that takes as long as ten taps.
ECHOLOOP_SIMD void convolve_many(const float* in, std::size_t count, const float* taps, std::size_t tap_count,
                                 float* out) {
    constexpr std::size_t tile = LineFilter::tile;
    float sum[tile];
    for (std::size_t j = 0; j < count; j += tile) {
        for (std::size_t i = 0; i < tile; ++i) sum[i] = taps[0] * in[j + i];
        for (std::size_t k = 1; k < tap_count; ++k) {
            const float* from = in + j - k;
            for (std::size_t i = 0; i < tile; ++i) sum[i] += taps[k] * from[i];
        }
        const std::size_t used = std::min(tile, count - j);
        if (used == tile)
            for (std::size_t i = 0; i < tile; ++i) out[j + i] = sum[i];
        else
            std::copy_n(sum, used, out + j);
    }
}

/// False: there are more.
ECHOLOOP_SIMD bool convolve_if_few(const float* in, std::size_t count, const float* taps,
                                   std::size_t tap_count, float* out) {
    switch (tap_count) {
        case 1:
            convolve_few<1>(in, count, taps, out);
            return true;
        case 2:
            convolve_few<2>(in, count, taps, out);
            return true;
        case 3:
            convolve_few<3>(in, count, taps, out);
            return true;
        case 4:
            convolve_few<4>(in, count, taps, out);
            return true;
        case 5:
            convolve_few<5>(in, count, taps, out);
            return true;
        case 6:
            convolve_few<6>(in, count, taps, out);
            return true;
        case 7:
            convolve_few<7>(in, count, taps, out);
            return true;
        case 8:
            convolve_few<8>(in, count, taps, out);
            return true;
        default:
            return false;
    }
}

/// out[j] = sum over k of taps[k] in[j - k]; reads `count` rounded up to whole tiles, and taps - 1 before.
void convolve(const float* in, std::size_t count, const float* taps, std::size_t tap_count, float* out) {
    if (!convolve_if_few(in, count, taps, tap_count, out)) convolve_many(in, count, taps, tap_count, out);
}

/// data[j] = weight * (sum of the `length` bins that end at j), in place, by sums from block borders (van
/// Herk, Pattern Recognition Letters 13 (1992) 517): no term is ever subtracted, so a loud echo leaves no
/// rounding error behind.
void box_sum(std::span<float> data, std::size_t length, float weight, std::vector<float>& scratch) {
    const std::size_t count = data.size();
    scratch.resize(std::max(scratch.size(), 2 * count));
    float *head = scratch.data(),
          *tail = head + count;  // sums within blocks, from their beginnings and their ends
    for (std::size_t begin = 0; begin < count; begin += length) {
        const std::size_t end = std::min(begin + length, count);
        float sum = 0;
        for (std::size_t i = begin; i < end; ++i) head[i] = sum += data[i];
        sum = 0;
        for (std::size_t i = end; i-- > begin;) tail[i] = sum += data[i];
    }
    for (std::size_t i = 0; i < std::min(length, count); ++i) data[i] = weight * head[i];
    for (std::size_t begin = length; begin < count; begin += length) {
        const std::size_t end = std::min(begin + length, count);
        for (std::size_t i = begin; i < std::min(end, begin + length - 1); ++i)
            data[i] = weight * (head[i] + tail[i + 1 - length]);
        if (end == begin + length) data[end - 1] = weight * head[end - 1];  // the block itself
    }
}

}  // namespace

LineFilter::LineFilter(std::ptrdiff_t first, std::vector<float> taps)
    : first_(first), taps_(std::move(taps)) {
    if (taps_.empty()) throw std::invalid_argument("a line filter has at least one tap");
}

LineFilter LineFilter::boxed(double length, std::size_t smoothing, std::ptrdiff_t first,
                             std::vector<float> taps) {
    LineFilter out(first, std::move(taps));
    out.box_ = static_cast<std::size_t>(length);
    out.rest_ = static_cast<float>(length - std::floor(length));
    out.smoothing_ = smoothing;
    return out;
}

LineFilter LineFilter::moved(float share) const {
    LineFilter out = *this;
    out.first_ = first_ - 1;
    out.taps_.assign(taps_.size() + 1, 0.0F);
    for (std::size_t k = 0; k < taps_.size(); ++k)
        out.taps_[k] += share * taps_[k], out.taps_[k + 1] = (1 - share) * taps_[k];
    return out;
}

std::size_t LineFilter::before() const {
    const auto taps = first_ + static_cast<std::ptrdiff_t>(taps_.size()) - 1;
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(taps, 0)) + box_ + smoothing_;
}

std::size_t LineFilter::after() const {
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(-first_, 0));
}

void LineFilter::apply(std::span<float> padded, std::size_t count, float* out,
                       std::vector<float>& scratch) const {
    if (box_ > 0) {
        scratch.resize(std::max(scratch.size(), 3 * padded.size()));
        std::copy(padded.begin(), padded.end(), scratch.end() - static_cast<std::ptrdiff_t>(padded.size()));
        const float* original = scratch.data() + scratch.size() - padded.size();
        box_sum(padded, box_, 1, scratch);
        for (std::size_t i = box_; i < padded.size(); ++i) padded[i] += rest_ * original[i - box_];
        if (smoothing_ > 1) box_sum(padded, smoothing_, 1.0F / static_cast<float>(smoothing_), scratch);
    }
    const float* start = padded.data() + static_cast<std::ptrdiff_t>(before()) - first_;
    convolve(start, count, taps_.data(), taps_.size(), out);
}

void LineFilter::filter(std::span<const float> values, float* out) const {
    const std::size_t count = values.size(), begin = std::min(before(), count),
                      end = count - std::min(after(), count - begin);
    const auto taps = static_cast<std::ptrdiff_t>(taps_.size()), all = static_cast<std::ptrdiff_t>(count);
    const auto at_an_end = [&](std::size_t j) {
        float sum = 0;
        for (std::ptrdiff_t k = 0; k < taps; ++k) {
            const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(j) - first_ - k;
            if (0 <= i && i < all)
                sum += taps_[static_cast<std::size_t>(k)] * values[static_cast<std::size_t>(i)];
        }
        return sum;
    };
    for (std::size_t j = 0; j < begin; ++j) out[j] = at_an_end(j);
    if (begin < end)
        convolve_if_few(values.data() + (static_cast<std::ptrdiff_t>(begin) - first_), end - begin,
                        taps_.data(), taps_.size(), out + begin);
    for (std::size_t j = end; j < count; ++j) out[j] = at_an_end(j);
}

}  // namespace echoloop
