// What the packed arrays of a bathymetry packet mean per point: times, angles and quality. Never touches
// bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocols/r2sonic/messages.h"

namespace echoloop::r2sonic {

/// Two-way times in s, one per point of R0.
std::vector<double> two_way_times(const R0& r0);

/// Beam angles in rad, `points` of them (A2: as many as it has steps): A0 spreads them evenly from first to
/// last.
std::vector<double> angles(const A0& a0, std::size_t points);
std::vector<double> angles(const A2& a2);
std::vector<double> angles(const Bth0& packet);

/// Flags of one point, bits of namespace quality; 0 beyond the end.
std::uint8_t quality_of(const Q0& q0, std::size_t point);
/// One nibble per point, point 0 in the top nibble.
Q0 pack_quality(std::span<const std::uint8_t> nibbles);

/// R0 with the given scale (s), each time rounded to the nearest step and held within 0..65535 steps.
R0 pack_times(std::span<const double> seconds, float scale);
/// A2 whose angles follow `radians` (ascending) to half a step each: the largest gap sets the scale.
A2 pack_angles(std::span<const double> radians);

}  // namespace echoloop::r2sonic
