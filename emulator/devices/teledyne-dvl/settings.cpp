#include "emulator/devices/teledyne-dvl/settings.h"

#include <stdexcept>

namespace echoloop::teledyne_dvl {
namespace {

const char* const guide = "Pathfinder DVL Guide 95B-6116-00";
const char* const choice = "own choice";

void describe_setup(Setup& s, OptionList& o) {
    o.choice(s.frame, "frame", {"beam", "instrument", "ship", "earth"},
             "of velocities at the start; a host sets it by EX", guide);
    o.whole(s.alignment, "heading_alignment", "0.01 deg", -17999, 18000,
            "of beam 3, clockwise from the bow; a host sets it by EA", guide);
    o.whole(s.sound_speed, "speed_of_sound", "m/s", 1400, 1600,
            "that it assumes; a host sets it by EC. The water has its own", guide);
    o.whole(s.salinity, "salinity", "", 0, 50, "parts per thousand, which it tells; ES", guide);
    o.whole(s.profile_pings, "profile_pings", "", 0, 1, "1: a water profile in each ensemble; WP", guide);
    o.whole(s.cells, "profile_cells", "", 1, 255, "of the water profile; WN", guide);
    o.whole(s.cell_size, "cell_size", "cm", 10, 800, "of the water profile, vertical; WS", guide);
    o.whole(s.blank, "blank", "cm", 0, 1000, "from the face to the first cell; WF", guide);
    o.whole(s.water_mode, "water_mode", "", 0, 3,
            "1: water track beside the bottom track, 2: without a bottom, 3: in its place; BK", guide);
    o.whole(s.layer_least, "layer_least", "dm", 1, 640, "how thick the layer of the water track is; BL",
            guide);
    o.whole(s.layer_near, "layer_near", "dm", 0, 9999, "where the layer begins, vertical; BL", guide);
    o.whole(s.layer_far, "layer_far", "dm", 1, 9999, "where the layer ends, vertical; BL", guide);
    o.words(s.format, "format",
            {{"pd0", Format::pd0},
             {"pd4", Format::pd4},
             {"pd5", Format::pd5},
             {"pd6", Format::pd6},
             {"pd13", Format::pd13}},
            "of its reports; a host sets it by PD", guide);
}

}  // namespace

// Firmware: published ensembles of a Pathfinder and of an Explorer (34.11); the Navigator's is an own choice.
const Series pathfinder{"Pathfinder", 67, 1, 0, 20, 0, 3, true};
const Series explorer{"Explorer DVL", 34, 11, 0, 3, 0, 3};
const Series navigator{"WorkHorse Navigator", 9, 20, 1, 8, 4, 3};

Settings::Settings() {
    for (const double azimuth : {270, 90, 0, 180}) azimuths.push_back(deg_to_rad(azimuth));
}

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_setup(s.start, o);
    o.flag(s.pings_at_start, "pings_at_start",
           "it pings from the start, as one does whose setup was kept by CK", choice);
    o.flag(
        s.input_is_break, "input_is_break",
        "while it pings, what a host says ends that as a break does, which a pty cannot carry; off: only +++ "
        "and === do",
        choice);
    o.whole(s.serial_number, "serial_number", "", 0, 999999, "of the unit", choice);
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the last echo to the report", choice);
    o.number(s.temperature, "water_temperature", "degC", -4, 40, "which its sensor reads", choice);
    o.number(s.baud, "baud", "bit/s", 0, 4e6, "line rate of pty and TCP endpoints; 0: not paced", guide);
    doppler::describe(s.noise, o);
    o.number(s.noise.scale, "scale", "", 0, 0.1, "of velocities: standard deviation among units", choice);
    doppler::describe(s.acoustics, f, "reads 0 counts of 0.61 dB");
}

Settings read_settings(const DeviceConfig& config, const Series& series) {
    auto s = fill_settings<Settings>(config);
    s.noise.gyro = 0;  // a compass tells its heading
    s.series = &series;
    s.unix_start = config.unix_start;
    if (s.start.layer_far < s.start.layer_near + s.start.layer_least)
        throw std::invalid_argument(
            "layer_far is less than layer_near + layer_least, which leaves the water track no layer; raise "
            "it");
    return s;
}

}  // namespace echoloop::teledyne_dvl
