#include "emulator/devices/oculus/settings.h"

#include <stdexcept>

#include "emulator/devices/oculus/request.h"
#include "emulator/contract/endpoint.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::oculus_device {
namespace {

const char* const spec = "Oculus specification notes";

ModeFigures read_mode(const Profile& p, const std::string& mode) {
    ModeFigures m;
    m.frequency = figure(p, mode + "_frequency");
    m.beam_width = deg_to_rad(figure(p, mode + "_beam_width"));
    m.fan_height = deg_to_rad(figure(p, mode + "_fan_height"));
    m.aperture = deg_to_rad(figure(p, mode + "_aperture"));
    m.range = figure(p, mode + "_range");
    m.rate = figure(p, mode + "_rate");
    m.sample_rate = figure(p, mode + "_sample_rate");
    m.bandwidth = figure(p, mode + "_bandwidth");
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
    a.shortest_range = figure(p, "shortest_range");
    a.rows = static_cast<std::size_t>(figure(p, "rows"));
    a.beams = static_cast<std::size_t>(figure(p, "beams"));
    a.processing = figure(p, "processing_time");
    a.reference_level = figure(p, "reference_level");
    a.gain_span = figure(p, "gain_span");
    a.tvg_spreading = figure(p, "tvg_spreading");
    a.tvg_limit = figure(p, "tvg_limit");
    return a;
}

oculus::Ipv4 read_mask(const std::string& text) {
    try {
        return to_ipv4(parse_endpoint("udp-listen://" + text + ":0").ip);
    } catch (const std::invalid_argument&) {
        throw std::invalid_argument("option mask: '" + text + "' is no IPv4 mask; write e.g. 255.255.255.0");
    }
}

std::vector<FigureRow> mode_rows(const std::string& mode) {
    return {
        {mode + "_frequency", "Hz", "centre frequency", 100e3, 10e6},
        {mode + "_beam_width", "deg", "of one beam, -3 dB full width", 0.05, 10},
        {mode + "_fan_height", "deg", "vertical, -3 dB full width, two-way", 0.5, 60},
        {mode + "_aperture", "deg", "from the first to the last beam", 5, 170},
        {mode + "_range", "m", "the longest", 0.5, 500},
        {mode + "_rate", "Hz", "the most pings", 0.1, 100},
        {mode + "_sample_rate", "Hz", "rows of the finest images; others have a whole fraction of it", 1e3,
         1e7},
        {mode + "_bandwidth", "Hz", "of the chirp", 1e3, 1e7},
        {mode + "_source_level", "dB re 1 uPa at 1 m", "on the axis", 100, 240},
        {mode + "_tvg_absorption", "dB/m", "time-varied gain, one way", 0, 10},
    };
}

std::vector<Option> identity_options() {
    return {
        integer_row("device_id", "", 1001, 1, 65535, "in the status and in every message", "own choice"),
        integer_row("message_device_id", "", 0, 0, 65535,
                    "in dummies and results; 0: that of the status, as drivers insist", spec),
        integer_row("part_number", "", 0, 0, 65535, "in the status; 0: of the model", spec),
        text_row("mask", "255.255.255.0", "network mask in the status", "own choice"),
        number_row("temperature", "degC", 10, -4, 40,
                   "at the sonar's own sensor: in status and results, and for the speed of sound",
                   "own choice"),
        number_row("link_speed", "Mbit/s", 1000, 1, 1e5, "bounds the ping rate of long images", "own choice"),
        number_row("status_period", "s", 1, 0.05, 60, "between status datagrams", spec),
        integer_row("status_message_id", "", 0, 0, 65535, "of the status, which readers do not check", spec),
        integer_row("status_bits", "", 3, 0, 0xFFFFFFFF,
                    "in the status: bits 0-2 state, 3 is normal; bit 15 stops the pings", spec),
        number_row("silence_limit", "s", 0, 0, 3600,
                   "a host that says nothing for so long is hung up on; 0: never. One driver tells of 1 s",
                   spec),
        choice_row(
            "hang_up_on_fire", {"never", "first", "always"},
            "the connection is lost on a fire, the first one since power-up or each: a fault that users "
            "complain of",
            spec),
        choice_row("sensors", {"sane", "garbage"},
                   "temperature and pressure in results; real units fill in garbage", spec),
    };
}

std::vector<Option> answer_options() {
    return {
        choice_row("result_version", {"asked", "v1", "v2"},
                   "of the fire, or always one: a fault that users complain of", spec),
        choice_row("data_16_bit", {"set", "clear"}, "flag bit 1 of a host that wants 16-bit data", spec),
        choice_row("range_in_32_bit", {"flag", "percent"},
                   "unit of the range in 32-bit mode: as bit 0 says, or %", spec),
        choice_row("gain_word", {"u32", "f32"}, "gain before each row: g of amplitude = sample / sqrt(g)",
                   spec),
        choice_row("gain_echo", {"scaled", "plain"},
                   "in mode 2: 40 + 0.6 g and gain to match, or g as it came (older firmware)", spec),
        choice_row("sound_speed_echo", {"requested", "used"}, "in the echoed settings", spec),
        choice_row("rate_echo", {"requested", "useless"}, "in the echoed settings; a real unit has 195 there",
                   spec),
        choice_row("negative_bearing", {"port", "starboard"}, "the side of negative bearings", spec),
    };
}

}  // namespace

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"part_number", "", "in the status", 1, 65535, true},
        {"pulse_length", "s", "of the chirp", 1e-6, 1e-2},
        {"shortest_range", "m", "that can be set", 0.05, 5},
        {"rows", "", "the most of an image", 16, 4096, true},
        {"beams", "", "the most of an image", 256, 512, true},
        {"processing_time", "s", "from the last echo to the message", 0, 1},
        {"high_directivity_index", "dB", "of the receiver in the high mode; directivity_index is the low one",
         0, 60},
        {"reference_level", "dB re 1 uPa", "reads full scale at 0 % gain within a metre", 0, 300},
        {"gain_span", "dB", "from 0 to 100 % gain", 0, 40},
        {"tvg_spreading", "dB per decade of range", "time-varied gain", 0, 60},
        {"tvg_limit", "dB", "the most time-varied gain", 0, 46},
    };
    for (auto more : {mode_rows("low"), mode_rows("high"), common_figures()})
        std::move(more.begin(), more.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    std::vector<Option> all = identity_options();
    auto more = answer_options();
    std::move(more.begin(), more.end(), std::back_inserter(all));
    return all;
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.device_id = static_cast<std::uint16_t>(integer(o, "device_id"));
    s.message_id = static_cast<std::uint16_t>(integer(o, "message_device_id"));
    if (s.message_id == 0) s.message_id = s.device_id;
    s.part_number = static_cast<std::uint16_t>(integer(o, "part_number"));
    if (s.part_number == 0) s.part_number = static_cast<std::uint16_t>(figure(config.profile, "part_number"));
    s.mask = read_mask(text(o, "mask"));
    s.temperature = number(o, "temperature");
    s.link_speed = number(o, "link_speed");
    s.status_period = number(o, "status_period");
    s.status_id = static_cast<std::uint16_t>(integer(o, "status_message_id"));
    s.status_bits = static_cast<std::uint32_t>(integer(o, "status_bits"));
    s.garbage_sensors = text(o, "sensors") == "garbage";
    s.silence_limit = number(o, "silence_limit");
    const std::string& hang_up = text(o, "hang_up_on_fire");
    s.hang_up_on_fire = hang_up == "first"    ? HangUp::first
                        : hang_up == "always" ? HangUp::always
                                              : HangUp::never;
    const std::string& version = text(o, "result_version");
    s.answer = version == "v1" ? Answer::v1 : version == "v2" ? Answer::v2 : Answer::as_asked;
    s.data_16_bit_set = text(o, "data_16_bit") == "set";
    s.percent_in_32_bit = text(o, "range_in_32_bit") == "percent";
    s.float_gain_words = text(o, "gain_word") == "f32";
    s.scaled_gain_echo = text(o, "gain_echo") == "scaled";
    s.echo_used_sound_speed = text(o, "sound_speed_echo") == "used";
    s.useless_rate_echo = text(o, "rate_echo") == "useless";
    s.starboard_negative = text(o, "negative_bearing") == "starboard";
    s.tvg = config.effects.has(Effect::tvg);
    s.acoustics = read_acoustics(config.profile);
    return s;
}

}  // namespace echoloop::oculus_device
