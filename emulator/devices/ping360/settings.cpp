#include "emulator/devices/ping360/settings.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "emulator/devices/family/ping/link.h"
#include "emulator/devices/ping360/discovery.h"
#include "emulator/contract/endpoint.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::ping360 {
namespace {

const char* const spec = "Ping specification notes";

std::vector<Option> identity_options() {
    return {
        text_row("firmware", "3.3.8", "version; hosts scan by auto_transmit above 3.3.0, else ping by ping",
                 spec),
        text_row("protocol_version", "1.0.0", "version of the message set; one host's test stops on 1.1.0",
                 spec),
        integer_row("device_type", "", 2, 1, 255, "in device_information", spec),
        integer_row("device_revision", "", 1, 1, 255, "in device_information", spec),
        text_row("discovery", "auto",
                 "IPv4 address to announce on UDP 30303; auto: that of an endpoint "
                 "udp-listen://ADDRESS:12345, where "
                 "hosts go then, and silent without one; off: silent",
                 spec),
        number_row("baud", "bit/s", 0, 0, 4e6, "line rate of pty and TCP endpoints; 0: not paced", spec),
        flag_row("automatic_baud", true,
                 "a pty is as fast as its driver sets it, whatever baud says; false: another rate than baud "
                 "makes garbage",
                 spec),
        flag_row("marks_are_breaks", true,
                 "0x55 where a frame should begin ends an automatic scan as a break does", spec),
    };
}

std::vector<Option> answer_options() {
    return {
        choice_row("echoed_400", {"0", "400"}, "angle in the reply to a command with angle 400", spec),
        choice_row("data_on_request", {"empty", "last"}, "samples of a device_data that is only asked for",
                   spec),
        choice_row("invalid_settings", {"nack", "accept"}, "values outside the documented ranges", spec),
        choice_row("common_set_id", {"nack", "ack"}, "answer to message 100", spec),
        choice_row("nacked_id", {"request", "requested"},
                   "id in the nack of a general_request: 6, or the id that was asked for", spec),
        choice_row("set_id_reply", {"ack", "none"}, "answer to message 2000", spec),
    };
}

std::vector<Option> head_options() {
    return {
        integer_row("forward_angle", "grad", 200, 0, 399, "the angle that looks along x of the mount", spec),
        choice_row("rotation", {"clockwise", "counter-clockwise"}, "rising angles, seen from above", spec),
        choice_row("turn_around", {"once", "twice"}, "pings at the end of a sector", spec),
        number_row("turn_time", "s", 2.4, 0.01, 60, "motor: 400 gradians", spec),
        number_row("idle_off", "s", 30, 0, 1e6, "idle time after which the next move homes first; 0: never",
                   spec),
        flag_row("ring_down", true, "the transmitter's own sound in the first samples",
                 "shape of two public recordings"),
    };
}

Acoustics read_acoustics(const Profile& p, bool tvg, bool ring_down) {
    Acoustics a;
    a.centre_frequency = figure(p, "centre_frequency");
    a.response_width = figure(p, "response_width");
    a.source_level = figure(p, "source_level");
    a.beam_width = deg_to_rad(figure(p, "beam_width"));
    a.fan_height = deg_to_rad(figure(p, "fan_height"));
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    a.reference_level = figure(p, "reference_level");
    a.full_scale = figure(p, "full_scale");
    a.gain_step = figure(p, "gain_step");
    a.tvg_spreading = tvg ? figure(p, "tvg_spreading") : 0;
    a.tvg_absorption = tvg ? figure(p, "tvg_absorption") : 0;
    if (ring_down)
        a.ring_down = {figure(p, "ring_down_first"), figure(p, "ring_down_top"), figure(p, "ring_down_rise"),
                       figure(p, "ring_down_decay"), figure(p, "ring_down_hold")};
    return a;
}

/// The address to announce, 0 for none.
std::uint32_t announced(const std::string& word, const std::vector<std::string>& endpoints) {
    if (word == "off") return 0;
    if (word == "auto") {
        for (const std::string& uri : endpoints) {
            const Endpoint e = parse_endpoint(uri);
            if (e.scheme == Endpoint::Scheme::udp_listen && e.port == found_port) return e.ip;
        }
        return 0;
    }
    const auto address = read_address(word);
    if (!address || *address == 0)
        throw std::invalid_argument("option 'discovery': '" + word +
                                    "' is no address; write auto, off, or one like 192.168.2.3");
    return *address;
}

/// dB that are lost away from the transducer's own frequency, there and back: 3 dB each way at the band's
/// edge.
double detuning(double frequency, const Acoustics& a) {
    const double off = 2 * (frequency - a.centre_frequency) / a.response_width;
    return std::min(60.0, 6 * off * off);
}

}  // namespace

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"centre_frequency", "Hz", "where the transducer is loudest", 10e3, 10e6},
        {"response_width", "Hz", "-3 dB full width of the transducer, one way", 1e3, 5e6},
        {"source_level", "dB re 1 uPa at 1 m", "on the axis", 100, 240},
        {"beam_width", "deg", "horizontal -3 dB full width, two-way", 0.1, 60},
        {"fan_height", "deg", "vertical -3 dB full width, two-way", 0.1, 120},
        {"tvg_spreading", "dB per decade of range", "time-varied gain", 0, 60},
        {"tvg_absorption", "dB/m", "time-varied gain, one way", 0, 2},
        {"reference_level", "dB re 1 uPa", "level after time-varied gain that reads 0 at low gain", 0, 300},
        {"full_scale", "dB", "from 0 to 255", 10, 120},
        {"ring_down_first", "counts", "first sample, of the transmitter's own sound", 0, 255},
        {"ring_down_top", "counts", "its loudest sample", 0, 255},
        {"ring_down_rise", "s", "time constant from the first to the loudest", 1e-7, 0.01},
        {"ring_down_hold", "s", "from the first sample until it decays", 0, 0.01},
        {"ring_down_decay", "s", "time constant of the counts afterwards", 1e-7, 0.1},
        {"gain_step", "dB", "from low to normal and from normal to high gain", 0, 40},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    std::vector<Option> all = identity_options();
    for (auto more : {answer_options(), head_options()})
        std::move(more.begin(), more.end(), std::back_inserter(all));
    return all;
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.firmware = ping_device::read_version(text(o, "firmware"), "firmware");
    s.protocol = ping_device::read_version(text(o, "protocol_version"), "protocol_version");
    s.device_type = static_cast<std::uint8_t>(integer(o, "device_type"));
    s.device_revision = static_cast<std::uint8_t>(integer(o, "device_revision"));
    s.discovery = announced(text(o, "discovery"), config.endpoints);
    s.baud = number(o, "baud");
    s.line = read_serial_rate(config);
    s.marks_are_breaks = flag(o, "marks_are_breaks");
    s.echo_400 = text(o, "echoed_400") == "400";
    s.last_data_on_request = text(o, "data_on_request") == "last";
    s.accept_anything = text(o, "invalid_settings") == "accept";
    s.accept_common_id = text(o, "common_set_id") == "ack";
    s.nack_requested_id = text(o, "nacked_id") == "requested";
    s.ack_set_id = text(o, "set_id_reply") == "ack";
    s.forward_angle = static_cast<int>(integer(o, "forward_angle"));
    s.clockwise = text(o, "rotation") == "clockwise";
    s.ends_twice = text(o, "turn_around") == "twice";
    s.turn_time = number(o, "turn_time");
    s.idle_off = number(o, "idle_off");
    s.acoustics = read_acoustics(config.profile, config.effects.has(Effect::tvg), flag(o, "ring_down"));
    return s;
}

ping::DeviceData boot_settings() {
    ping::DeviceData d;
    d.mode = 1;
    d.transmit_duration = 32;
    d.sample_period = 80;
    d.transmit_frequency = 740;
    d.number_of_samples = 1024;
    return d;
}

Shot shot_from(const ping::DeviceData& settings, int angle, const Settings& options) {
    constexpr double gradian = std::numbers::pi / 200, tick = 25e-9;
    constexpr int most_samples = 1200;
    const Acoustics& a = options.acoustics;
    const int turned = (angle - options.forward_angle) * (options.clockwise ? 1 : -1);
    Shot shot;
    shot.pan = std::remainder(turned * gradian, 2 * std::numbers::pi);
    shot.bearings = {0.0};
    shot.beam_width = a.beam_width;
    shot.fan_height = a.fan_height;
    shot.bins = static_cast<std::size_t>(std::clamp<int>(settings.number_of_samples, 1, most_samples));
    shot.bin_interval = std::max<int>(settings.sample_period, 1) * tick;
    shot.frequency = std::max<int>(settings.transmit_frequency, 100) * 1e3;
    shot.pulse_length = std::max<int>(settings.transmit_duration, 1) * 1e-6;
    shot.source_level = a.source_level - detuning(shot.frequency, a);
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    return shot;
}

}  // namespace echoloop::ping360
