// The sections of R2Sonic's water column, snippets and TruePix packets as plain structs. No wire code:
// water_layouts.h says how they stand in a datagram.
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/r2sonic/sections.h"

namespace echoloop::r2sonic {

/// The H0 of SNI0 and TPX0, 140 bytes. Where H0 has its number of points SNI0 has the snippets of the ping;
/// in TPX0 it is reserved (0), as are the six bytes before it.
struct LongH0 {
    H0 settings;
    More more{};

    friend bool operator==(const LongH0&, const LongH0&) = default;
};

/// A part of the water column, magnitude only; data is beam-major, `beams` times `samples`.
struct M1 {
    std::uint32_t ping_number = 0;  ///< equals H0's
    float reserved8 = 0;
    std::uint32_t total_samples = 0;  ///< range samples of the ping, at the H0 sample rate
    std::uint32_t first_sample = 0;
    std::uint16_t samples = 0;
    std::uint16_t total_beams = 0;  ///< multiple of 2
    std::uint16_t first_beam = 0;   ///< multiple of 2
    std::uint16_t beams = 0;        ///< multiple of 2
    std::uint32_t reserved28 = 0;
    std::uint32_t reserved32 = 0;
    std::vector<std::uint16_t> data;  ///< written as exactly beams * samples numbers

    friend bool operator==(const M1&, const M1&) = default;
};

/// Magnitude, and the angle inside the beam in units that are not public.
struct MagnitudePhase {
    std::uint16_t magnitude = 0;
    std::int16_t phase = 0;

    friend bool operator==(const MagnitudePhase&, const MagnitudePhase&) = default;
};

/// A part of the water column, magnitude and phase; else as M1.
struct M2 {
    std::uint32_t ping_number = 0;
    float reserved8 = 0;
    std::uint32_t total_samples = 0;
    std::uint32_t first_sample = 0;
    std::uint16_t samples = 0;
    std::uint16_t total_beams = 0;
    std::uint16_t first_beam = 0;
    std::uint16_t beams = 0;
    std::uint32_t reserved28 = 0;
    std::uint32_t reserved32 = 0;
    std::vector<MagnitudePhase> data;

    friend bool operator==(const M2&, const M2&) = default;
};

/// The echo of one sounding.
struct S1 {
    std::uint32_t ping_number = 0;
    std::uint16_t snippet = 0;  ///< 0 .. H0's snippets - 1
    std::uint16_t samples = 0;
    std::uint32_t first_sample = 0;  ///< from zero range, at the H0 sample rate
    float angle = 0;                 ///< rad
    float scale_first = 0;           ///< at the first sample; 0: ignore
    float scale_last = 0;            ///< at the last sample, linear between
    std::uint32_t reserved28 = 0;
    std::vector<std::uint16_t> magnitude;

    friend bool operator==(const S1&, const S1&) = default;
};

/// One sample of both sides.
struct SidePair {
    std::uint16_t port = 0;
    std::uint16_t starboard = 0;

    friend bool operator==(const SidePair&, const SidePair&) = default;
};

/// A part of a TruePix ping, magnitude only.
struct D0 {
    std::uint32_t ping_number = 0;
    std::uint32_t total_samples = 0;
    std::uint32_t first_sample = 0;
    std::uint16_t samples = 0;
    std::uint16_t reserved18 = 0;
    std::array<float, 8> scaling{};  ///< 0: ignore
    std::vector<SidePair> data;

    friend bool operator==(const D0&, const D0&) = default;
};

/// One sample of both sides with its direction.
struct AngledPair {
    std::uint16_t port = 0;
    std::int16_t port_angle = 0;  ///< times angle_scale is rad, positive to starboard
    std::uint16_t starboard = 0;
    std::int16_t starboard_angle = 0;

    friend bool operator==(const AngledPair&, const AngledPair&) = default;
};

/// A part of a TruePix ping, magnitude and direction.
struct D1 {
    std::uint32_t ping_number = 0;
    std::uint32_t total_samples = 0;
    std::uint32_t first_sample = 0;
    std::uint16_t samples = 0;
    std::uint16_t reserved18 = 0;
    std::array<float, 8> scaling{};
    float angle_scale = 0;  ///< rad
    std::vector<AngledPair> data;

    friend bool operator==(const D1&, const D1&) = default;
};

}  // namespace echoloop::r2sonic
