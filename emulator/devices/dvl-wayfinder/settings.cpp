#include "emulator/devices/dvl-wayfinder/settings.h"

namespace echoloop::dvl_wayfinder {
namespace {

const char* const driver = "Teledyne-Marine/Wayfinder, the maker's public driver";
const char* const choice = "own choice";

}  // namespace

Settings::Settings() {
    for (const double azimuth : {270, 90, 0, 180}) azimuths.push_back(deg_to_rad(azimuth));
    noise.gyro = 0;  // it has none
}

void describe(Settings& s, OptionList& o, FigureList& f) {
    o.choice(s.frame, "frame", {"beam", "instrument"},
             "of velocities; no command changes it, and it has no attitude for others",
             "own choice: the maker's own script turns them by the mounting, as those of the instrument");
    o.choice(s.slant_ranges, "ranges", {"vertical", "slant"}, "of its beams",
             "own choice: vertical, as the maker's Pathfinder has them");
    o.number(s.sound_speed, "speed_of_sound", "m/s", 1400, 1600,
             "that it assumes; a host sets it. The water has its own", driver);
    o.number(s.most_range, "max_range", "m", 1, 60, "at which it looks for the bottom; a host sets it",
             driver);
    o.flag(s.software_trigger, "software_trigger", "it pings when it is told; a host sets it", driver);
    o.flag(s.pings_at_start, "pings_at_start", "it pings from the start, without a host's command",
           "own choice: the driver's first example stops the pings before all else");
    o.whole(s.serial_number, "serial_number", "", 0, 999999, "of the unit", choice);
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the last echo to the report", choice);
    o.number(s.voltage, "voltage", "V", 0, 60, "of its supply, which it tells", choice);
    o.number(s.transmit_voltage, "transmit_voltage", "V", 0, 100, "which it tells", choice);
    o.number(s.current, "current", "A", 0, 10, "which it tells", choice);
    o.number(s.baud, "baud", "bit/s", 0, 4e6, "line rate of pty and TCP endpoints; 0: not paced", driver);
    doppler::describe(s.noise, o);
    o.number(s.noise.scale, "scale", "", 0, 0.1, "of velocities: standard deviation among units", choice);
    doppler::describe(s.acoustics, f, "reads 0 dB, which it does not tell");
}

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    s.unix_start = config.unix_start;
    return s;
}

}  // namespace echoloop::dvl_wayfinder
