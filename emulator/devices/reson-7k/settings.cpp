#include "emulator/devices/reson-7k/settings.h"

#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::reson7k_device {
namespace {

const char* const spec = "Reson 7k specification notes";
const char* const choice = "own choice";

Acoustics read_acoustics(const Profile& p) {
    Acoustics a;
    a.frequency = figure(p, "frequency");
    a.least_frequency = figure(p, "least_frequency");
    a.most_frequency = figure(p, "most_frequency");
    a.sample_rate = figure(p, "sample_rate");
    a.receive_beam_width = deg_to_rad(figure(p, "receive_beam_width"));
    a.transmit_beam_width = deg_to_rad(figure(p, "transmit_beam_width"));
    a.receive_fan = deg_to_rad(figure(p, "receive_fan"));
    a.transmit_sector = deg_to_rad(figure(p, "transmit_sector"));
    a.least_range = figure(p, "least_range");
    a.most_range = figure(p, "most_range");
    a.least_power = figure(p, "least_power");
    a.most_power = figure(p, "most_power");
    a.least_pulse = figure(p, "least_pulse");
    a.most_pulse = figure(p, "most_pulse");
    a.most_gain = figure(p, "most_gain");
    a.most_rate = figure(p, "most_rate");
    a.ping_pause = figure(p, "ping_pause");
    a.processing = figure(p, "processing_time");
    a.spreading = figure(p, "tvg_spreading");
    a.absorption = figure(p, "tvg_absorption");
    a.amplitude_reference = figure(p, "amplitude_reference");
    a.detection_margin = figure(p, "detection_margin");
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    a.receiver.bandwidth = figure(p, "receiver_bandwidth");
    return a;
}

std::vector<FigureRow> head_rows() {
    return {
        {"frequency", "Hz", "centre frequency at power-up, at which beam widths are given", 10e3, 1e6},
        {"least_frequency", "Hz", "that can be set", 10e3, 1e6},
        {"most_frequency", "Hz", "that can be set", 10e3, 1e6},
        {"sample_rate", "Hz", "of the samples that detections count", 1e3, 1e6},
        {"receive_beam_width", "deg", "of one beam across the track, -3 dB", 0.1, 10},
        {"transmit_beam_width", "deg", "along the track, -3 dB", 0.1, 30},
        {"receive_fan", "deg", "of one receive beam along the track, -3 dB; reported only", 0.1, 90},
        {"transmit_sector", "deg", "across the track, -3 dB; reported only", 10, 180},
        {"receiver_bandwidth", "Hz", "for noise and the shape of echoes", 1e3, 1e6},
        {"least_range", "m", "that can be set", 0.5, 100},
        {"most_range", "m", "that can be set", 10, 2000},
        {"least_power", "dB re 1 uPa at 1 m", "that can be set", 100, 240},
        {"most_power", "dB re 1 uPa at 1 m", "that can be set", 100, 240},
        {"least_pulse", "s", "that can be set", 1e-6, 1e-2},
        {"most_pulse", "s", "that can be set", 1e-6, 1e-2},
        {"most_gain", "dB", "that can be set", 0, 120},
        {"most_rate", "Hz", "that can be set", 1, 100},
    };
}

std::vector<FigureRow> level_rows() {
    return {
        {"ping_pause", "s", "from the end of the range to the next ping", 0, 1},
        {"processing_time", "s", "from the last echo to the records", 0, 1},
        {"tvg_spreading", "dB per decade of range", "time-varied gain", 0, 60},
        {"tvg_absorption", "dB/km", "time-varied gain, one way", 0, 500},
        {"amplitude_reference", "dB re 1 uPa", "after gain and time-varied gain: reads full scale", 0, 400},
        {"detection_margin", "dB", "above the noise; an echo below is no bottom", 0, 60},
    };
}

Controls read_start(const Options& o) {
    Controls c;
    c.range = number(o, "range");
    c.max_rate = number(o, "max_ping_rate");
    c.power = number(o, "power");
    c.pulse = number(o, "pulse");
    c.gain = number(o, "gain");
    c.pinging = flag(o, "pinging");
    return c;
}

}  // namespace

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows = head_rows();
    for (auto more : {level_rows(), common_figures()})
        std::move(more.begin(), more.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    return {
        integer_row("device", "", 7125, 1, 65535, "device id in the records; commands must name it", spec),
        integer_row("serial", "", 1001, 0, 4294967295.0, "of the sonar", choice),
        integer_row("beams", "", 256, 16, 512, "of the swath, in equal steps of angle", choice),
        number_row("swath", "deg", 140, 10, 160, "from the first to the last beam", choice),
        number_row("range", "m", 50, 1, 500, "1003 at power-up", choice),
        number_row("max_ping_rate", "Hz", 50, 0.1, 50, "1004 at power-up", choice),
        number_row("power", "dB re 1 uPa at 1 m", 210, 170, 220, "1005 at power-up", choice),
        number_row("pulse", "s", 60e-6, 30e-6, 300e-6, "1006 at power-up", choice),
        number_row("gain", "dB", 30, 0, 83, "1008 at power-up", choice),
        flag_row("pinging", true, "pings from power-up on, as after 1100", choice),
        choice_row("command_device", {"own", "any"},
                   "device id that commands must carry; subscriptions and requests may name 7000 too", spec),
        choice_row("end_subscriptions", {"1052", "1053"},
                   "the command that ends all subscriptions: the command table has 1052, the introduction "
                   "1053 (here: "
                   "without an address)",
                   spec),
        number_row(
            "packet_gap", "s", 0.3e-3, 0, 0.1,
            "pause between the datagrams of a ping, less where the next ping comes before they are out",
            "receivers with default buffers lose faster bursts"),
    };
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.device = static_cast<std::uint32_t>(integer(o, "device"));
    s.serial = static_cast<std::uint64_t>(integer(o, "serial"));
    s.beams = static_cast<std::size_t>(integer(o, "beams"));
    s.swath = deg_to_rad(number(o, "swath"));
    s.start = read_start(o);
    s.acoustics = read_acoustics(config.profile);
    s.start.frequency = s.acoustics.frequency;
    s.start.absorption = s.acoustics.absorption;
    s.start.spreading = s.acoustics.spreading;
    s.start.sound_speed = config.sound_speed;
    s.any_device = text(o, "command_device") == "any";
    s.ends_by_third_party = text(o, "end_subscriptions") == "1053";
    s.packet_gap = number(o, "packet_gap");
    s.tvg = config.effects.has(Effect::tvg);
    s.pulse = config.effects.has(Effect::pulse);
    s.unix_start = config.unix_start;
    return s;
}

}  // namespace echoloop::reson7k_device
