// The options and the profile of a Teledyne DVL as typed values, and what a host sets by commands. Data only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/devices/family/doppler/settings.h"

namespace echoloop::teledyne_dvl {

enum class Frame { beam = 0, instrument = 1, ship = 2, earth = 3 };
enum class Format { pd0 = 0, pd4 = 4, pd5 = 5, pd6 = 6, pd13 = 13 };

/// What commands change; they are the numbers of the commands.
struct Setup {
    Frame frame = Frame::earth;  ///< EX, its first two digits
    bool tilts = true, three_beams = true, bin_mapping = true;
    int alignment = 0;       ///< EA, 0.01 deg: of beam 3, clockwise from the bow
    int sound_speed = 1500;  ///< EC, m/s
    int depth = 0;           ///< ED, dm
    int salinity = 35;       ///< ES, parts per thousand
    int most_depth = 1100;   ///< BX, dm
    int bottom_pings = 1;    ///< BP; 0: no bottom track
    int profile_pings = 0;   ///< WP; 0: no water profile
    int cells = 30;          ///< WN
    int cell_size = 200;     ///< WS, cm
    int blank = 88;          ///< WF, cm
    int water_mode = 0;      ///< BK: 0 no water track, 1 always, 2 without a bottom, 3 and no bottom track
    int layer_least = 80;    ///< BL, dm: how thick the layer is at least
    int layer_near = 160, layer_far = 240;  ///< BL, dm
    Format format = Format::pd0;
    bool pings_by_itself = true;  ///< CF, its second digit
    int interval = 0;             ///< TE and TP, the longer one: 0.01 s from ping to ping at least
    friend bool operator==(const Setup&, const Setup&) = default;
};

/// Of a series, what its words tell of it.
struct Series {
    std::string_view banner;  ///< of the wake-up message
    int firmware = 0, revision = 0;
    std::size_t fixed_more = 0, variable_more = 0, bottom_more = 0;  ///< bytes behind the common ones
    int frequency_code = 3;                                          ///< 3: 600 kHz
    bool health = false;                                             ///< PD6 has a line of leaks and supply
};

struct Settings : doppler::Settings {
    Settings();

    const Series* series = nullptr;
    Setup start;
    bool pings_at_start = true;
    bool input_is_break = true;
    double temperature = 10;  ///< degC, of the water
    double baud = 115200;     ///< bit/s; 0: not paced
    double unix_start = 0;    ///< s
    std::uint32_t serial_number = 1234;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config, const Series& series);

extern const Series pathfinder, explorer, navigator;

}  // namespace echoloop::teledyne_dvl
