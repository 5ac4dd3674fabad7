#include "emulator/devices/nortek-dvl/settings.h"

namespace echoloop::nortek_dvl {
namespace {

const char* const manual = "DVL 1000 manual of 2017";
const char* const guide = "Signature Integrator's Guide of 2017";
const char* const choice = "own choice";
const char* const recorded =
    "own fit to what two pairs of beams disagree by in 11947 published reports of a DVL333";

void describe_outputs(Settings& s, OptionList& o) {
    o.words(
        s.bottom_format, "bottom_format",
        {{"df21", 21},
         {"bt0", 351},
         {"bt1", 350},
         {"bt3", 354},
         {"bt4", 355},
         {"bt6", 356},
         {"bt7", 357},
         {"bt8", 358},
         {"bt9", 359}},
        "of its bottom track at the start: DF21, or lines $PNORBT0 to $PNORBT9; a host sets it by SETBT,DF",
        choice);
    o.flag(s.water_track, "water_track", "it tracks the water as well; a host sets it by SETBT,WT", choice);
    o.words(
        s.water_format, "water_format",
        {{"df22", 22}, {"wt3", 404}, {"wt4", 405}, {"wt6", 406}, {"wt7", 407}, {"wt8", 408}, {"wt9", 409}},
        "of its water track at the start: DF22, or lines $PNORWT3 to $PNORWT9; a host sets it by SETBT,WTDF",
        choice);
    o.number(s.water_layer, "water_layer", "m", 0.5, 20,
             "vertical, to the middle of the water that is tracked", choice);
    o.choice(s.slant_distance, "distance", {"vertical", "slant"},
             "that it tells of a beam: the depth below it, or the way along it",
             "a public reader; another takes it for slant");
}

void describe_line(Settings& s, OptionList& o) {
    using Kind = nortek_console::Login::Kind;
    o.words(
        s.login, "login",
        {{"user", Kind::user}, {"telnet", Kind::telnet}, {"password", Kind::password}, {"none", Kind::none}},
        "of a host by TCP: user: name and password; telnet: the same, CR CR LF behind the welcome; password: "
        "that "
        "alone, as a Nucleus does",
        guide);
    o.text(s.password, "password", "that it wants; empty: any will do", guide);
    o.flag(s.greeting, "greeting", "by TCP the ports of data say who they are first", guide);
    o.flag(s.starts_at_once, "starts_at_once",
           "it measures from the start, as one does that was measuring when its power went", guide);
    o.number(s.baud, "baud", "bit/s", 0, 4e6, "of the serial line, not of TCP; 0: not paced",
             "GSO-soslab/nortek_dvl");
}

}  // namespace

Settings::Settings() {
    for (const double azimuth : {45, -45, -135, 135}) azimuths.push_back(deg_to_rad(azimuth));
    noise = {.floor = 1.2e-3, .by_altitude = 6e-5, .by_speed = 5e-3, .gyro = 0};
    processing_time = 0.03;
}

void describe(Settings& s, OptionList& o, FigureList& f) {
    o.number(s.sound_speed, "speed_of_sound", "m/s", 0, 1700,
             "that it assumes; 0: by its own temperature, pressure and salinity; a host sets it by "
             "SETDVL,SV. The water "
             "has its own",
             "published reports");
    o.number(s.salinity, "salinity", "", 0, 50, "parts per thousand; a host sets it by SETDVL,SA", manual);
    o.number(s.rate, "rate", "Hz", 1, 8, "of pings by its own clock; a host sets it by SETDVL,SR",
             "GSO-soslab/nortek_dvl");
    o.choice(s.trigger, "trigger", {"internal", "command", "rise", "fall", "edges"},
             "what it pings at: its own clock, the command TRIG, or edges on its trigger line; a host sets "
             "it by SETDVL,TRIG",
             manual);
    o.number(s.trigger_rate, "trigger_rate", "Hz", 0, 100,
             "of square pulses on the trigger line, the first rising at the start of the run; 0: none",
             choice);
    describe_outputs(s, o);
    describe_line(s, o);
    o.whole(s.serial_number, "serial_number", "", 0, 999999, "of the unit", choice);
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the end of listening to the report",
             "own fit: a published report of a DVL1000 without a bottom left 156 ms after its trigger");
    o.number(s.temperature, "water_temperature", "degC", -4, 40, "which its sensor reads", choice);
    o.number(s.voltage, "voltage", "V", 9, 48, "of its supply, which it tells in PNORBT8 and PNORBT9",
             "published lines of a DVL1000: 23.5 V");
    o.number(s.noise.floor, "noise", "m/s", 0, 1, "of a beam's velocity at rest and near the bottom",
             recorded);
    o.number(s.noise.by_altitude, "noise_by_altitude", "m/s per m", 0, 0.1, "more of it with altitude",
             recorded);
    o.number(s.noise.by_speed, "noise_by_speed", "", 0, 0.1, "more of it with speed", "own estimate");
    o.number(s.noise.bias, "bias", "m/s", 0, 0.1, "of a beam's velocity, which drifts within minutes",
             "maximilian-nitsch/DVL-Simulator, fitted to real A50 data");
    o.number(s.noise.scale, "scale", "", 0, 0.1, "of velocities: standard deviation among units", choice);
    doppler::describe(s.acoustics, f, "reads 0 dBm, which it does not tell");
}

Settings read_settings(const DeviceConfig& config, const std::string& product) {
    auto s = fill_settings<Settings>(config);
    s.unix_start = config.unix_start;
    s.product = product;
    return s;
}

}  // namespace echoloop::nortek_dvl
