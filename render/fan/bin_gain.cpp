#include "render/fan/bin_gain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/acoustics/vector_math.h"
#include "render/simd.h"

namespace echoloop {
namespace {

constexpr std::size_t bins_of_stretch = 16;

struct NearBins {
    double first, per_metre;  ///< m; bins
    float begin, length;      ///< m, of the first bin and of each
    float limit;              ///< m, beyond which nothing is corrected
    float absorption;         ///< Np/m, of all four
    float over, times;        ///< by the square of range: 1, 0 with spreading; 0, 1 without
};

/// Gains of `count` bins, the middle of the first of which is at `middle`. `absorbed`: of each, times what
/// `power` leaves out.
ECHOLOOP_SIMD
void fill_gains(double middle, double length, bool spreading, double power, const double* __restrict absorbed,
                int count, float* __restrict out) {
    for (int i = 0; i < count; ++i) {
        const double range = middle + static_cast<double>(i) * length, square = range * range;
        out[i] = static_cast<float>(power * absorbed[i] * (spreading ? 1 / square : square));
    }
}

ECHOLOOP_SIMD
int count_nearer(const float* range, float limit, int count) {
    int nearer = 0;
    for (int i = 0; i < count; ++i) nearer += (range[i] > 0) & (range[i] < limit) ? 1 : 0;
    return nearer;
}

ECHOLOOP_SIMD
void correct_all(const NearBins bins, const float* __restrict range, const float* __restrict low,
                 const float* __restrict high, int count, float* __restrict amount) {
    for (int i = 0; i < count; ++i) {
        const double place = (static_cast<double>(range[i]) - bins.first) * bins.per_metre;
        const auto bin = static_cast<float>(std::floor(place));
        const float begin = bins.begin + bin * bins.length, inside = begin > 0 ? begin : 0.0F;
        const float middle = inside + 0.5F * bins.length;
        const float ratio = range[i] / middle, square = ratio * ratio;
        const float spread = bins.over / square + bins.times * square;
        const float factor = spread * vector_math::exp(bins.absorption * (range[i] - middle));
        const bool counts = (range[i] < bins.limit) & (amount[i] > 0) & (high[i] - low[i] < 1);
        const float corrected = amount[i] * factor;
        amount[i] = counts ? corrected : amount[i];
    }
}

}  // namespace

/// The exponential is worked out for the beginning of each stretch and for each bin of the first one.
BinGain::BinGain(const BinningInput& in)
    : absorption_(-4 * in.absorption),
      spreading_(in.spreading),
      first_(in.first_range),
      length_(in.bin_length),
      values_(in.bins) {
    std::array<double, bins_of_stretch> absorbed;
    for (std::size_t i = 0; i < bins_of_stretch; ++i)
        absorbed[i] = std::exp(absorption_ * length_ * static_cast<double>(i));
    for (std::size_t bin = 0; bin < in.bins; bin += bins_of_stretch) {
        const double middle = first_ + (static_cast<double>(bin) + 0.5) * length_;
        fill_gains(middle, length_, spreading_, in.source_power * std::exp(absorption_ * middle),
                   absorbed.data(), static_cast<int>(std::min(bins_of_stretch, in.bins - bin)),
                   &values_[bin]);
    }
}

float BinGain::correction(float range) const {
    const double bin = std::floor((range - first_) / length_), low = first_ + bin * length_;
    return static_cast<float>(at(range) / at(std::max(low, 0.0) + length_ / 2));
}

void BinGain::correct(const float* range, const float* low, const float* high, std::size_t count,
                      float* amount) const {
    const auto f = [](auto value) { return static_cast<float>(value); };
    const NearBins bins{first_,          1 / length_,    f(first_),     f(length_),
                        f(near_limit()), f(absorption_), f(spreading_), f(!spreading_)};
    constexpr std::size_t at_once = 64;
    for (std::size_t i = 0; i < count; i += at_once) {
        const auto these = static_cast<int>(std::min(at_once, count - i));
        if (count_nearer(range + i, bins.limit, these) > 0)
            correct_all(bins, range + i, low + i, high + i, these, amount + i);
    }
}

}  // namespace echoloop
