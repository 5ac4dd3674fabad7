// The words of Imagenex heads on their line: one command, one reply. Plain structs that know no bytes.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "protocols/imagenex/packed14.h"
#include "protocols/imagenex/signed14.h"
#include "protocols/wire/bytes.h"
#include "protocols/wire/layout.h"

namespace echoloop::imagenex {

using wire::ByteOrder;
using wire::Tag;

inline constexpr std::uint8_t azimuth_head_id = 0x1F;

/// Second letter of a reply's name.
enum class Kind : std::uint8_t { imx = 'M', igx = 'G', ipx = 'P' };

namespace motion {
inline constexpr std::uint8_t hold = 1, reverse = 0x40;
inline constexpr std::uint8_t start_of_pulse = 1;  ///< 831L: the profile range is where the echo begins
}  // namespace motion
namespace mode {
inline constexpr std::uint8_t transmit = 1, send_data = 2, slave = 0x40, all = 0x43;
}
namespace trigger {
inline constexpr std::uint8_t positive_edge = 1, enable = 2, automatic = 4;
}
namespace status {
inline constexpr std::uint8_t accepted = 0x40;
}
/// Of an 831L, as one public driver has them; another public reader has the bits in the reverse order.
namespace pipe_status {
inline constexpr std::uint8_t range_error = 1, frequency_error = 2, sensor_error = 4, calibration_error = 8,
                              accepted = 0x80;
}

/// The "switch data" of a host: all settings of one ping. 253 may stand in no field.
struct SwitchCommand {
    std::uint8_t head_id = 0x10;
    std::uint8_t range = 0;  ///< m
    std::uint8_t reserved4 = 0;
    std::uint8_t motion = 0;  ///< bits of namespace motion
    std::uint8_t mode = 0;    ///< bits of namespace mode; some hosts leave it at 0
    std::uint8_t reserved7 = 0;
    std::uint8_t start_gain = 0;             ///< dB, 0 to 40
    std::uint8_t logf = 0;                   ///< 0 to 3: 10, 20, 30, 40 dB
    std::uint8_t absorption = 0;             ///< dB/m x 100
    std::uint8_t train_angle = 0;            ///< (deg + 180) / 3
    std::uint8_t sector_width = 0;           ///< deg / 3; 120 is all around
    std::uint8_t step_size = 0;              ///< 0.3 deg
    std::uint8_t pulse_length = 0;           ///< 10 us (881A), 1 us (852)
    std::uint8_t minimum_profile_range = 0;  ///< 0.1 m
    std::uint8_t reserved16 = 0;
    std::uint8_t reserved17 = 0;
    std::uint8_t trigger = 0;      ///< bits of namespace trigger; 852 only
    std::uint8_t data_points = 0;  ///< 25 or 50: about 250 or 500 points
    std::uint8_t data_bits = 0;    ///< 4, 8 or 16; 0 with the 852
    std::uint8_t reply_baud = 0;
    std::uint8_t profile = 0;       ///< 1: profile range only
    std::uint8_t calibrate = 0;     ///< 1: move to 0 deg
    std::uint8_t switch_delay = 0;  ///< 2 ms
    std::uint8_t frequency = 0;     ///< (kHz - 675) / 5 + 100; 0 with the 852
    friend bool operator==(const SwitchCommand&, const SwitchCommand&) = default;
};

/// The same frame for the azimuth drive, head id 1F.
struct AzimuthCommand {
    std::uint8_t reserved3 = 0, reserved4 = 0;
    std::uint8_t motion = 0;  ///< bit 0: hold
    std::uint8_t mode = 0;
    std::array<std::uint8_t, 4> reserved7{};
    Packed14 angle{};  ///< 0.3 deg; 600 is 0 deg
    std::array<std::uint8_t, 8> reserved13{};
    std::uint8_t reply_baud = 0;
    std::uint8_t reserved22 = 0;
    std::uint8_t calibrate = 0;
    std::uint8_t switch_delay = 0;  ///< 2 ms
    std::uint8_t reserved25 = 0;
    friend bool operator==(const AzimuthCommand&, const AzimuthCommand&) = default;
};

/// IMX, IGX or IPX.
struct Reply {
    Kind kind = Kind::imx;
    std::uint8_t head_id = 0x10;
    std::uint8_t status = 0;
    Packed14 head_position{};  ///< 0.3 deg, 600 is 0 deg; bit 13: clockwise
    std::uint8_t range = 0;    ///< m
    Packed14 profile_range{};  ///< 2 mm or 10 mm (881A), 10 mm (852); 0: none
    Packed14 data_bytes{};
    std::vector<std::uint8_t> data{};
    friend bool operator==(const Reply&, const Reply&) = default;
};

/// IAX.
struct AzimuthReply {
    std::uint8_t status = 0;
    Packed14 azimuth{};  ///< 0.3 deg, 600 is 0 deg
    std::array<std::uint8_t, 5> reserved7{};
    friend bool operator==(const AzimuthReply&, const AzimuthReply&) = default;
};

/// IMX or IPX of an 831L, which has 20 bytes more before its echo data.
struct PipeReply {
    Kind kind = Kind::imx;
    std::uint8_t sonar_type = 0;  ///< 0: scanning, 1: fixed
    std::uint8_t status = 0;      ///< bits of namespace pipe_status
    Packed14 head_position{};     ///< 0.3 deg, 600 is 0 deg; bit 13: clockwise
    std::uint8_t range_code = 0;
    Packed14 profile_range{};  ///< 0.5 mm; 0: none
    Packed14 data_bytes{};
    std::array<std::uint8_t, 4> reserved12{};
    Signed14 roll{}, pitch{};                            ///< 0.025 deg
    Signed14 roll_acceleration{}, pitch_acceleration{};  ///< 0.24414 mg
    std::array<std::uint8_t, 8> reserved24{};
    std::vector<std::uint8_t> data{};
    friend bool operator==(const PipeReply&, const PipeReply&) = default;
};

using Message = std::variant<SwitchCommand, AzimuthCommand, Reply, AzimuthReply, PipeReply>;

/// Position of 0 to 1200 with its direction bit.
constexpr Packed14 head_position(int position, bool clockwise) {
    return Packed14(static_cast<std::uint64_t>(position) | (clockwise ? 0x2000U : 0U));
}
constexpr int position_of(Packed14 packed) { return static_cast<int>(packed & 0x1FFF); }
constexpr bool is_clockwise(Packed14 packed) { return (packed & 0x2000) != 0; }

}  // namespace echoloop::imagenex
