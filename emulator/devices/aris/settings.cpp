#include "emulator/devices/aris/settings.h"

#include <stdexcept>

#include "emulator/contract/endpoint.h"

namespace echoloop::aris_device {
namespace {

const char* const spec = "ARIS specification notes";
const char* const own = "own choice";

std::uint32_t read_controller(const std::string& text) {
    if (text.empty()) return 0;
    try {
        return read_ipv4(text);
    } catch (const std::invalid_argument&) {
        throw std::invalid_argument("option controller: '" + text +
                                    "' is no IPv4 address; write e.g. 192.168.1.5");
    }
}

void describe_words(Settings& s, OptionList& o) {
    o.whole(s.serial, "serial", "", 1, 4294967295.0, "serial number, in beacon and frames", own);
    o.number(s.temperature, "temperature", "degC", -4, 40,
             "of the water at the sonar's own sensor; gives its speed of sound", own);
    o.number(s.beacon_period, "beacon_period", "s", 0.05, 60, "between beacons", spec);
    o.number(s.silence_limit, "silence_limit", "s", 0, 3600,
             "a controller that is silent for this long is disconnected; 0: never",
             "own choice: the notes say that the sonar closes silent connections, not when");
}

void describe_frames(Settings& s, OptionList& o) {
    o.whole(s.datagram, "datagram", "B", 900, 1500, "the longest part of a frame",
            "ARIS specification notes: at most 1500; 1472 fit into an Ethernet frame");
    double microseconds = 300;
    o.number(microseconds, "part_delay", "us", 0, 10000, "pause between parts, unless the controller sets it",
             spec);
    s.part_delay = microseconds * 1e-6;
    std::string controller;
    o.text(controller, "controller",
           "IPv4 address that frames go to, instead of the controller's own, if the controller names none",
           "own choice: empty, so that the controller's own is taken");
    s.controller = read_controller(controller);
    o.choice(s.reordered, "sample_order", {"device", "reordered"},
             "by ping, then range, then channel; or range after range with all beams", spec);
    o.choice(s.pulse_in_cycles, "pulse_unit", {"us", "cycles"}, "of the pulse width in the settings",
             "aris-integration-sdk: commands, tables and hosts say us; one comment in the notes' "
             "pseudo-code says cycles of the carrier");
    o.words(s.ethernet, "link", {{"ethernet", true}, {"homeplug", false}}, "in the beacon", own);
    o.flag(s.voyager, "voyager", "says in beacon and frames that it is a Voyager", "own choice: an Explorer");
    o.number(s.processing_time, "processing_time", "s", 0, 1,
             "from the last sample to the first part of the frame",
             "own choice: short of the pause between frames at 15 Hz");
}

void describe_carrier(Carrier& c, const std::string& which, FigureList& f) {
    f.number(c.frequency, which + "_frequency", "Hz", 100e3, 10e6, "of the carrier");
    f.degrees(c.beam_width, which + "_beam_width", 0.05, 10, "of one beam, -3 dB full width");
    f.number(c.source_level, which + "_source_level", "dB re 1 uPa at 1 m", 100, 240,
             "on the axis, at 150 V");
    f.number(c.tvg_absorption, which + "_tvg_absorption", "dB/m", 0, 10, "time-varied gain, one way");
    f.number(c.pulse_limit, which + "_pulse_limit", "us", 5, 80, "the longest pulse");
}

void describe_profile(Acoustics& a, std::uint32_t serial, FigureList& f) {
    f.degrees(a.fan_height, "fan_height", 0.5, 60, "vertical, -3 dB full width");
    f.number(a.energy_limit, "energy_limit", "us/s", 1, 10000,
             "the most time of transmission: pulse length times frame rate");
    f.number(a.low_voltage_loss, "low_voltage_loss", "dB", 0, 60, "of the source level without 150 V");
    f.number(a.high.directivity_index, "high_directivity_index", "dB", 0, 60,
             "of the receiver at the high frequency; directivity_index is the low one");
    f.number(a.floor_level, "floor_level", "dB re 1 uPa", 0, 300,
             "reads 0 at 0 dB gain within a metre; 80 dB more read 255");
    f.number(a.tvg_spreading, "tvg_spreading", "dB per decade of range", 0, 60, "time-varied gain");
    f.number(a.tvg_limit, "tvg_limit", "dB", 0, 100, "the most time-varied gain");
    describe_carrier(a.low, "low", f);
    describe_carrier(a.high, "high", f);
    f.common(a.horizontal, a.vertical, a.receiver);
    f.stave_errors(a.errors, std::to_string(serial));
    a.low.directivity_index = a.receiver.directivity_index;
}

}  // namespace

std::uint32_t read_ipv4(const std::string& text) { return parse_endpoint("udp-listen://" + text + ":0").ip; }

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_words(s, o);
    describe_frames(s, o);
    describe_profile(s.acoustics, s.serial, f);
}

Settings read_settings(const DeviceConfig& config, const Variant& variant) {
    auto s = fill_settings<Settings>(config);
    s.variant = variant;
    s.tvg = config.effects.has(Effect::tvg);
    s.unix_start = config.unix_start;
    return s;
}

}  // namespace echoloop::aris_device
