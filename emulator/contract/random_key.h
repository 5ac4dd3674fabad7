// The key of a device's random numbers, from the scenario's seed and the device's name. Standard library
// only; draws none itself.
#pragma once

#include <cstdint>
#include <string_view>

namespace echoloop {

/// Spreads the bits of a counter: Steele, Lea & Flood, "Fast splittable pseudorandom number generators"
/// (2014).
constexpr std::uint64_t split_mix(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
    return x ^ (x >> 31);
}

/// Shot::random_key of a device: the FNV-1a hash of its name, spread, joined with the seed and spread again.
/// Other names or seeds give independent numbers; the order of devices in the scenario does not matter.
constexpr std::uint64_t random_key(std::uint64_t seed, std::string_view device) {
    std::uint64_t hash = 0xCBF29CE484222325;
    for (const char c : device) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3;
    return split_mix(split_mix(hash) ^ seed);
}

}  // namespace echoloop
