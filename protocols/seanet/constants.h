// Message ids, node numbers and flag bits of the Tritech SeaNet protocol. Numbers only, never behaviour.
#pragma once

#include <cstdint>

namespace echoloop::seanet {

/// Byte 10 of a frame. Numbers missing here are not known; a host treats an id above 72 as corrupt.
enum class Id : std::uint8_t {
    null = 0,
    version_data = 1,
    head_data = 2,
    spect_data = 3,
    alive = 4,
    prg_ack = 5,
    bb_user_data = 6,
    test_data = 7,
    aux_data = 8,
    adc_data = 9,
    adc_req = 10,
    lan_status = 13,
    set_time = 14,
    timeout = 15,
    reboot = 16,
    performance_data = 17,
    head_command = 19,
    erase_sector = 20,
    prog_block = 21,
    copy_boot_blk = 22,
    send_version = 23,
    send_bb_user = 24,
    send_data = 25,
    send_performance_data = 26,
    fpga_test = 40,
    send_fpga_version = 56,
    fpga_version_data = 57,
    fpga_do_calibrate = 61,
    send_fpga_cal_data = 62,
    fpga_cal_data = 63,
    zero_fpga_cal = 64,
    stop_alives = 66,
    reset_to_defaults = 70,
    change_ver_data = 71,
    fpga_prog_usr_code = 72,
};

/// Byte 13 of mtHeadCommand.
enum class HeadCommandType : std::uint8_t {
    normal = 0x01,   ///< parameters, 66 bytes
    reverse = 0x0F,  ///< turn the scan direction, 15 bytes
    dual = 0x1D,     ///< parameters and V3B block, 82 bytes
    gain = 0x1E,     ///< V3B block only, 31 bytes
};

/// Bytes 7 and 8 of a frame.
namespace nodes {
inline constexpr std::uint8_t imaging = 2;
inline constexpr std::uint8_t sidescan = 10;
inline constexpr std::uint8_t sub_bottom = 15;
inline constexpr std::uint8_t profiler = 20;
inline constexpr std::uint8_t bathymetric = 40;
inline constexpr std::uint8_t attitude = 75;
inline constexpr std::uint8_t modem = 85;
inline constexpr std::uint8_t usbl = 90;
inline constexpr std::uint8_t host = 255;
}  // namespace nodes

/// Bits of Alive::head_inf.
namespace head_inf {
inline constexpr std::uint8_t in_centre = 0x01;  ///< re-centring in progress
inline constexpr std::uint8_t centred = 0x02;
inline constexpr std::uint8_t motoring = 0x04;
inline constexpr std::uint8_t motor_on = 0x08;
inline constexpr std::uint8_t dir = 0x10;
inline constexpr std::uint8_t in_scan = 0x20;
inline constexpr std::uint8_t no_params = 0x40;  ///< needs mtHeadCommand
inline constexpr std::uint8_t sent_cfg = 0x80;
}  // namespace head_inf

/// Bits of HeadParameters::hd_ctrl and HeadData::hd_ctrl of an imaging sonar.
namespace hd_ctrl {
inline constexpr std::uint16_t adc8on = 0x0001;     ///< 1: 8-bit bins; 0: packed 4-bit
inline constexpr std::uint16_t cont = 0x0002;       ///< 1: full circle, limits ignored; 0: sector
inline constexpr std::uint16_t scanright = 0x0004;  ///< 1: clockwise, bearing increases
inline constexpr std::uint16_t invert = 0x0008;     ///< head mounted boot down: rotation reversed
inline constexpr std::uint16_t motoff = 0x0010;
inline constexpr std::uint16_t txoff = 0x0020;
inline constexpr std::uint16_t spare = 0x0040;
inline constexpr std::uint16_t chan2 = 0x0080;
inline constexpr std::uint16_t raw = 0x0100;
inline constexpr std::uint16_t hasmot = 0x0200;
inline constexpr std::uint16_t applyoffset = 0x0400;
inline constexpr std::uint16_t pingpong = 0x0800;
inline constexpr std::uint16_t stare_llim = 0x1000;  ///< do not scan, point at LeftLim
inline constexpr std::uint16_t reply_asl = 0x2000;
inline constexpr std::uint16_t reply_thr = 0x4000;
inline constexpr std::uint16_t ignore_sensor = 0x8000;
}  // namespace hd_ctrl

/// Bits of ProfilerParameters::hd_ctrl and ProfilerData::hd_ctrl; those that are missing mean the same as in
/// hd_ctrl.
namespace profiler_ctrl {
inline constexpr std::uint16_t agc = 0x0001;  ///< adaptive gain
inline constexpr std::uint16_t alt = 0x0002;  ///< passes alternate in direction
inline constexpr std::uint16_t scanright = 0x0004;
inline constexpr std::uint16_t invert = 0x0008;
inline constexpr std::uint16_t motoff = 0x0010;
inline constexpr std::uint16_t txoff = 0x0020;
inline constexpr std::uint16_t t10 = 0x0040;
inline constexpr std::uint16_t chan2 = 0x0080;
inline constexpr std::uint16_t first = 0x0100;  ///< the first echo above the threshold
inline constexpr std::uint16_t hasmot = 0x0200;
inline constexpr std::uint16_t pingsync = 0x0400;
inline constexpr std::uint16_t scansync = 0x0800;
inline constexpr std::uint16_t stare_llim = 0x1000;
inline constexpr std::uint16_t master = 0x2000;
inline constexpr std::uint16_t mirror = 0x4000;
inline constexpr std::uint16_t ignore_sensor = 0x8000;
}  // namespace profiler_ctrl

/// Bits of HeadData::head_status.
namespace head_status {
inline constexpr std::uint8_t power_loss = 0x01;   ///< in reset
inline constexpr std::uint8_t motor_error = 0x02;  ///< lost synchronization, send the parameters again
inline constexpr std::uint8_t data_8bit = 0x10;    ///< bins are 8-bit, 0..80 dB
inline constexpr std::uint8_t message_appended = 0x80;
}  // namespace head_status

/// Byte 17 of mtHeadData.
enum class SweepCode : std::uint8_t { normal = 0, at_left_limit = 1, at_right_limit = 2, at_centre = 5 };

inline constexpr std::uint8_t device_type_dst = 0x11;  ///< HeadData::device_type that hosts expect
inline constexpr std::uint8_t dst_marker = 0x0F;       ///< BBUserData::device_marker of the DST family
inline constexpr std::uint16_t angle_units = 6400;     ///< 1/16 gradian in a full circle; 3200 is ahead

}  // namespace echoloop::seanet
