// The bytes of an .xtf of a side-scan: a header with a description of each channel, then a packet for each
// ping. Offsets as pyxtf and auvlib read them. Knows no sonar.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "emulator/contract/device.h"

namespace echoloop::convert::xtf {

/// One side at one frequency.
struct Channel {
    bool starboard = false;
    double kilohertz = 0;          ///< 0: not known
    std::size_t sample_bytes = 2;  ///< 1 or 2
};

/// What stands before the sides of a ping. Of what is not there zeros are written.
struct Ping {
    std::int64_t seconds = 0;        ///< since 1970
    std::uint32_t milliseconds = 0;  ///< within the second
    std::uint32_t number = 0;
    float sound_speed = 1500;                                      ///< m/s
    std::optional<float> speed{}, heading{}, depth{}, altitude{};  ///< kn, deg, m, m
    std::optional<std::array<float, 2>> pitch_roll{};              ///< deg
    std::optional<std::array<double, 2>> position{};  ///< latitude, longitude, deg; or north, east, m
};

/// What one channel heard of a ping.
struct Side {
    std::uint16_t channel = 0;  ///< number within the file
    bool starboard = false;
    double slant_range = 0;        ///< m, of the last sample
    double duration = 0;           ///< s, of all samples
    double delay = 0;              ///< s, before the first one
    double kilohertz = 0;          ///< 0: not known
    std::size_t sample_bytes = 2;  ///< 1 or 2
    Bytes samples{};               ///< little-endian, near to far
};

enum class Units { degrees, metres };  ///< of positions

/// `sonar`: its name, at most 15 letters. At most six channels.
Bytes file_header(std::string_view sonar, std::span<const Channel> channels, Units units = Units::degrees);
/// Port goes from far to near, so that both sides lie side by side as a picture.
Bytes packet(const Ping& ping, std::span<const Side> sides);

}  // namespace echoloop::convert::xtf
