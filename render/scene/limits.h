// How much a scene may ask for. Far above real scenes, far below what would exhaust a machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace echoloop::scene_limits {

inline constexpr std::size_t json_bytes = std::size_t{32} << 20;
inline constexpr std::size_t json_depth = 64;
inline constexpr std::size_t json_values = 2'000'000;  ///< commas and brackets, which bound the parsed size
inline constexpr std::size_t elements = 100'000;       ///< of any one top-level array
inline constexpr std::size_t buffer_bytes = std::size_t{1} << 30;  ///< all buffers together
inline constexpr std::size_t node_depth = 128;
inline constexpr std::size_t triangles = 16'000'000;  ///< after instancing
inline constexpr std::size_t movers = 1000;
inline constexpr std::size_t animation_keys = 1'000'000;  ///< of all channels together
inline constexpr std::size_t point_targets = 1000;
inline constexpr std::size_t faces = 4096;  ///< that mirror the sonar; smaller ones are left out
inline constexpr double target_strength_db = 120;
inline constexpr double extent = 1e5;  ///< m from the origin; beyond, a float is coarser than 1 cm

}  // namespace echoloop::scene_limits
