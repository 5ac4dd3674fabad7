#include "emulator/devices/ping360/settings.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/family/ping/link.h"
#include "emulator/devices/ping360/discovery.h"

namespace echoloop::ping360 {
namespace {

const char* const spec = "Ping specification notes";

void describe_identity(Settings& s, OptionList& o) {
    ping_device::version(s.firmware, o, "firmware",
                         "version; automatic scans (2602, 2301) are there above 3.3.0, and refused before",
                         spec);
    std::string message_set = "auto";
    o.text(message_set, "protocol_version",
           "version of the message set; auto: 1.1.0, which brought automatic scans, where the firmware has "
           "them, "
           "else 1.0.0. One host's test stops on 1.1.0",
           "history of the message definitions");
    s.protocol = {1, static_cast<std::uint8_t>(s.scans_by_itself()), 0};
    if (message_set != "auto") s.protocol = ping_device::read_version(message_set, "protocol_version");
    o.whole(s.device_type, "device_type", "", 1, 255, "in device_information", spec);
    o.whole(s.device_revision, "device_revision", "", 1, 255, "in device_information", spec);
    o.text(s.discovery, "discovery",
           "IPv4 address to announce on UDP 30303; auto: that of an endpoint udp-listen://ADDRESS:12345, if "
           "there is one; off: silent",
           spec);
    describe(s.baud, s.line, o);
    o.flag(s.marks_are_breaks, "marks_are_breaks",
           "0x55 where a frame should begin ends an automatic scan as a break does", spec);
}

void describe_answers(Settings& s, OptionList& o) {
    o.choice(s.echo_400, "echoed_400", {"0", "400"}, "angle in the reply to a command with angle 400", spec);
    o.choice(s.last_data_on_request, "data_on_request", {"empty", "last"},
             "samples in a device_data that is only requested", spec);
    o.choice(s.accept_anything, "invalid_settings", {"nack", "accept"},
             "values outside the documented ranges", spec);
    o.choice(s.accept_common_id, "common_set_id", {"nack", "ack"}, "answer to message 100", spec);
    o.choice(s.nack_requested_id, "nacked_id", {"request", "requested"},
             "id in the nack of a general_request: 6, or the id that was asked for", spec);
    o.words(s.ack_set_id, "set_id_reply", {{"ack", true}, {"none", false}}, "answer to message 2000", spec);
}

void describe_head(Settings& s, OptionList& o) {
    o.whole(s.forward_angle, "forward_angle", "grad", 0, 399,
            "the angle at which the head looks along the mount's x axis", spec);
    o.words(s.clockwise, "rotation", {{"clockwise", true}, {"counter-clockwise", false}},
            "direction of rising angles, seen from above", spec);
    o.choice(s.ends_twice, "turn_around", {"once", "twice"}, "pings at the end of a sector", spec);
    o.number(s.turn_time, "turn_time", "s", 0.01, 60, "time of a full turn of 400 gradians", spec);
    o.number(s.idle_off, "idle_off", "s", 0, 1e6, "idle time after which the next move homes first; 0: never",
             spec);
    o.number(
        s.ethernet_time, "ethernet_time", "s", 0, 1,
        "from the end of the range to the reply on UDP endpoints: processing and the link inside the head",
        "scans of Ethernet units in the field: 16 to 20 ms; data sheet, 9 s a turn at 2 m: 14 ms");
    o.flag(s.ring_down, "ring_down", "the transmitter's own sound in the first samples",
           "shape of two public recordings");
}

void describe(Acoustics& a, FigureList& f) {
    f.number(a.centre_frequency, "centre_frequency", "Hz", 10e3, 10e6, "where the transducer is loudest");
    f.number(a.response_width, "response_width", "Hz", 1e3, 5e6,
             "-3 dB full width of the transducer, one way");
    f.number(a.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis");
    f.degrees(a.beam_width, "beam_width", 0.1, 60, "horizontal -3 dB full width, two-way");
    f.degrees(a.fan_height, "fan_height", 0.1, 120, "vertical -3 dB full width, two-way");
    f.number(a.tvg_spreading, "tvg_spreading", "dB per decade of range", 0, 60, "time-varied gain");
    f.number(a.tvg_absorption, "tvg_absorption", "dB/m", 0, 2, "time-varied gain, one way");
    f.number(a.reference_level, "reference_level", "dB re 1 uPa", 0, 300,
             "level after time-varied gain that reads 0 at low gain");
    f.number(a.full_scale, "full_scale", "dB", 10, 120, "from 0 to 255");
    f.number(a.gain_step, "gain_step", "dB", 0, 40, "from low to normal and from normal to high gain");
    f.common(a.horizontal, a.vertical, a.receiver);
    f.number(a.receiver.bandwidth, "receiver_bandwidth", "Hz", 1e3, 1e6,
             "for noise, and for the echoes of shorter pulses; longer ones have a filter that fits them");
    f.number(a.receiver.noise_circuit, "noise_circuit", "Hz", 0, 1e6,
             "-3 dB, of the tuned circuit that noise correlates over range behind; 0: an even band");
}

/// The address to announce, 0 for none.
std::uint32_t announced(const std::string& word, const std::vector<Endpoint>& endpoints) {
    if (word == "off") return 0;
    if (word == "auto") {
        for (const Endpoint& e : endpoints)
            if (e.scheme == Endpoint::Scheme::udp_listen && e.port == found_port) return e.ip;
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

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_identity(s, o);
    describe_answers(s, o);
    describe_head(s, o);
    describe(s.acoustics, f);
}

Settings read_settings(const DeviceConfig& config) {
    Settings s = fill_settings<Settings>(config);
    Acoustics& a = s.acoustics;
    s.announced = announced(s.discovery, config.endpoints);
    s.line.bits_per_second = line_rate(config.endpoints, s.baud);
    for (const Endpoint& e : config.endpoints) s.by_ethernet.push_back(e.on_udp());
    if (!config.effects.has(Effect::tvg)) a.tvg_spreading = a.tvg_absorption = 0;
    if (!s.ring_down) a.receiver.ring_down = nullptr;
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
    shot.receiver.bandwidth = std::min(a.receiver.bandwidth, 1 / shot.pulse_length);
    return shot;
}

}  // namespace echoloop::ping360
