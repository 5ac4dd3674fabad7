// What the datagrams about the sounder itself are made of, #IIP, #IOP and #SVP, as plain structs. No wire
// code: the layouts say how they stand on the wire.
#pragma once

#include <cstdint>

#include "protocols/wire/text.h"

namespace echoloop::kmall {

/// Installation or runtime parameters; their text follows.
struct ParametersInfo {
    std::uint16_t size = 0;
    std::uint16_t info = 0;
    std::uint16_t status = 0;

    friend bool operator==(const ParametersInfo&, const ParametersInfo&) = default;
};

/// Where and when the sound speed was measured; the points follow.
struct SoundProfileInfo {
    std::uint16_t size = 0;
    std::uint16_t points = 0;
    wire::Text<4> format;
    std::uint32_t seconds = 0;
    double latitude = 0;
    double longitude = 0;

    friend bool operator==(const SoundProfileInfo&, const SoundProfileInfo&) = default;
};

/// The water at a depth.
struct SoundProfilePoint {
    float depth = 0;
    float sound_speed = 0;
    std::uint32_t padding = 0;
    float temperature = 0;
    float salinity = 0;

    friend bool operator==(const SoundProfilePoint&, const SoundProfilePoint&) = default;
};

}  // namespace echoloop::kmall
