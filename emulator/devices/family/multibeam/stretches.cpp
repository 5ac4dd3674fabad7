#include "emulator/devices/family/multibeam/stretches.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include "render/simd.h"

namespace echoloop::multibeam {
namespace {

/// Vectors of so many bins, of which that of doubles is no wider than the processor's.
struct TwoBins {
    using Doubles = double __attribute__((vector_size(16)));
    using Floats = float __attribute__((vector_size(8)));
    using Bits = std::int32_t __attribute__((vector_size(8)));
};
struct FourBins {
    using Doubles = double __attribute__((vector_size(32)));
    using Floats = float __attribute__((vector_size(16)));
    using Bits = std::int32_t __attribute__((vector_size(16)));
};
struct EightBins {
    using Doubles = double __attribute__((vector_size(64)));
    using Floats = float __attribute__((vector_size(32)));
    using Bits = std::int32_t __attribute__((vector_size(32)));
};

/// The greatest to[i] - from[i] of so many, at least -1.
template <class Vectors>
ECHOLOOP_INLINE double greatest_difference_of(const double* from, const double* to, std::size_t count) {
    using Doubles = typename Vectors::Doubles;
    constexpr std::size_t at_once = 2, lanes = sizeof(Doubles) / sizeof(double);
    Doubles most[at_once] = {Doubles{} - 1, Doubles{} - 1};
    std::size_t i = 0;
    for (; i + at_once * lanes <= count; i += at_once * lanes)
#pragma GCC unroll 2
        for (std::size_t k = 0; k < at_once; ++k) {
            Doubles less, more;
            std::memcpy(&less, from + i + k * lanes, sizeof less);
            std::memcpy(&more, to + i + k * lanes, sizeof more);
            const Doubles difference = more - less;
            most[k] = most[k] < difference ? difference : most[k];
        }
    double greatest = -1;
    for (const Doubles& one : most)
        for (std::size_t k = 0; k < lanes; ++k) greatest = std::max(greatest, one[k]);
    for (; i < count; ++i) greatest = std::max(greatest, to[i] - from[i]);
    return greatest;
}

/// Of a block: the sum of the bins that count, and the greatest of them.
struct BlockSum {
    double sum = 0;
    float top = 0;
};

/// Copies them, zeros for the others. The bits of what is not negative rise with it.
template <class Vectors>
ECHOLOOP_INLINE BlockSum pick_of(const float* bins, const float* least, std::size_t count, float* counted) {
    using Doubles = typename Vectors::Doubles;
    using Floats = typename Vectors::Floats;
    using Bits = typename Vectors::Bits;
    constexpr std::size_t lanes = sizeof(Doubles) / sizeof(double);
    Doubles sums{};
    Bits tops{};
    for (std::size_t i = 0; i < count; i += lanes) {
        Floats values, bounds;
        std::memcpy(&values, bins + i, sizeof values);
        std::memcpy(&bounds, least + i, sizeof bounds);
        values = values >= bounds ? values : Floats{};
        std::memcpy(counted + i, &values, sizeof values);
        sums += __builtin_convertvector(values, Doubles);
        Bits bits;
        std::memcpy(&bits, &values, sizeof bits);
        tops = tops > bits ? tops : bits;
    }
    BlockSum out;
    std::int32_t top = 0;
    for (std::size_t k = 0; k < lanes; ++k) out.sum += sums[k], top = std::max(top, tops[k]);
    out.top = std::bit_cast<float>(top);
    return out;
}

#ifdef ECHOLOOP_SIMD_VERSIONS
__attribute__((target("arch=x86-64-v4"))) double greatest_difference(const double* from, const double* to,
                                                                     std::size_t count) {
    return greatest_difference_of<EightBins>(from, to, count);
}
__attribute__((target("arch=x86-64-v4"))) BlockSum pick(const float* bins, const float* least,
                                                        std::size_t count, float* counted) {
    return pick_of<EightBins>(bins, least, count, counted);
}

__attribute__((target("arch=x86-64-v3"))) double greatest_difference(const double* from, const double* to,
                                                                     std::size_t count) {
    return greatest_difference_of<FourBins>(from, to, count);
}
__attribute__((target("arch=x86-64-v3"))) BlockSum pick(const float* bins, const float* least,
                                                        std::size_t count, float* counted) {
    return pick_of<FourBins>(bins, least, count, counted);
}

__attribute__((target("default")))
#endif
double
greatest_difference(const double* from, const double* to, std::size_t count) {
    return greatest_difference_of<TwoBins>(from, to, count);
}
#ifdef ECHOLOOP_SIMD_VERSIONS
__attribute__((target("default")))
#endif
BlockSum
pick(const float* bins, const float* least, std::size_t count, float* counted) {
    return pick_of<TwoBins>(bins, least, count, counted);
}

}  // namespace

void Stretches::add_up(std::span<const float> beam, std::span<const float> least) {
    size_ = beam.size();
    const std::size_t whole = size_ / block, blocks = whole + 1;
    counted_.resize(blocks * block);
    sum_.resize(blocks * block);
    top_.resize(blocks), before_.resize(blocks + 1);
    single_.assign(blocks, 0);
    double before = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
        before_[b] = before;
        const std::size_t first = b * block;
        BlockSum all;
        if (b < whole) {
            // Beams lie one behind the other: the next one comes while this one is looked at.
            prefetch(beam.data() + first + prefetched, block);
            all = pick(&beam[first], &least[first], block, &counted_[first]);
        } else {
            float bins[block] = {}, bounds[block] = {};
            std::ranges::copy(beam.subspan(first), bins);
            std::ranges::copy(least.subspan(first), bounds);
            all = pick(bins, bounds, block, &counted_[first]);
        }
        before += all.sum;
        top_[b] = all.top;
    }
    before_[blocks] = before;
}

/// Four bins are added to each other: one sum would wait for itself at every bin.
void Stretches::add_bins_of(std::size_t number) {
    double before = before_[number];
    for (std::size_t i = number * block; i < (number + 1) * block; i += 4) {
        const float* bin = &counted_[i];
        const double one = bin[0], two = one + bin[1], three = bin[2], four = three + bin[3];
        const double middle = before + two;
        double* sum = &sum_[i];
        sum[0] = before, sum[1] = before + one, sum[2] = middle, sum[3] = middle + three;
        before += two + four;
    }
    single_[number] = 1;
}

double Stretches::bound(std::size_t from, std::size_t to, std::size_t length) const {
    float top = 0;
    double sum = 0;
    for (std::size_t b = from / block; b * block < to; ++b) {
        top = std::max(top, top_[b]);
        sum += before_[b + 1] - before_[b];
    }
    return std::min(static_cast<double>(top), sum / static_cast<double>(length));
}

std::size_t Stretches::peak(double least) {
    constexpr std::size_t together = 128;  // bins that are looked at, or not
    constexpr double rounding = 1 + 1e-9;
    Loudest best;
    candidates_.clear();
    for (std::size_t begin = 0; begin < size();) {
        const std::size_t h = half(begin), length = 2 * h + 1, next = next_length(begin);
        for (std::size_t end = 0; begin < next; begin = end) {
            end = std::min(begin + together, next);
            const double power =
                rounding * bound(begin - std::min(begin, h), std::min(end + h, size()), length);
            if (power > least) candidates_.push_back({begin, end, h, with_gain(power, end - 1)});
        }
    }
    // What promises most comes first: then hardly any other does.
    const auto promise = std::ranges::max_element(candidates_, {}, &Candidates::most);
    if (promise != candidates_.end()) look_at(*promise, least, best);
    for (const Candidates& one : candidates_)
        if (one.most >= best.gained && (cuts(one) || may_have(one, least, best.gained)))
            look_at(one, least, best);
    return best.bin;
}

void Stretches::look_at(const Candidates& all, double least, Loudest& best) {
    const auto take = [&](std::size_t i, double power) {
        if (!(power > least)) return;
        const double gained = with_gain(power, i);
        if (gained > best.gained || (gained == best.gained && i < best.bin)) best = {i, gained};
    };
    if (cuts(all)) {
        for (std::size_t i = all.begin; i < all.end; ++i) take(i, mean(i));
        return;
    }
    constexpr std::size_t few = 16;
    for (Candidates some = all; some.begin < all.end; some.begin = some.end) {
        some.end = std::min(some.begin + few, all.end);
        if (!may_have(some, least, best.gained)) continue;
        const double *from = sums_of(some), *to = from + all.length();
        for (std::size_t i = some.begin; i < some.end; ++i, ++from, ++to)
            take(i, (*to - *from) / static_cast<double>(all.length()));
    }
}

bool Stretches::may_have(const Candidates& all, double least, double most) {
    const double* from = sums_of(all);
    const double sum = greatest_difference(from, from + all.length(), all.end - all.begin);
    const double power = sum / static_cast<double>(all.length());
    return power > least && with_gain(power, all.end - 1) >= most;
}

const double* Stretches::sums_of(const Candidates& all) {
    const std::size_t first = all.begin - all.half;
    for (std::size_t b = first / block; b <= (all.end + all.half) / block; ++b)
        if (!single_[b]) add_bins_of(b);
    return &sum_[first];
}

std::size_t Stretches::next_length(std::size_t i) const {
    if (!(slope_ > 0)) return size();
    const double next = std::ceil((static_cast<double>(half(i)) - first_half_) / slope_);
    return static_cast<std::size_t>(
        std::clamp(next, static_cast<double>(i + 1), static_cast<double>(size())));
}

}  // namespace echoloop::multibeam
