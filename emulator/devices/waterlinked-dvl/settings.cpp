#include "emulator/devices/waterlinked-dvl/settings.h"

#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/contract/random_key.h"

namespace echoloop::waterlinked_dvl {
namespace {

const char* const maker = "maker's documentation";
const char* const own = "own choice";

void describe_start(Configuration& c, OptionList& o) {
    o.number(c.speed_of_sound, "speed_of_sound", "m/s", 1000, 2000,
             "that it assumes; a host may set another. The water has its own", maker);
    o.number(c.mounting_rotation_offset, "mounting_rotation_offset", "deg", 0, 360,
             "by which velocities are turned about z", maker);
    o.flag(c.acoustic_enabled, "acoustic_enabled", "it pings by itself from the start", maker);
    std::string mode = c.range_mode.text;
    o.text(mode, "range_mode", "auto, =a, a<=b with modes 0 to 4, or wt: water tracking", maker);
    const auto read = read_range_mode(mode);
    if (!read)
        throw std::invalid_argument("option 'range_mode': '" + mode +
                                    "' is none; write auto, =2, 1<=3 or wt (modes are 0 to 4)");
    c.range_mode = *read;
    o.flag(c.periodic_cycling_enabled, "periodic_cycling",
           "every ten seconds it looks whether there is a nearer bottom", maker);
}

void describe_words(Settings& s, OptionList& o) {
    o.choice(s.level, "software", {"2.2", "2.4", "2.6", "2.7.1", "2.7.2"},
             "version; which commands and which format of JSON it has follow", maker);
    o.choice(s.performance, "variant", {"standard", "performance"},
             "how exact its scale is: 1 % or 0.1 % (standard deviation among units)", "maker's product page");
    o.words(s.serial_output, "serial_output",
            {{"off", SerialOutput::off},
             {"v1_v2", SerialOutput::v1_and_v2},
             {"pd6", SerialOutput::pd6},
             {"v2", SerialOutput::v2},
             {"pd4", SerialOutput::pd4}},
            "what the serial line says until a host chooses by wcp", maker);
    o.number(s.position_rate, "position_rate", "Hz", 1, 20, "of dead reckoning; 10 was seen of a demo unit",
             maker);
    o.choice(s.position_in_uptime, "position_time", {"unix", "uptime"},
             "of dead reckoning: a published sample looks like the time since the start", maker);
    o.number(s.altitude_offset, "altitude_offset", "m", 0, 0.1,
             "by which the altitude is less than the beams make it", "two of three published samples");
    o.choice(s.line_feed_only, "line_end", {"crlf", "lf"}, "of JSON", "lines of a demo unit");
    o.flag(s.strict_read, "strict_read",
           "all that comes in one piece by TCP is one document, so that two commands in one are refused",
           "own choice, so that hosts are not at the mercy of TCP; a demo unit is strict");
    o.flag(s.invalid_lines_when_off, "invalid_lines_when_off",
           "with acoustics off it says twice a second that it has no velocity", own);
    o.choice(s.water_as_velocity, "water_type", {"velocity_water", "velocity"},
             "type of reports in water tracking; libwaterlinked knows velocity only", maker);
    o.choice(s.commas_in_version, "wrv", {"dots", "commas"}, "how wrv writes the version", maker);
}

void describe_unit(Settings& s, OptionList& o) {
    o.choice(s.ntp_reached, "ntp", {"unreachable", "synchronised"}, "whether it has a time server", own);
    o.flag(s.any_page, "any_page", "web pages from elsewhere may ask by HTTP",
           "own choice; the real one does not look");
    o.number(s.boot_time, "boot_time", "s", 0, 120,
             "at the start, in which it says and hears nothing; a real one takes 20 to 90", own);
    o.number(s.processing_time, "processing_time", "s", 0, 1,
             "from the last echo to the report, in the mean; a published sample has 0.189", maker);
    o.number(s.temperature, "temperature", "degC", -5, 80,
             "inside: from 50 on its status says so, at 55 it stops pinging",
             "own choice; limits: " + std::string(maker));
    o.number(s.water_temperature, "water_temperature", "degC", -4, 40, "in PD4 and PD6", own);
    o.number(s.baud, "baud", "bit/s", 0, 4e6, "of the serial line, not of TCP; 0: not paced", maker);
    doppler::describe(s.noise, o);
    o.number(s.noise.gyro, "gyro_bias", "deg/h", 0, 360,
             "of the yaw, which dead reckoning follows; calibrate_gyro takes nine tenths of it",
             "own estimate");
}

}  // namespace

Settings::Settings() {
    for (const double azimuth : {135, 225, 315, 45}) azimuths.push_back(deg_to_rad(azimuth));
    altitude_offset = 0.015;
}

std::string_view Settings::version() const {
    constexpr std::string_view names[] = {"2.2.1", "2.4.0", "2.6.0", "2.7.1", "2.7.2"};
    return names[static_cast<std::size_t>(level)];
}

std::string_view Settings::format() const {
    constexpr std::string_view names[] = {"json_v3", "json_v3.1", "json_v3.1", "json_v3.2", "json_v3.3"};
    return names[static_cast<std::size_t>(level)];
}

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_start(s.start, o);
    describe_words(s, o);
    describe_unit(s, o);
    doppler::describe(s.acoustics, f, "reads 0 dBm in rssi and nsd");
}

Settings read_settings(const DeviceConfig& config, std::string_view product) {
    auto s = fill_settings<Settings>(config);
    constexpr double standard_scale = 0.01, performance_scale = 0.001;
    s.noise.scale = s.performance ? performance_scale : standard_scale;
    s.product = product;
    s.unix_start = config.unix_start;
    s.chip_id = split_mix(config.random_key);
    return s;
}

}  // namespace echoloop::waterlinked_dvl
