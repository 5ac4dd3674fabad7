#include "render/acoustics/interference.h"

#include <algorithm>
#include <cmath>

#include "render/acoustics/line_noise.h"
#include "render/acoustics/vector_math.h"
#include "render/simd.h"

namespace echoloop {
namespace {

constexpr std::size_t longest_dash = 3;  // bins

/// Power as of Gaussian noise: exponential variables of this mean.
ECHOLOOP_SIMD void add_exponential(std::uint64_t hash, float mean, std::size_t count, float* power) {
    for (std::size_t i = 0; i < count; ++i) {
        const auto word = static_cast<std::uint32_t>(mix(hash, i) >> 32);
        power[i] -= mean * vector_math::log(vector_math::uniform(word));
    }
}

}  // namespace

InterferencePlan::InterferencePlan(const Shot& shot, Effects effects) {
    const Interference* given = shot.receiver.interference.get();
    if (given == nullptr || !effects.has(Effect::interference)) return;
    rule_ = *given;
    any_ = true;
    dashes_ = rule_.dashes * static_cast<double>(shot.bins) * shot.bin_interval;
    beams_ = static_cast<double>(shot.beams());
}

/// Power over that of the noise, 0 for most lines.
double InterferencePlan::lift_of(const LineKey& line) const {
    double added = 0;
    const double place = (line.beam + 0.5) / beams_;
    for (const Interference::Stripe& stripe : rule_.stripes)
        if (place >= stripe.first && place < stripe.last) added += std::pow(10, stripe.lift / 10) - 1;
    const std::uint64_t hash = line_hash(line.key, line.ping, line.beam, LineNoise::lift);
    if (uniform_of(mix(hash, 0)) < rule_.lines) {
        const double db = rule_.lift + rule_.lift_spread * static_cast<double>(normal_of(mix(hash, 1)));
        added += std::max(0.0, std::pow(10, db / 10) - 1);
    }
    return added;
}

void InterferencePlan::add(const LineKey& line, double noise_power, std::span<float> values) const {
    if (!any_) return;
    if (const double added = noise_power * lift_of(line); added > 0)
        add_exponential(line_hash(line.key, line.ping, line.beam, LineNoise::added),
                        static_cast<float>(added), values.size(), values.data());
    if (dashes_ > 0) add_dashes(line, values);
}

/// From dash to dash the free distance is exponential, so that their number is Poisson's.
void InterferencePlan::add_dashes(const LineKey& line, std::span<float> values) const {
    const std::uint64_t hash = line_hash(line.key, line.ping, line.beam, LineNoise::dash);
    const double bins = static_cast<double>(values.size()), gap = bins / dashes_;
    double at = 0;
    for (std::uint64_t i = 0;; i += 3) {
        at -= gap * std::log(uniform_of(mix(hash, i)));
        if (!(at < bins)) return;
        const double db =
            rule_.dash_level + rule_.dash_spread * static_cast<double>(normal_of(mix(hash, i + 1)));
        const auto power = static_cast<float>(std::pow(10, db / 10));
        const double share = uniform_of(mix(hash, i + 2));
        // Recordings: the median is one bin, the ninetieth per cent three.
        const std::size_t length = share < 0.7 ? 1 : share < 0.87 ? 2 : longest_dash;
        const auto first = static_cast<std::size_t>(at), last = std::min(values.size(), first + length);
        for (std::size_t bin = first; bin < last; ++bin) values[bin] += power;
    }
}

}  // namespace echoloop
