// The options of a Sonic 20xx as typed values. Data only.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/devices/r2sonic/controls.h"
#include "emulator/model.h"
#include "protocols/wire/text.h"

namespace echoloop::r2sonic_device {

struct Settings {
    wire::Text<12> model = "2024";
    wire::Text<12> serial = "100017", sim_serial = "100117";
    Controls start;                  ///< the controls at power-up
    double image_reference = 0;      ///< dB re 1 uPa after gain: reads 255 in the image at 0 dB brightness
    double detection_threshold = 0;  ///< dB re 1 uPa; an echo below is no bottom
    double datagram_gap = 0;         ///< s between the datagrams of an image
    bool discovery_to_sender = true;
    bool answer_discovery = true;
    double sound_speed = 1500;  ///< m/s, at the head's own sensor: the true one
    double unix_start = 0;      ///< s
};

std::vector<Option> option_table();
/// From a complete set of options.
Settings read_settings(const DeviceConfig& config);

}  // namespace echoloop::r2sonic_device
