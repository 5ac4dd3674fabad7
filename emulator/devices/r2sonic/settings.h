// The options and the profile of a Sonic 20xx as typed values. Data only.
#pragma once

#include <cstdint>

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/multibeam/figures.h"
#include "emulator/devices/r2sonic/controls.h"
#include "protocols/wire/text.h"

namespace echoloop::r2sonic_device {

/// Figures of the profile; beam widths in rad at the reference frequency.
struct Acoustics {
    double reference_frequency = 0;  ///< Hz
    double receive_beam_width = 0, transmit_beam_width = 0, wide_transmit_beam_width = 0;
    AxisPattern horizontal, vertical;
    Receiver receiver;  ///< its directivity index at the reference frequency
    ArrayErrors errors;
    double image_reference = 0;  ///< dB re 1 uPa after gain: reads 255 in the image at 0 dB brightness
    double magnitude_reference =
        0;  ///< dB re 1 uPa after gain: reads 65535 in water column, snippets, TruePix
    multibeam::Rule detection;
};

/// Bits 1 and 0 of a good point's quality.
enum class TestBits { tests, set, clear };

/// Who is answered on the discovery port.
enum class Discovery { sender, gui, none };

struct Settings {
    const Variant* variant = nullptr;
    wire::Text<12> model;
    wire::Text<12> serial, sim_serial;
    Controls start;  ///< the controls at power-up
    Acoustics acoustics;
    bool tvg = true;                 ///< the effect of that name
    bool pulse = true;               ///< the effect of that name: echoes are as long as the pulse
    double datagram_gap = 0.3e-3;    ///< s between the datagrams of one ping
    double processing_time = 2e-3;   ///< s from the last sample to the first datagram but BTH0
    double bathymetry_time = 11e-3;  ///< s from the last sample to BTH0
    TestBits test_bits = TestBits::tests;
    bool verbose_gates = false;       ///< BTH0 has a G1
    bool bins_first = false;          ///< AID0's data is bin-major
    bool old_truepix_header = false;  ///< of the manual v5.0
    bool configured_hosts = false;    ///< water column, snippets and TruePix go where R2DC says
    std::size_t mode_sets = 0;        ///< of MultiMode that pings take in turn
    double sync_in = 0;               ///< Hz of pulses at the sync input, 0: none
    Discovery discovery = Discovery::sender;
    double sound_speed = 1500;  ///< m/s, at the head's own sensor: the true one
    double unix_start = 0;      ///< s
    Sensors sensors;
};

void describe(Settings& settings, OptionList& options, FigureList& figures, const Variant& variant);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config, const Variant& variant);

}  // namespace echoloop::r2sonic_device
