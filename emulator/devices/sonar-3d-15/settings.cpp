#include "emulator/devices/sonar-3d-15/settings.h"

#include <iterator>
#include <stdexcept>

#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::sonar_3d_15 {
namespace {

const char* const spec = "Sonar 3D-15 specification notes";
const char* const maker = "maker's documentation (github.com/waterlinked/docs)";

ModeFigures read_mode(const Profile& p, const std::string& mode) {
    ModeFigures m;
    m.frequency = figure(p, mode + "_frequency");
    m.beam_width = deg_to_rad(figure(p, mode + "_beam_width"));
    m.fan_height = deg_to_rad(figure(p, mode + "_fan_height"));
    m.fov_horizontal = deg_to_rad(figure(p, mode + "_fov_horizontal"));
    m.fov_vertical = deg_to_rad(figure(p, mode + "_fov_vertical"));
    m.rate = figure(p, mode + "_rate");
    m.source_level = figure(p, mode + "_source_level");
    m.directivity_index = figure(p, mode == "low" ? "directivity_index" : "high_directivity_index");
    m.tvg_absorption = figure(p, mode + "_tvg_absorption");
    return m;
}

Acoustics read_acoustics(const Profile& p) {
    Acoustics a;
    a.low = read_mode(p, "low");
    a.high = read_mode(p, "high");
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    a.pulse_length = figure(p, "pulse_length");
    a.longest_range = figure(p, "longest_range");
    a.processing = figure(p, "processing_time");
    a.finest_bin = figure(p, "finest_bin");
    a.bins = static_cast<std::size_t>(figure(p, "bins"));
    a.detection = figure(p, "detection_level");
    a.reference_level = figure(p, "reference_level");
    a.tvg_spreading = figure(p, "tvg_spreading");
    return a;
}

std::vector<FigureRow> mode_rows(const std::string& mode) {
    return {
        {mode + "_frequency", "Hz", "centre frequency", 100e3, 10e6},
        {mode + "_beam_width", "deg", "of one beam, -3 dB full width", 0.05, 10},
        {mode + "_fan_height", "deg", "of one beam, -3 dB full height", 0.05, 20},
        {mode + "_fov_horizontal", "deg", "between the centres of the outer pixels of a row", 5, 120},
        {mode + "_fov_vertical", "deg", "between the centres of the first and the last row", 5, 60},
        {mode + "_rate", "Hz", "images, where the range allows it", 0.1, 40},
        {mode + "_source_level", "dB re 1 uPa at 1 m", "all over the view", 100, 240},
        {mode + "_tvg_absorption", "dB/m", "time-varied gain, one way", 0, 10},
    };
}

std::vector<Option> start_options() {
    return {
        flag_row("acoustics", false, "pings and images from the start, before a host has enabled them",
                 maker),
        choice_row("mode", {"low-frequency", "high-frequency"}, "at the start", "own choice"),
        number_row("range_min", "m", 0.5, 0, 100, "at the start", spec),
        number_row("range_max", "m", 15, 0.1, 100, "at the start; the profile says the longest", spec),
        number_row("speed_of_sound", "m/s", 1491, 0, 2000, "at the start; 0: from salinity and temperature",
                   spec),
        choice_row("salinity", {"salt", "fresh"}, "at the start, for the automatic speed of sound",
                   "own choice"),
        choice_row("udp", {"multicast", "disabled"},
                   "images at the start, where no second endpoint says unicast", spec),
    };
}

std::vector<Option> answer_options() {
    return {
        choice_row("release", {"1.7.0", "1.6.0", "1.5.1"},
                   "of the firmware; status, mode and salinity came with 1.7.0", spec),
        choice_row("packets", {"RIP2", "RIP1"}, "RIP1 is not compressed; older firmware sends it", spec),
        choice_row("package", {"waterlinked.sonar.protocol", "waterlinked.rip1"}, "of the protobuf messages",
                   spec),
        choice_row("frequency_field", {"5", "hertz"}, "in images: as a real sonar sends, or as documented",
                   spec),
        choice_row("first_row", {"down", "up"}, "where row 0 looks", spec),
        flag_row("other_messages", false,
                 "a message of an undocumented type follows the images of each shot: readers must skip it",
                 spec),
        number_row("temperature", "degC", 21, -20, 100, "inside the sonar", spec),
        number_row("water_temperature", "degC", 10, -4, 40, "for the automatic speed of sound", "own choice"),
        number_row("speed_delay", "s", 0, 0, 120, "until a new speed of sound is used; real units take 20",
                   spec),
    };
}

std::array<int, 3> read_release(const std::string& text) {
    return {text[0] - '0', text[2] - '0', text[4] - '0'};  // of the option's choices
}

State read_start(const Options& o, const Acoustics& a) {
    State s;
    s.enabled = flag(o, "acoustics");
    s.high = text(o, "mode") == "high-frequency";
    s.range_min = number(o, "range_min");
    s.range_max = number(o, "range_max");
    s.speed = number(o, "speed_of_sound");
    s.salt = text(o, "salinity") == "salt";
    s.udp = text(o, "udp") == "multicast" ? UdpMode::multicast : UdpMode::disabled;
    if (s.range_min >= s.range_max || s.range_max > a.longest_range)
        throw std::invalid_argument("options range_min and range_max must ascend and end within " +
                                    std::to_string(a.longest_range) + " m");
    if (s.speed != 0 && s.speed < 1000)
        throw std::invalid_argument("option speed_of_sound must be 0 (automatic) or 1000 to 2000 m/s");
    return s;
}

}  // namespace

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"pulse_length", "s", "of the chirp", 1e-6, 1e-2},
        {"longest_range", "m", "that can be set", 1, 100},
        {"processing_time", "s", "from the last echo to the image, at least", 0, 1},
        {"finest_bin", "m", "of range, before the peak is interpolated", 0.001, 1},
        {"bins", "", "of range, the most", 16, 2048, true},
        {"detection_level", "dB", "above the noise that an echo must have to be one", 0, 60},
        {"high_directivity_index", "dB", "of the receiver in the high mode; directivity_index is the low one",
         0, 60},
        {"reference_level", "dB re 1 uPa", "reads strength 0 at 1 m", 0, 300},
        {"tvg_spreading", "dB per decade of range", "time-varied gain", 0, 60},
    };
    for (auto more : {mode_rows("low"), mode_rows("high"), common_figures()})
        std::move(more.begin(), more.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    std::vector<Option> all = start_options();
    auto more = answer_options();
    std::move(more.begin(), more.end(), std::back_inserter(all));
    return all;
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.acoustics = read_acoustics(config.profile);
    s.start = read_start(o, s.acoustics);
    s.release = read_release(text(o, "release"));
    s.version = text(o, "packets") == "RIP1" ? sonar3d::Version::rip1 : sonar3d::Version::rip2;
    s.package = text(o, "package");
    s.frequency_in_hertz = text(o, "frequency_field") == "hertz";
    s.first_row_up = text(o, "first_row") == "up";
    s.other_messages = flag(o, "other_messages");
    s.temperature = number(o, "temperature");
    s.water_temperature = number(o, "water_temperature");
    s.speed_delay = number(o, "speed_delay");
    s.tvg = config.effects.has(Effect::tvg);
    s.unix_start = config.unix_start;
    return s;
}

}  // namespace echoloop::sonar_3d_15
