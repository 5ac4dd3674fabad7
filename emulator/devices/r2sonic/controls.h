// The settings of a Sonic 20xx that commands change, and the commands' names and bounds. Pure data; knows no
// time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "emulator/devices/r2sonic/variant.h"
#include "protocols/r2sonic/messages.h"
#include "render/pose.h"

namespace echoloop::r2sonic_device {

/// What a MultiMode set puts in the place of the plain settings; the comment names the command, n is 1 to 4.
struct ModeSet {
    std::optional<double> absorption;       ///< ABSn, dB/km
    std::optional<double> frequency;        ///< FRQn, Hz
    std::optional<double> gain;             ///< GANn
    std::optional<double> sector_rotation;  ///< SERn, rad
    std::optional<double> sector_width;     ///< SEWn, rad
    std::optional<double> spreading;        ///< SPRn, dB per decade of range
};

/// Values as commanded; the comment names the command. Start values from the manual's example where it has
/// them.
struct Controls {
    std::uint32_t trigger = 0;              ///< TRG0: 0 free running, 1 external, 2 waits for PNG0
    double range = 20;                      ///< RNG0, m
    double frequency = 400e3;               ///< FRQ0, Hz
    double power = 191;                     ///< TXP0, dB re 1 uPa at 1 m; 0 transmits nothing
    double pulse = 20e-6;                   ///< TXL0, s
    double gain = 13;                       ///< GAN0, times 2 is dB
    double spreading = 30;                  ///< SPR0, dB per decade of range
    double absorption = 80;                 ///< ABS0, dB/km
    double sound_speed = 1500;              ///< SVL0, m/s
    bool use_sound_speed = false;           ///< SVU0
    double ping_rate = 1;                   ///< PRL0, Hz
    bool limit_ping_rate = false;           ///< PRU0
    double sector_width = deg_to_rad(120);  ///< SEW0, rad
    double sector_rotation = 0;             ///< SER0, rad
    double receiver_tilt = 0;               ///< RET0, rad
    double steering = 0;                    ///< TXS0, rad; each ping cuts it to what its frequency allows
    std::uint32_t window = 0;               ///< TXW0: 1 Kaiser
    bool roll_stabilised = false;           ///< ROS0
    bool pitch_stabilised = false;          ///< PTS0
    bool equi_distant = false;              ///< BOS0
    bool ultra_high_density = false;        ///< UHD0: 1024 points
    bool intensity = false;                 ///< BIE0
    std::uint32_t image_height = 0;         ///< AIH0, bins; 0 sends no image
    double image_brightness = 6;            ///< AIB0, dB
    std::uint32_t water_column = 0;         ///< WCM0: 0 off, 1 magnitude, 2 magnitude and phase
    bool snippets = false;                  ///< SNIP
    std::uint32_t truepix = 0;              ///< TPM0: 0 off, 1 magnitude, 2 magnitude and direction
    std::uint32_t truepix_gates = 0;        ///< TPG0: 0 off, 1 depth gate max, 2 min and max
    std::uint32_t projector = 1;            ///< PROJ: 1 narrow, 2 wide
    double projector_x = 0;                 ///< PRX0, m
    double projector_y = 0;                 ///< PRY0, m
    double projector_z = 0.119;             ///< PRZ0, m
    double gate_min = 5.28;                 ///< DGA0, m of depth
    double gate_max = 8.80;                 ///< DGB0, m of depth
    double gate_slope = 0;                  ///< DGS0, rad, positive: deeper to starboard
    std::uint32_t gate_mode = 0;   ///< DGO0: 0 off, 1 manual, 0xww02 and 0xww03 automatic, ww % of the depth
    double range_gate_min = 0;     ///< RGA0, m
    double range_gate_max = 999;   ///< RGB0, m
    bool range_gate = false;       ///< RGO0
    std::uint32_t auto_range = 0;  ///< AUT0: 0x10000 follows the bottom
    std::uint32_t status = 2;      ///< STM0: 0 off
    std::array<ModeSet, 4> sets;   ///< of MultiMode
};

/// What became of one command.
enum class Applied { set, ping, unknown, refused };

/// Puts a command's value into `controls`, cut to the manual's bounds and to what the model can. A value that
/// is not finite is refused; names without an effect here are unknown and change nothing; PNG0 = 1 asks for
/// one ping.
Applied apply(Controls& controls, const r2sonic::Command& command, const Variant& variant);

/// Cuts what the manual's table allows to all models to what this one can.
void fit(Controls& controls, const Variant& variant);

/// The controls of a ping: those of MultiMode set `set` (0 to 3) in place of the plain ones where it has any.
Controls with_set(Controls controls, std::size_t set);

}  // namespace echoloop::r2sonic_device
