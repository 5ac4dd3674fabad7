#include "emulator/scenario/variation.h"

#include <boost/math/special_functions/erf.hpp>
#include <boost/random/sobol.hpp>
#include <charconv>
#include <cmath>

#include "emulator/contract/random_key.h"

namespace echoloop::scenario {
namespace {

/// The shortest text that is the number again.
std::string shortest_text(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

/// 0 < u < 1, 53 bits.
double fraction(std::uint64_t bits) { return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53; }

/// One coordinate of Sobol's sequence (Joe & Kuo's numbers, by Boost), shifted by a number of the seed and
/// the key, so that other seeds give other points.
double sobol_point(const Variation& v, std::uint64_t seed, std::uint64_t index, std::size_t dimensions) {
    boost::random::sobol sequence(dimensions);
    sequence.discard(index * dimensions + v.dimension);
    const std::uint64_t point = sequence();
    return fraction(point ^ bits_of_run(seed, v.path, 0));
}

std::string drawn(const Variation& v, double u) {
    switch (v.way) {
        case Way::log_uniform:
            return shortest_text(v.first * std::pow(v.second / v.first, u));
        case Way::normal:
            return shortest_text(v.first + v.second * std::sqrt(2.0) * boost::math::erf_inv(2 * u - 1));
        default:
            return shortest_text(v.first + (v.second - v.first) * u);
    }
}

}  // namespace

std::uint64_t bits_of_run(std::uint64_t seed, const std::string& key, std::uint64_t index) {
    return split_mix(random_key(seed, key) ^ split_mix(index));
}

std::string value_of_run(const Variation& variation, std::uint64_t seed, std::uint64_t index,
                         std::uint64_t digit, std::size_t dimensions) {
    const std::uint64_t bits = bits_of_run(seed, variation.path, index), items = variation.items.size();
    switch (variation.way) {
        case Way::list:
            return variation.items[index % items];
        case Way::grid:
            return variation.items[digit];
        case Way::choice:
            return variation.items[bits % items];
        case Way::sobol:
            return drawn(variation, sobol_point(variation, seed, index, dimensions));
        default:
            return drawn(variation, fraction(bits));
    }
}

}  // namespace echoloop::scenario
