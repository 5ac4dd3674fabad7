#include "emulator/devices/aris/settings.h"

#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::aris_device {
namespace {

const char* const spec = "ARIS specification notes";

Carrier read_carrier(const Profile& p, const std::string& which) {
    Carrier c;
    c.frequency = figure(p, which + "_frequency");
    c.beam_width = deg_to_rad(figure(p, which + "_beam_width"));
    c.source_level = figure(p, which + "_source_level");
    c.directivity_index = figure(p, which == "low" ? "directivity_index" : "high_directivity_index");
    c.tvg_absorption = figure(p, which + "_tvg_absorption");
    c.pulse_limit = figure(p, which + "_pulse_limit");
    return c;
}

Acoustics read_acoustics(const Profile& p) {
    Acoustics a;
    a.low = read_carrier(p, "low");
    a.high = read_carrier(p, "high");
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    a.fan_height = deg_to_rad(figure(p, "fan_height"));
    a.energy_limit = figure(p, "energy_limit");
    a.low_voltage_loss = figure(p, "low_voltage_loss");
    a.floor_level = figure(p, "floor_level");
    a.tvg_spreading = figure(p, "tvg_spreading");
    a.tvg_limit = figure(p, "tvg_limit");
    a.processing = figure(p, "processing_time");
    return a;
}

std::vector<FigureRow> carrier_rows(const std::string& which) {
    return {
        {which + "_frequency", "Hz", "of the carrier", 100e3, 10e6},
        {which + "_beam_width", "deg", "of one beam, -3 dB full width", 0.05, 10},
        {which + "_source_level", "dB re 1 uPa at 1 m", "on the axis, at 150 V", 100, 240},
        {which + "_tvg_absorption", "dB/m", "time-varied gain, one way", 0, 10},
        {which + "_pulse_limit", "us", "the longest pulse", 5, 80},
    };
}

std::uint32_t read_controller(const std::string& text) {
    if (text.empty()) return 0;
    try {
        return read_ipv4(text);
    } catch (const std::invalid_argument&) {
        throw std::invalid_argument("option controller: '" + text +
                                    "' is no IPv4 address; write e.g. 192.168.1.5");
    }
}

}  // namespace

std::uint32_t read_ipv4(const std::string& text) { return parse_endpoint("udp-listen://" + text + ":0").ip; }

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"fan_height", "deg", "vertical, -3 dB full width", 0.5, 60},
        {"energy_limit", "us/s", "the most time of transmission: pulse length times frame rate", 1, 10000},
        {"low_voltage_loss", "dB", "of the source level without 150 V", 0, 60},
        {"high_directivity_index", "dB",
         "of the receiver at the high frequency; directivity_index is the low one", 0, 60},
        {"floor_level", "dB re 1 uPa", "reads 0 at 0 dB gain within a metre; 80 dB more read 255", 0, 300},
        {"tvg_spreading", "dB per decade of range", "time-varied gain", 0, 60},
        {"tvg_limit", "dB", "the most time-varied gain", 0, 100},
        {"processing_time", "s", "from the last sample to the first part of the frame", 0, 1},
    };
    for (auto more : {carrier_rows("low"), carrier_rows("high"), common_figures()})
        std::move(more.begin(), more.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    return {
        integer_row("serial", "", 1001, 1, 4294967295.0, "serial number, in beacon and frames", "own choice"),
        number_row("temperature", "degC", 10, -4, 40,
                   "of the water at the sonar's own sensor; gives its speed of sound", "own choice"),
        number_row("beacon_period", "s", 1, 0.05, 60, "between beacons", spec),
        number_row("silence_limit", "s", 10, 0, 3600,
                   "a controller that says nothing for so long has gone; 0: never",
                   "own choice: the notes say that the sonar closes silent connections, not when"),
        integer_row("datagram", "B", 1472, 900, 1500, "the longest part of a frame",
                    "ARIS specification notes: at most 1500; 1472 fit into an Ethernet frame"),
        number_row("part_delay", "us", 300, 0, 10000, "between parts, unless the controller sets it", spec),
        text_row("controller", "",
                 "IPv4 address for frames where the controller names none; overrides the controller's own",
                 "own choice: empty, so that the controller's own is taken"),
        choice_row("sample_order", {"device", "reordered"},
                   "channels of a ping side by side, or all beams of a range", spec),
        choice_row("pulse_unit", {"us", "cycles"}, "of the pulse width in the settings",
                   "aris-integration-sdk: commands, tables and hosts say us; one comment in the notes' "
                   "pseudo-code says cycles of the carrier"),
        choice_row("link", {"ethernet", "homeplug"}, "in the beacon", "own choice"),
        flag_row("voyager", false, "says in beacon and frames that it is a Voyager",
                 "own choice: an Explorer"),
    };
}

Settings read_settings(const DeviceConfig& config, const Variant& variant) {
    const Options& o = config.options;
    Settings s;
    s.variant = variant;
    s.serial = static_cast<std::uint32_t>(integer(o, "serial"));
    s.temperature = number(o, "temperature");
    s.beacon_period = number(o, "beacon_period");
    s.silence_limit = number(o, "silence_limit");
    s.datagram = static_cast<std::size_t>(integer(o, "datagram"));
    s.part_delay = number(o, "part_delay") * 1e-6;
    s.controller = read_controller(text(o, "controller"));
    s.reordered = text(o, "sample_order") == "reordered";
    s.pulse_in_cycles = text(o, "pulse_unit") == "cycles";
    s.ethernet = text(o, "link") == "ethernet";
    s.voyager = flag(o, "voyager");
    s.tvg = config.effects.has(Effect::tvg);
    s.unix_start = config.unix_start;
    s.acoustics = read_acoustics(config.profile);
    return s;
}

}  // namespace echoloop::aris_device
