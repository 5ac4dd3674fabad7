// What the water column #MWC is made of, as plain structs. No wire code: the layouts say how they stand on
// the wire.
#pragma once

#include <cstdint>

namespace echoloop::kmall {

/// The transmission of a water column.
struct WaterTx {
    std::uint16_t size = 0;
    std::uint16_t sectors = 0;
    std::uint16_t bytes_per_sector = 0;
    std::int16_t padding = 0;
    float heave = 0;

    friend bool operator==(const WaterTx&, const WaterTx&) = default;
};

/// A transmit sector of a water column.
struct WaterSector {
    float tilt = 0;
    float frequency = 0;
    float beam_width = 0;
    std::uint16_t number = 0;
    std::int16_t padding = 0;

    friend bool operator==(const WaterSector&, const WaterSector&) = default;
};

/// The receiver of a water column.
struct WaterRx {
    std::uint16_t size = 0;
    std::uint16_t beams = 0;
    std::uint8_t bytes_per_beam = 0;
    std::uint8_t phase = 0;
    std::uint8_t tvg = 0;
    std::int8_t tvg_offset = 0;
    float sample_rate = 0;
    float sound_speed = 0;

    friend bool operator==(const WaterRx&, const WaterRx&) = default;
};

/// A beam of a water column.
struct WaterBeamInfo {
    float angle = 0;
    std::uint16_t start = 0;
    std::uint16_t detected = 0;
    std::uint16_t sector = 0;
    std::uint16_t samples = 0;
    float detected_fine = 0;

    friend bool operator==(const WaterBeamInfo&, const WaterBeamInfo&) = default;
};

}  // namespace echoloop::kmall
