#include "emulator/devices/ping1d/settings.h"

#include <algorithm>
#include <cmath>

#include "emulator/devices/family/ping/link.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::ping1d {
namespace {

const char* const spec = "Ping specification notes";

Acoustics read_acoustics(const Profile& p, bool tvg) {
    Acoustics a;
    a.frequency = figure(p, "frequency");
    a.source_level = figure(p, "source_level");
    a.beam_width = deg_to_rad(figure(p, "beam_width"));
    a.aperture = axis_pattern(p, "horizontal");
    a.receiver = receiver(p);
    a.ring_down = {figure(p, "ring_down_level"), 1e3 * figure(p, "ring_down_decay")};
    a.nearest_range = figure(p, "nearest_range");
    a.reference_level = figure(p, "reference_level");
    a.full_scale = figure(p, "full_scale");
    a.tvg_spreading = tvg ? figure(p, "tvg_spreading") : 0;
    a.tvg_absorption = tvg ? figure(p, "tvg_absorption") : 0;
    return a;
}

State read_power_up(const Options& o) {
    State state;
    state.automatic = flag(o, "mode_auto");
    state.length = static_cast<std::uint32_t>(integer(o, "scan_length"));
    state.gain = static_cast<std::uint8_t>(integer(o, "gain"));
    state.interval = static_cast<std::uint16_t>(integer(o, "ping_interval"));
    state.speed_of_sound = static_cast<std::uint32_t>(std::lround(1e3 * number(o, "speed_of_sound")));
    return state;
}

}  // namespace

std::uint16_t State::transmit_duration() const {
    const double range = start + static_cast<double>(length), speed = speed_of_sound;
    return static_cast<std::uint16_t>(
        std::clamp<double>(8000 * range / speed, shortest_pulse, longest_pulse));
}

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"frequency", "Hz", "of the pulse", 10e3, 10e6},
        {"source_level", "dB re 1 uPa at 1 m", "on the axis", 100, 240},
        {"beam_width", "deg", "-3 dB full width of the cone, two-way", 0.1, 120},
        {"nearest_range", "m", "nothing closer is taken for the bottom; a longer pulse adds half its length",
         0, 10},
        {"ring_down_level", "dB re 1 uPa", "what it hears of its own pulse while it sends", -100, 300},
        {"ring_down_decay", "dB/ms", "by which that dies away afterwards", 1, 10000},
        {"tvg_spreading", "dB per decade of range", "time-varied gain", 0, 60},
        {"tvg_absorption", "dB/m", "time-varied gain, one way", 0, 2},
        {"reference_level", "dB re 1 uPa", "level after time-varied gain that reads 0 at a gain of 1", 0,
         300},
        {"full_scale", "dB", "from 0 to 255", 10, 120},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    const char* const own = "own choice; the official firmware's is not public";
    return {
        text_row("firmware", "3.28.0", "version; one host's test needs major 3 and minor 27 or more", spec),
        text_row("protocol_version", "1.0.0", "version of the message set; one host's test stops on 1.1.0",
                 spec),
        integer_row("device_id", "", 1, 0, 254, "at power-up, as source of every frame", spec),
        integer_row("device_type", "", 1, 1, 255, "in device_information and firmware_version", spec),
        integer_row("device_model", "", 1, 0, 255, "in firmware_version", spec),
        integer_row("device_revision", "", 1, 1, 255, "in device_information", spec),
        flag_row("mode_auto", true, "range and gain follow the bottom at power-up", own),
        integer_row("scan_length", "mm", 10000, shortest_length, longest_length, "range at power-up", own),
        integer_row("gain", "", 3, 0, 6, "gain setting at power-up", own),
        integer_row("ping_interval", "ms", 100, 0, 65535, "from ping to ping at power-up", own),
        number_row("speed_of_sound", "m/s", 1500, 100, 10000,
                   "by which times become distances, at power-up; the water has its own", own),
        flag_row("stream_at_start", false, "send profiles from power-up, as the open firmware does", spec),
        choice_row("nacked_id", {"request", "requested"},
                   "id in the nack of a general_request: 6, or the id that was asked for", spec),
        flag_row("ack_continuous", true, "acknowledge continuous_start and continuous_stop", spec),
        choice_row("streamed", {"as-asked", "profile"}, "message after continuous_start", spec),
        flag_row("marks_are_breaks", true, "0x55 where a frame should begin forgets half a frame", spec),
        number_row("baud", "bit/s", 0, 0, 4e6, "line rate of pty and TCP endpoints; 0: not paced", spec),
        flag_row("automatic_baud", true,
                 "a pty is as fast as its driver sets it, whatever baud says; false: another rate than baud "
                 "makes garbage",
                 spec),
        integer_row("voltage", "mV", 5000, 0, 65535, "5 V rail", "free choice"),
        integer_row("processor_temperature", "0.01 degC", 4000, 0, 65535, "told on request", "free choice"),
        integer_row("pcb_temperature", "0.01 degC", 3500, 0, 65535, "told on request", "free choice"),
    };
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.firmware = ping_device::read_version(text(o, "firmware"), "firmware");
    s.protocol = ping_device::read_version(text(o, "protocol_version"), "protocol_version");
    s.device_id = static_cast<std::uint8_t>(integer(o, "device_id"));
    s.device_model = static_cast<std::uint8_t>(integer(o, "device_model"));
    s.power_up = read_power_up(o);
    s.device_type = static_cast<std::uint8_t>(integer(o, "device_type"));
    s.device_revision = static_cast<std::uint8_t>(integer(o, "device_revision"));
    s.nack_requested_id = text(o, "nacked_id") == "requested";
    s.ack_continuous = flag(o, "ack_continuous");
    s.always_profile = text(o, "streamed") == "profile";
    s.stream_at_start = flag(o, "stream_at_start");
    s.marks_are_breaks = flag(o, "marks_are_breaks");
    s.baud = number(o, "baud");
    s.line = read_serial_rate(config);
    s.voltage = static_cast<std::uint16_t>(integer(o, "voltage"));
    s.processor_temperature = static_cast<std::uint16_t>(integer(o, "processor_temperature"));
    s.pcb_temperature = static_cast<std::uint16_t>(integer(o, "pcb_temperature"));
    s.acoustics = read_acoustics(config.profile, config.effects.has(Effect::tvg));
    return s;
}

Shot shot_from(const State& state, const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const double there_and_back = 2.0 / state.speed_of_sound;  // s per mm
    Shot shot;
    shot.bearings = {0.0};
    shot.beam_width = shot.fan_height = a.beam_width;
    shot.first_bin_time = state.start * there_and_back;
    shot.bins = state.points;
    shot.bin_interval = state.length * there_and_back / state.points;
    shot.frequency = a.frequency;
    shot.pulse_length = state.transmit_duration() * 1e-6;
    shot.source_level = a.source_level;
    shot.horizontal = shot.vertical = a.aperture;
    shot.receiver = a.receiver;
    return shot;
}

}  // namespace echoloop::ping1d
