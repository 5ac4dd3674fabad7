// The messages of a SeaNet profiler (node 20) as plain structs; they share ids with those of messages.h. No
// wire code.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "protocols/seanet/constants.h"

namespace echoloop::seanet {

/// The parameters of a profiler (node 20): the same bytes as HeadParameters, some with another meaning.
struct ProfilerParameters {
    std::uint16_t hd_ctrl = 0;  ///< bits of namespace profiler_ctrl
    std::uint8_t hd_type = 5;
    std::uint32_t tx_n1 = 0;     ///< f_Hz * 2^32 / 32e6, channel 1
    std::uint32_t tx_n2 = 0;     ///< channel 2
    std::uint32_t rx_n1 = 0;     ///< (f_Hz + 455000) * 2^32 / 32e6, channel 1
    std::uint32_t rx_n2 = 0;     ///< channel 2
    std::uint16_t tx_pulse = 0;  ///< us
    std::uint16_t range_scale = 0;
    std::uint16_t left_limit = 0;
    std::uint16_t right_limit = 0;
    std::uint8_t ad_threshold = 0;   ///< 255 * dB / 80; weaker echoes do not count
    std::uint8_t filt_gain = 0;      ///< not known
    std::uint8_t agc_max = 0;        ///< 255 * dB / 80
    std::uint8_t agc_set_point = 0;  ///< 255 * dB / 80
    std::uint16_t slope1 = 0;
    std::uint16_t slope2 = 0;
    std::uint8_t motor_time = 0;  ///< 10 us
    std::uint8_t step_size = 0;   ///< 1/16 gradian
    std::uint16_t scan_time = 0;  ///< 100 us; how long a ping listens
    std::uint16_t prf_spl = 0;
    std::uint16_t prf_ctl2 = 0;  ///< bit 0: the strongest echo
    std::uint16_t lockout = 0;   ///< us; nothing is heard before
    std::uint16_t minor_axis_direction = 0;
    std::uint8_t major_axis_pan = 0;
    std::uint8_t ctl2 = 0;
    std::uint16_t scan_z = 0;

    friend bool operator==(const ProfilerParameters&, const ProfilerParameters&) = default;
};

/// The acquisition block of a profiler: what V3B is to an imaging sonar.
struct ProfilerGains {
    std::uint8_t ad_threshold1 = 0;  ///< 255 * dB / 80
    std::uint8_t ad_threshold2 = 0;
    std::uint8_t filt_gain1 = 0;
    std::uint8_t filt_gain2 = 0;
    std::uint8_t agc_max1 = 0;  ///< 255 * dB / 80
    std::uint8_t agc_max2 = 0;
    std::uint8_t agc_set_point1 = 0;  ///< 255 * dB / 80
    std::uint8_t agc_set_point2 = 0;
    std::uint16_t adv_slope1 = 0;
    std::uint16_t adv_slope2 = 0;
    std::uint16_t slope_delay1 = 0;
    std::uint16_t slope_delay2 = 0;

    friend bool operator==(const ProfilerGains&, const ProfilerGains&) = default;
};

/// mtHeadCommand type 0x1D to node 20.
struct ProfilerCommand {
    ProfilerParameters parameters;
    ProfilerGains gains;

    friend bool operator==(const ProfilerCommand&, const ProfilerCommand&) = default;
};
/// mtHeadCommand type 0x1E to node 20: the acquisition block alone.
struct ProfilerGainCommand {
    ProfilerGains gains;

    friend bool operator==(const ProfilerGainCommand&, const ProfilerGainCommand&) = default;
};

/// mtHeadData of node 20: one pass of a profiler. The two counts on the wire follow from `echo_times`.
struct ProfilerData {
    std::uint8_t device_type = 5;
    std::uint8_t head_status = 0;  ///< bits of namespace head_status
    SweepCode sweep_code = SweepCode::normal;
    std::uint16_t hd_ctrl = 0;      ///< echo of the command; bit 2: this pass ran clockwise
    std::uint16_t range_scale = 0;  ///< echo
    std::uint32_t tx_n = 0;         ///< echo
    std::uint8_t gain = 0;          ///< 255 * dB / 80
    std::uint16_t slope = 0;
    std::uint8_t ad_threshold = 0;          ///< echo
    std::uint8_t filt_gain = 0;             ///< echo
    std::uint16_t left_limit = 0;           ///< echo
    std::uint16_t right_limit = 0;          ///< echo
    std::uint8_t step_size = 0;             ///< echo, 1/16 gradian
    std::uint16_t scan_time = 0;            ///< echo, 100 us
    std::vector<std::uint16_t> echo_times;  ///< us, two-way, in the order of the pings; 0: no echo
    std::array<std::uint8_t, 10> trailer{};

    friend bool operator==(const ProfilerData&, const ProfilerData&) = default;
};

}  // namespace echoloop::seanet
