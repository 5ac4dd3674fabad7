#include "emulator/devices/nortek-nucleus/settings.h"

namespace echoloop::nortek_nucleus {
namespace {

const char* const driver = "NortekSupport/nucleus_driver";
const char* const choice = "own choice";

}  // namespace

Settings::Settings() {
    for (const double azimuth : {0, 120, 240}) azimuths.push_back(deg_to_rad(azimuth));
    noise.gyro = 0;
}

void describe(Settings& s, OptionList& o, FigureList& f) {
    o.number(s.sound_speed, "speed_of_sound", "m/s", 1300, 1700, "that it assumes. The water has its own",
             choice);
    o.flag(s.login, "login", "by TCP it asks for a password; the serial line never does", driver);
    o.text(s.password, "password", "that it wants", driver);
    o.flag(s.starts_at_once, "starts_at_once", "it measures from the start, without the host's START",
           choice);
    o.whole(s.serial_number, "serial_number", "", 0, 999999, "of the unit", choice);
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the last echo to the report", choice);
    o.number(s.temperature, "water_temperature", "degC", -4, 40, "which its sensor reads", choice);
    o.number(s.baud, "baud", "bit/s", 0, 4e6, "of the serial line, not of TCP; 0: not paced", driver);
    doppler::describe(s.noise, o);
    o.number(s.noise.scale, "scale", "", 0, 0.1, "of velocities: standard deviation among units", choice);
    doppler::describe(s.acoustics, f, "reads 0 dBm, which it does not tell");
}

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    s.unix_start = config.unix_start;
    return s;
}

}  // namespace echoloop::nortek_nucleus
