// The settings of a Sonic 2024 that commands change, and the commands' names and bounds. Pure data; knows no
// time.
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/r2sonic/messages.h"

namespace echoloop::r2sonic_device {

/// Values as commanded; the comment names the command. Start values from the manual's example where it has
/// them.
struct Controls {
    std::uint32_t trigger = 0;       ///< TRG0: 0 free running, 1 external, 2 waits for PNG0
    double range = 20;               ///< RNG0, m
    double frequency = 400e3;        ///< FRQ0, Hz
    double power = 191;              ///< TXP0, dB re 1 uPa at 1 m; 0 transmits nothing
    double pulse = 20e-6;            ///< TXL0, s
    double gain = 13;                ///< GAN0, times 2 is dB
    double spreading = 30;           ///< SPR0, dB per decade of range
    double absorption = 80;          ///< ABS0, dB/km
    double sound_speed = 1500;       ///< SVL0, m/s
    bool use_sound_speed = false;    ///< SVU0
    double ping_rate = 1;            ///< PRL0, Hz
    bool limit_ping_rate = false;    ///< PRU0
    double sector_width = 2.094395;  ///< SEW0, rad
    double sector_rotation = 0;      ///< SER0, rad
    double receiver_tilt = 0;        ///< RET0, rad
    bool equi_distant = false;       ///< BOS0
    bool intensity = false;          ///< BIE0
    std::uint32_t image_height = 0;  ///< AIH0, bins; 0 sends no image
    double image_brightness = 6;     ///< AIB0, dB
    std::uint32_t projector = 1;     ///< PROJ: 1 narrow, 2 wide
    double projector_z = 0.119;      ///< PRZ0, m
    double gate_min = 5.28;          ///< DGA0, m of depth
    double gate_max = 8.80;          ///< DGB0, m of depth
    double gate_slope = 0;           ///< DGS0, rad
    std::uint32_t gate_mode = 0;  ///< DGO0: 0 off, 1 manual, 0xww02 and 0xww03 automatic, ww % of the depth
    double range_gate_min = 0;    ///< RGA0, m
    double range_gate_max = 999;  ///< RGB0, m
    bool range_gate = false;      ///< RGO0
    std::uint32_t status = 2;     ///< STM0: 0 off
};

/// What became of one command.
enum class Applied { set, ping, unknown, refused };

/// Puts a command's value into `controls`, cut to the manual's bounds. A value that is not finite is refused;
/// names without an effect here are unknown and change nothing; PNG0 = 1 asks for one ping.
Applied apply(Controls& controls, const r2sonic::Command& command);

}  // namespace echoloop::r2sonic_device
