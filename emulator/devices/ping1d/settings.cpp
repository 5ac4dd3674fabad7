#include "emulator/devices/ping1d/settings.h"

#include <algorithm>
#include <cmath>

#include "emulator/devices/family/ping/link.h"

namespace echoloop::ping1d {
namespace {

const char* const spec = "Ping specification notes";

void describe_identity(Settings& s, OptionList& o) {
    ping_device::version(s.firmware, o, "firmware",
                         "version; one host's test needs major 3 and minor 27 or more. Before 3.27, but for "
                         "0.0.0, voltage and processor temperature are without content",
                         spec);
    ping_device::version(s.protocol, o, "protocol_version",
                         "version of the message set; one host's test stops on 1.1.0", spec);
    o.whole(s.device_id, "device_id", "", 0, 254, "at power-up, as source of every frame", spec);
    o.whole(s.device_type, "device_type", "", 1, 255, "in device_information and firmware_version", spec);
    o.whole(s.device_model, "device_model", "", 0, 255, "in firmware_version", spec);
    o.whole(s.device_revision, "device_revision", "", 1, 255, "in device_information", spec);
}

void describe_power_up(State& s, OptionList& o) {
    const char* const own = "own choice; the official firmware's is not public";
    o.flag(s.automatic, "mode_auto", "range and gain follow the bottom at power-up", own);
    o.whole(s.length, "scan_length", "mm", shortest_length, longest_length, "range at power-up", own);
    o.whole(s.gain, "gain", "", 0, 6, "gain setting at power-up", own);
    o.whole(s.interval, "ping_interval", "ms", 0, 65535, "from ping to ping at power-up", own);
    double speed_of_sound = s.speed_of_sound / 1e3;
    o.number(speed_of_sound, "speed_of_sound", "m/s", 100, 10000,
             "that it assumes to turn times into distances, at power-up; the water has its own", own);
    s.speed_of_sound = static_cast<std::uint32_t>(std::lround(1e3 * speed_of_sound));
}

void describe_answers(Settings& s, OptionList& o) {
    o.flag(s.stream_at_start, "stream_at_start", "send profiles from power-up, as the open firmware does",
           spec);
    o.number(
        s.tracking_lag, "tracking_lag", "s", 0, 10,
        "time constant by which the distance follows the bottom; after a jump it waits twice as long. 0: "
        "every ping speaks for itself",
        "up to 0.8 s until a real one has followed were reported; the law is our own choice");
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the end of the range to the message",
             "not published");
    o.choice(s.nack_requested_id, "nacked_id", {"request", "requested"},
             "id in the nack of a general_request: 6, or the id that was asked for", spec);
    o.flag(s.ack_continuous, "ack_continuous", "acknowledge continuous_start and continuous_stop", spec);
    o.choice(s.always_profile, "streamed", {"as-asked", "profile"}, "message after continuous_start", spec);
    o.flag(s.marks_are_breaks, "marks_are_breaks", "0x55 where a frame should begin discards a partial frame",
           spec);
    describe(s.baud, s.line, o);
    o.whole(s.voltage, "voltage", "mV", 0, 65535, "5 V rail", "free choice");
    o.whole(s.processor_temperature, "processor_temperature", "0.01 degC", 0, 65535, "reported on request",
            "free choice");
    o.whole(s.pcb_temperature, "pcb_temperature", "0.01 degC", 0, 65535, "reported on request",
            "free choice");
}

void describe_profile(Acoustics& a, FigureList& f) {
    f.number(a.frequency, "frequency", "Hz", 10e3, 10e6, "of the pulse");
    f.number(a.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis");
    f.degrees(a.beam_width, "beam_width", 0.1, 120, "-3 dB full width of the cone, two-way");
    f.number(a.nearest_range, "nearest_range", "m", 0, 10,
             "nothing closer is taken for the bottom; a longer pulse adds half its length");
    f.number(a.tvg_spreading, "tvg_spreading", "dB per decade of range", 0, 60, "time-varied gain");
    f.number(a.tvg_absorption, "tvg_absorption", "dB/m", 0, 2, "time-varied gain, one way");
    f.number(a.reference_level, "reference_level", "dB re 1 uPa", 0, 300,
             "level after time-varied gain that reads 0 at a gain of 1");
    f.number(a.full_scale, "full_scale", "dB", 10, 120, "from 0 to 255");
    AxisPattern vertical;  // as the horizontal one: the beam is round
    f.common(a.aperture, vertical, a.receiver);
}

}  // namespace

bool is_old(const Settings& s) {
    const std::array<std::uint8_t, 3> open{0, 0, 0}, first{3, 27, 0};
    return s.firmware != open && s.firmware < first;
}

std::uint16_t State::transmit_duration() const {
    const double range = start + static_cast<double>(length), speed = speed_of_sound;
    return static_cast<std::uint16_t>(
        std::clamp<double>(8000 * range / speed, shortest_pulse, longest_pulse));
}

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_identity(s, o);
    describe_power_up(s.power_up, o);
    describe_answers(s, o);
    describe_profile(s.acoustics, f);
}

Settings read_settings(const DeviceConfig& config) {
    Settings s = fill_settings<Settings>(config);
    s.line.bits_per_second = line_rate(config.endpoints, s.baud);
    if (!config.effects.has(Effect::tvg)) s.acoustics.tvg_spreading = s.acoustics.tvg_absorption = 0;
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
