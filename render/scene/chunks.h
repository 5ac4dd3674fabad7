// Cuts triangles into spatially compact groups, by halving at the median along the longest axis.
// Deterministic.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/pose.h"

namespace echoloop {

inline constexpr std::size_t chunk_triangles = 2000;

/// Groups of at most chunk_triangles triangle numbers; those of a larger mesh hold 1000 or more. Triangle t
/// has the corners positions[indices[3 t + 0..2]].
std::vector<std::vector<std::uint32_t>> cut_into_chunks(std::span<const Vec3> positions,
                                                        std::span<const std::uint32_t> indices);

}  // namespace echoloop
