#include "emulator/devices/oculus/settings.h"

#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/oculus/request.h"

namespace echoloop::oculus_device {
namespace {

const char* const spec = "Oculus specification notes";
const char* const own = "own choice";

oculus::Ipv4 read_mask(const std::string& text) {
    try {
        return to_ipv4(parse_endpoint("udp-listen://" + text + ":0").ip);
    } catch (const std::invalid_argument&) {
        throw std::invalid_argument("option mask: '" + text + "' is no IPv4 mask; write e.g. 255.255.255.0");
    }
}

void describe_identity(Settings& s, OptionList& o) {
    o.whole(s.device_id, "device_id", "", 1, 65535, "in the status and in every message", own);
    o.whole(s.message_id, "message_device_id", "", 0, 65535,
            "in dummies and results; 0: the one in the status, which drivers expect", spec);
    o.whole(s.part_number, "part_number", "", 0, 65535, "in the status; 0: the model's", spec);
    std::string mask = "255.255.255.0";
    o.text(mask, "mask", "network mask in the status", own);
    s.mask = read_mask(mask);
    o.number(s.temperature, "temperature", "degC", -4, 40,
             "at the sonar's own sensor: in status and results, and for the speed of sound", own);
    o.number(s.link_speed, "link_speed", "Mbit/s", 1, 1e5, "bounds the ping rate of long images", own);
}

void describe_status(Settings& s, OptionList& o) {
    o.number(s.status_period, "status_period", "s", 0.05, 60, "between status datagrams", spec);
    o.whole(s.status_id, "status_message_id", "", 0, 65535, "of the status, which readers do not check",
            spec);
    o.whole(s.status_bits, "status_bits", "", 0, 0xFFFFFFFF,
            "in the status: bits 0-2 state, 3 is normal, any other stops the pings, as bit 15 does; also as "
            "0x8003",
            spec);
    o.number(s.silence_limit, "silence_limit", "s", 0, 3600,
             "a host that is silent for this long is disconnected; 0: never. One driver reports 1 s", spec);
    o.choice(s.hang_up_on_fire, "hang_up_on_fire", {"never", "first", "always"},
             "the connection is lost on the first fire message after power-up, or on each; users report this "
             "fault",
             spec);
    o.choice(s.garbage_sensors, "sensors", {"sane", "garbage"},
             "temperature and pressure in results; real units fill in garbage", spec);
}

void describe_answers(Settings& s, OptionList& o) {
    o.choice(s.answer, "result_version", {"asked", "v1", "v2"},
             "version of the fire message, or always the same; users report this fault", spec);
    o.words(s.data_16_bit_set, "data_16_bit", {{"set", true}, {"clear", false}},
            "value of flag bit 1 with which a host asks for 16-bit data", spec);
    o.choice(s.percent_in_32_bit, "range_in_32_bit", {"flag", "percent"},
             "unit of the range in 32-bit mode: as bit 0 says, or %", spec);
    o.choice(s.float_gain_words, "gain_word", {"u32", "f32"},
             "gain before each row: g of amplitude = sample / sqrt(g)", spec);
    o.words(s.scaled_gain_echo, "gain_echo", {{"scaled", true}, {"plain", false}},
            "in mode 2: 40 + 0.6 g with a gain to match, or g unchanged (older firmware)", spec);
    o.choice(s.echo_used_sound_speed, "sound_speed_echo", {"requested", "used"}, "in the echoed settings",
             spec);
    o.choice(s.useless_rate_echo, "rate_echo", {"requested", "useless"},
             "in the echoed settings; useless: 195, as in a real recording", spec);
    o.choice(s.starboard_negative, "negative_bearing", {"port", "starboard"}, "the side of negative bearings",
             spec);
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the last echo to the message",
             "own choice: 40 Hz is reached up to 12 m; real pings of 2 m come at 16 Hz");
}

void describe_mode(ModeFigures& m, const std::string& mode, FigureList& f) {
    f.number(m.frequency, mode + "_frequency", "Hz", 100e3, 10e6, "centre frequency");
    f.degrees(m.beam_width, mode + "_beam_width", 0.05, 10, "of one beam, -3 dB full width");
    f.degrees(m.fan_height, mode + "_fan_height", 0.5, 60, "vertical, -3 dB full width, two-way");
    f.degrees(m.aperture, mode + "_aperture", 5, 170, "from the first to the last beam");
    f.number(m.range, mode + "_range", "m", 0.5, 500, "the longest");
    f.number(m.rate, mode + "_rate", "Hz", 0.1, 100, "the most pings");
    f.number(m.sample_rate, mode + "_sample_rate", "Hz", 1e3, 1e7,
             "of the finest images' rows; other images use a whole fraction of it");
    f.number(m.bandwidth, mode + "_bandwidth", "Hz", 1e3, 1e7, "of the chirp");
    f.number(m.source_level, mode + "_source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis");
    f.number(m.tvg_absorption, mode + "_tvg_absorption", "dB/m", 0, 10, "time-varied gain, one way");
    f.number(m.tvg_nearest, mode + "_tvg_nearest", "m", 0.05, 10, "from there inwards the gain is the same");
    f.number(m.tvg_limit, mode + "_tvg_limit", "dB", 0, 46, "the most time-varied gain");
    f.number(m.reference_level, mode + "_reference_level", "dB re 1 uPa", 0, 300,
             "reads full scale at 0 % gain without time-varied gain");
}

void describe_profile(Acoustics& a, std::uint16_t device_id, FigureList& f) {
    f.number(a.pulse_length, "pulse_length", "s", 1e-6, 1e-2, "of the chirp");
    f.number(a.shortest_range, "shortest_range", "m", 0.05, 5, "that can be set");
    f.whole(a.rows, "rows", 16, 4096, "the most of an image");
    f.whole(a.beams, "beams", 256, 512, "the most of an image");
    f.number(a.high.directivity_index, "high_directivity_index", "dB", 0, 60,
             "of the receiver in the high mode; directivity_index is the low one");
    f.number(a.high.self_noise, "high_self_noise", "dB re 1 uPa^2/Hz", -100, 200,
             "of the receiver in the high mode; self_noise is the low one");
    f.number(a.gain_span, "gain_span", "dB", 0, 40, "from 0 to 100 % gain");
    f.number(a.tvg_spreading, "tvg_spreading", "dB per decade of range", 0, 60, "time-varied gain");
    describe_mode(a.low, "low", f);
    describe_mode(a.high, "high", f);
    f.common(a.horizontal, a.vertical, a.receiver);
    f.stave_errors(a.errors, std::to_string(device_id));
    a.low.directivity_index = a.receiver.directivity_index;
    a.low.self_noise = a.receiver.self_noise;
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_identity(s, o);
    describe_status(s, o);
    describe_answers(s, o);
    std::uint16_t part_number = 0;
    f.whole(part_number, "part_number", 1, 65535, "in the status");
    if (s.part_number == 0) s.part_number = part_number;
    describe_profile(s.acoustics, s.device_id, f);
}

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    if (s.message_id == 0) s.message_id = s.device_id;
    s.tvg = config.effects.has(Effect::tvg);
    return s;
}

}  // namespace echoloop::oculus_device
