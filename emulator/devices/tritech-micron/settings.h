// The options and the profile of a Micron as typed values, and what it has learned from mtHeadCommand. Data
// only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/devices/tritech-micron/scan.h"
#include "emulator/model.h"
#include "protocols/seanet/codec.h"
#include "protocols/seanet/framer.h"
#include "protocols/seanet/messages.h"

namespace echoloop::micron {

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double frequency = 0, bandwidth = 0;  ///< Hz
    double shortest_pulse = 0;            ///< s
    double source_level = 0;              ///< dB re 1 uPa at 1 m
    double beam_width = 0, fan_height = 0;
    AxisPattern horizontal, vertical;
    Receiver receiver;
    double reference_level = 0;  ///< dB re 1 uPa after TVG: reads 0 dB at zero gain
    double tvg_spreading = 0;    ///< dB per decade of range; 0 with the effect tvg off
    double tvg_absorption = 0;   ///< dB/m one way; 0 with the effect tvg off
};

/// Emulator options; README.md of this folder explains each.
struct Settings {
    std::uint8_t node = 2;
    bool dst = true;            ///< DST family: FPGA messages, 1500 bins; else MiniKing manners
    double first_alive = 1;     ///< s after power-up or reboot
    int recentring_alives = 3;  ///< alives with InCentre after a reboot
    bool alives_while_scanning = false;
    std::string sent_cfg_by = "both";
    int replies = 2;              ///< mtHeadData per mtSendData
    bool queue_requests = false;  ///< else surplus requests merge into one
    std::string early_request = "ignore";
    bool refuse_while_centring = false;
    ScanRules scan;
    bool obey_invert = true;
    std::string period_law = "A";
    double period_scale = 1;
    double fixed_period = 0.05;  ///< s, for period_law "fixed"
    bool high_nibble_first = true;
    bool ad_span_15 = false;  ///< 4-bit mode: ADSpan and ADLow are on the 0..15 scale
    std::uint8_t device_type = 0x11;
    seanet::Framer::Lengths frame_lengths = seanet::Framer::Lengths::trusted;
    seanet::HeadDataRemaining head_data_remaining = seanet::HeadDataRemaining::zero;
    std::uint16_t hd_ctrl_set = 0, hd_ctrl_clear = 0;  ///< bits forced in replies
    std::uint8_t software_version = 2;
    std::uint16_t serial_number = 1234;
    double baud = 115200;
    Acoustics acoustics;

    int bin_limit() const { return dst ? 1500 : 800; }
};

/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config);
/// The tables that `echoloop list` shows.
std::vector<Option> option_table();
std::vector<FigureRow> figure_table();

/// The ping that follows from the parameters a driver has sent: true range is NBins * ADInterval * 640 ns * c
/// / 2.
Shot shot_from(const seanet::HeadParameters& parameters, const Settings& settings, std::uint16_t bearing);
/// True if a head can work with these parameters at all.
bool usable(const seanet::HeadParameters& parameters);
/// Number of bins that the head really returns.
std::size_t effective_bins(const seanet::HeadParameters& parameters, const Settings& settings);

inline constexpr double ad_interval_unit = 640e-9;  ///< s

}  // namespace echoloop::micron
