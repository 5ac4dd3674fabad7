// The beams of an ARIS: its ping modes, where beams look, and the order of samples on the wire. Data only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace echoloop::aris {

inline constexpr std::size_t channels = 16;  ///< received at once; a ping gives that many beams

struct PingMode {
    std::uint32_t number = 0;
    std::size_t beams = 0;
    std::size_t pings = 0;  ///< of a frame
};

/// nullptr if there is none of that number.
const PingMode* find_ping_mode(std::uint32_t number);

/// deg, of `beams` beams, beam 0 first: it is the right-most, and its angle is negative. Empty if no sonar
/// has that many. The telephoto lens exists for 48 and 96 beams; of 64 and 128 the plain angles are returned.
std::span<const double> centre_angles(std::size_t beams, bool telephoto);

/// Channel c of ping p is beam p + channel_map[c] * pings.
inline constexpr std::size_t channel_map[channels] = {10, 2, 14, 6, 8, 0, 12, 4, 11, 3, 15, 7, 9, 1, 13, 5};

}  // namespace echoloop::aris
