#include "emulator/contract/sensors.h"

#include <cmath>
#include <numbers>

#include "emulator/contract/random_key.h"

namespace echoloop {
namespace {

constexpr double knot_interval = 60;  // s, of the drift

/// Within 0..1, never 0.
double uniform(std::uint64_t key) { return (static_cast<double>(split_mix(key) >> 11) + 0.5) * 0x1p-53; }

/// Gaussian, of mean 0 and standard deviation 1 (Box & Muller, 1958).
double normal(std::uint64_t key) {
    return std::sqrt(-2 * std::log(uniform(key))) *
           std::cos(2 * std::numbers::pi * uniform(split_mix(key) ^ 0x5EED));
}

/// Smooth in time, of mean 0 and standard deviation 1: Gaussian numbers at knots, each weighed by the cosine
/// or the sine of the way between two, so that the sum of the squares stays 1.
double slow(std::uint64_t key, Time now) {
    const double at = to_seconds(now) / knot_interval, before = std::floor(at);
    const double turn = (at - before) * std::numbers::pi / 2;
    const auto knot = static_cast<std::uint64_t>(static_cast<std::int64_t>(before));
    return std::cos(turn) * normal(split_mix(key ^ split_mix(knot))) +
           std::sin(turn) * normal(split_mix(key ^ split_mix(knot + 1)));
}

}  // namespace

double Sensors::read(std::string_view name, double truth, const Stray& stray, Time now) const {
    if (!noisy_) return truth;
    const std::uint64_t key = random_key(key_, name);
    if (stray.every > 0) now = from_seconds(stray.every * std::floor(to_seconds(now) / stray.every));
    double reading = truth;
    if (stray.drift > 0) reading += stray.drift * slow(key, now);
    if (stray.noise > 0)
        reading += stray.noise * normal(split_mix(~key ^ split_mix(static_cast<std::uint64_t>(now.count()))));
    return stray.step > 0 ? stray.step * std::round(reading / stray.step) : reading;
}

/// Below 360 as a float, too, which most words are.
double Sensors::read_bearing(std::string_view name, double truth, const Stray& stray, Time now) const {
    const double reading = noisy_ ? std::fmod(read(name, truth, stray, now) + 360, 360) : truth;
    return static_cast<float>(reading) < 360 ? reading : 0;
}

Time Sensors::lateness(const Jitter& jitter, std::uint64_t ping) const {
    if (!jitters_) return {};
    return jitter.step * static_cast<Time::rep>(split_mix(random_key(key_, "pings") ^ split_mix(ping)) %
                                                (std::uint64_t{jitter.most} + 1));
}

}  // namespace echoloop
