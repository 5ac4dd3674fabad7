// The messages of the Tritech SeaNet protocol as plain structs. No wire code: layouts.h says how they stand
// on the line. Angles are in 1/16 gradian (6400 a circle, 3200 ahead, clockwise seen from above) unless said
// otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "protocols/seanet/constants.h"
#include "protocols/seanet/profiler_messages.h"

namespace echoloop::seanet {

/// Bytes 7 to 12 of a frame; the two length fields follow from the payload.
struct Header {
    std::uint8_t tx_node = nodes::host;
    std::uint8_t rx_node = nodes::imaging;
    std::uint8_t remaining = 0;  ///< bytes that follow up to and excluding LF; 0 in mtHeadData
    Id id = Id::null;
    std::uint8_t sequence = 0x80;        ///< bit 7: last packet; bits 0-6: packet number
    std::uint8_t node = nodes::imaging;  ///< copy of tx_node in replies, of rx_node in commands

    friend bool operator==(const Header&, const Header&) = default;
};

/// One frame from '@' to LF; payload is byte 13 up to the last byte before LF.
struct Frame {
    Header header;
    std::vector<std::uint8_t> payload;

    friend bool operator==(const Frame&, const Frame&) = default;
};

// Host to sonar
// -----------------------------------------------------------------------------------------------

struct ReBoot {
    friend bool operator==(const ReBoot&, const ReBoot&) = default;
};
struct SendVersion {
    friend bool operator==(const SendVersion&, const SendVersion&) = default;
};
struct SendBBUser {
    friend bool operator==(const SendBBUser&, const SendBBUser&) = default;
};
struct StopAlives {
    friend bool operator==(const StopAlives&, const StopAlives&) = default;
};
struct SendData {
    std::uint32_t time_ms = 0;  ///< time of day, ms; many hosts send 0

    friend bool operator==(const SendData&, const SendData&) = default;
};

/// Bytes 14 to 64 of mtHeadCommand types 0x01 and 0x1D.
struct HeadParameters {
    std::uint16_t hd_ctrl = 0;  ///< bits of namespace hd_ctrl
    std::uint8_t hd_type =
        0;                    ///< 2 imaging, 3 sidescan, 5 profiler, 0x11 DST; hosts disagree: never validate
    std::uint32_t tx_n1 = 0;  ///< f_Hz * 2^32 / 32e6, channel 1; not used by DST
    std::uint32_t tx_n2 = 0;  ///< channel 2
    std::uint32_t rx_n1 = 0;  ///< (f_Hz + 455000) * 2^32 / 32e6, channel 1
    std::uint32_t rx_n2 = 0;  ///< channel 2
    std::uint16_t tx_pulse = 0;  ///< us
    std::uint16_t range_scale =
        0;  ///< bits 0-13 range * 10; bits 14-15 unit (m, ft, fathom, yd); informational
    std::uint16_t left_limit = 0;    ///< 1/16 gradian; ignored in continuous mode
    std::uint16_t right_limit = 0;   ///< 1/16 gradian
    std::uint8_t ad_span = 0;        ///< 255 * dB / 80
    std::uint8_t ad_low = 0;         ///< 255 * dB / 80
    std::uint8_t initial_gain1 = 0;  ///< 0..210 is 0..100 %
    std::uint8_t initial_gain2 = 0;
    std::uint16_t slope1 = 0;  ///< not used by DST
    std::uint16_t slope2 = 0;
    std::uint8_t motor_time = 0;    ///< MoTime, 10 us
    std::uint8_t step_size = 0;     ///< 1/16 gradian
    std::uint16_t ad_interval = 0;  ///< 640 ns; two-way time per bin
    std::uint16_t bins = 0;         ///< NBins
    std::uint16_t max_ad_buffer = 0;
    std::uint16_t lockout = 0;  ///< us
    std::uint16_t minor_axis_direction = 0;
    std::uint8_t major_axis_pan = 0;
    std::uint8_t ctl2 = 0;
    std::uint16_t scan_z = 0;

    friend bool operator==(const HeadParameters&, const HeadParameters&) = default;
};

/// The 16 bytes that type 0x1D appends and type 0x1E consists of; 1 and 2 are the channels.
struct V3B {
    std::uint8_t ad_span1 = 0;  ///< 255 * dB / 80
    std::uint8_t ad_span2 = 0;
    std::uint8_t ad_low1 = 0;  ///< 255 * dB / 80
    std::uint8_t ad_low2 = 0;
    std::uint8_t initial_gain1 = 0;  ///< 0..210 is 0..100 %
    std::uint8_t initial_gain2 = 0;
    std::uint8_t adc_set_point1 = 0;
    std::uint8_t adc_set_point2 = 0;
    std::uint16_t adv_slope1 = 0;
    std::uint16_t adv_slope2 = 0;
    std::uint16_t slope_delay1 = 0;
    std::uint16_t slope_delay2 = 0;

    friend bool operator==(const V3B&, const V3B&) = default;
};

/// mtHeadCommand type 0x01.
struct HeadCommand {
    HeadParameters parameters;

    friend bool operator==(const HeadCommand&, const HeadCommand&) = default;
};
/// mtHeadCommand type 0x1D. Hosts demand the main ADSpan and ADLow back, so those are the ones to use.
struct HeadCommandDual {
    HeadParameters parameters;
    V3B v3b;

    friend bool operator==(const HeadCommandDual&, const HeadCommandDual&) = default;
};
/// mtHeadCommand type 0x0F: turn the scan direction.
struct HeadCommandReverse {
    friend bool operator==(const HeadCommandReverse&, const HeadCommandReverse&) = default;
};
/// mtHeadCommand type 0x1E: changes ADSpan, ADLow and gain from the next line on.
struct HeadCommandGain {
    V3B v3b;

    friend bool operator==(const HeadCommandGain&, const HeadCommandGain&) = default;
};

// Sonar to host
// -----------------------------------------------------------------------------------------------

struct Alive {
    std::uint8_t will_send = 0;        ///< 0x80 while the head has no parameters, 0 once it has
    std::uint32_t time_ms = 0;         ///< ms since power-up, or as set by mtSendData
    std::uint16_t motor_position = 0;  ///< 1/16 gradian
    std::uint8_t head_inf = 0;         ///< bits of namespace head_inf

    friend bool operator==(const Alive&, const Alive&) = default;
};

struct VersionData {
    std::uint8_t software_version = 0;  ///< or a CPUID frequency code: sources disagree
    std::uint8_t info_bits = 0;         ///< low nibble: board type 0 AIF, 1 sonar, 2 bathymetric
    std::uint16_t serial_number = 0;
    std::uint32_t program_length = 0;  ///< bytes
    std::uint16_t checksum = 0;
    std::uint8_t node = nodes::imaging;

    friend bool operator==(const VersionData&, const VersionData&) = default;
};

/// Line settings of one serial port in BBUserData: low and high words of the three settings.
struct BBPort {
    std::uint16_t baud_low = 0;  ///< 1 2400, 2 4800, 3 9600, 4 19200, 5 38400, 6 57600, 7 115200
    std::uint16_t baud_high = 0;
    std::uint16_t parity_low = 0;  ///< 0 none
    std::uint16_t parity_high = 0;
    std::uint16_t data_bits_low = 0;  ///< 0 is 8 bits
    std::uint16_t data_bits_high = 0;

    friend bool operator==(const BBPort&, const BBPort&) = default;
};

/// mtBBUserData. Bytes whose meaning depends on the family or is unknown stay in `block1`, `block2` and
/// `rest`.
struct BBUserData {
    std::uint8_t surface_control = 0xFF;
    std::uint8_t reserved14 = 0;
    std::uint16_t clock = 0;
    std::uint16_t length = 0x0040;            ///< user BB length
    std::uint8_t device_marker = dst_marker;  ///< byte 19: 0x0F DST, anything else not
    std::uint8_t reserved20 = 0x06;
    std::array<std::uint8_t, 4> reserved21{};
    std::uint16_t lan_baud_low = 0;  ///< 0..5: 25, 125, 625, 312, 156, 78 kbit/s
    std::uint16_t lan_baud_high = 0;
    std::uint16_t lan_sensitivity_low = 2;  ///< 2 neutral
    std::uint16_t lan_sensitivity_high = 2;
    std::uint16_t lan_timeout = 3;
    BBPort a0;                              ///< main port
    BBPort a1;                              ///< AUX port
    std::array<std::uint8_t, 40> block1{};  ///< bytes 59..98
    std::uint8_t half_duplex = 0;           ///< byte 99, not DST: 1 is half duplex (RS485)
    std::array<std::uint8_t, 46> block2{};  ///< bytes 100..145
    std::uint8_t half_duplex_dst = 0;       ///< byte 146, DST: 1 is half duplex
    std::vector<std::uint8_t> rest =
        std::vector<std::uint8_t>(116);  ///< byte 147 on; 116 bytes, 27 in the older form

    friend bool operator==(const BBUserData&, const BBUserData&) = default;
};

/// mtFpgaCalData; the content is unknown, hosts accept zeros.
struct FpgaCalData {
    std::array<std::uint8_t, 66> content{};

    friend bool operator==(const FpgaCalData&, const FpgaCalData&) = default;
};
/// mtFpgaVersionData; the content is unknown, hosts accept zeros.
struct FpgaVersionData {
    std::array<std::uint8_t, 14> content{};

    friend bool operator==(const FpgaVersionData&, const FpgaVersionData&) = default;
};

/// mtHeadData: one line of echoes. The two counts on the wire follow from `bins`.
struct HeadData {
    std::uint8_t device_type = device_type_dst;
    std::uint8_t head_status = 0;  ///< bits of namespace head_status
    SweepCode sweep_code = SweepCode::normal;
    std::uint16_t hd_ctrl = 0;      ///< echo of the command
    std::uint16_t range_scale = 0;  ///< echo
    std::uint32_t tx_n = 0;         ///< echo
    std::uint8_t gain = 0;          ///< 0..210
    std::uint16_t slope = 0;
    std::uint8_t ad_span = 0;  ///< echo
    std::uint8_t ad_low = 0;   ///< echo
    std::uint16_t heading_offset = 0;
    std::uint16_t ad_interval = 0;   ///< echo, 640 ns
    std::uint16_t left_limit = 0;    ///< echo of the raw value
    std::uint16_t right_limit = 0;   ///< echo
    std::uint8_t step_size = 0;      ///< echo, 1/16 gradian
    std::uint16_t bearing = 0;       ///< of this line, 0..6399
    std::vector<std::uint8_t> bins;  ///< Dbytes bytes, nearest first: one bin each, or two 4-bit bins each

    friend bool operator==(const HeadData&, const HeadData&) = default;
};

/// mtAuxData: what a device on the AUX port said.
struct AuxData {
    std::vector<std::uint8_t> data;

    friend bool operator==(const AuxData&, const AuxData&) = default;
};

/// Every message that has a layout.
using Message =
    std::variant<ReBoot, SendVersion, SendBBUser, StopAlives, SendData, HeadCommand, HeadCommandDual,
                 HeadCommandReverse, HeadCommandGain, Alive, VersionData, BBUserData, FpgaCalData,
                 FpgaVersionData, HeadData, AuxData, ProfilerCommand, ProfilerGainCommand, ProfilerData>;

}  // namespace echoloop::seanet
