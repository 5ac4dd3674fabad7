#include "emulator/devices/imagenex-831l/settings.h"

#include <algorithm>
#include <cmath>

#include "protocols/imagenex/pipe_ranges.h"

namespace echoloop::imagenex831l {
namespace {

const char* const spec = "Imagenex specification notes";
const char* const sheet = "sheet 445-061: a turn of 360 deg takes 1.3 s at ranges up to 1 m";

/// Byte 25 is `middle` at the frequency of the profile.
constexpr std::uint8_t lowest = 80, middle = 100, highest = 120;
constexpr double frequency_step = 5e3;  // Hz

/// Of angles and sectors there are five.
std::uint8_t quarter(std::uint8_t three_degrees) {
    return static_cast<std::uint8_t>(std::min(three_degrees / 30, 4) * 30);
}

void describe(Acoustics& a, FigureList& f) {
    f.number(a.frequency, "frequency", "Hz", 10e3, 10e6, "at which the width is given");
    f.number(a.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis");
    f.degrees(a.beam_width, "beam_width", 0.1, 90, "-3 dB full width of the cone, two-way");
    f.number(a.full_scale_level, "full_scale_level", "dB re 1 uPa", 0, 300,
             "of an echo at 1 m that reads full scale where all gains are 0 dB");
    f.number(a.nearest_range, "nearest_range", "m", 0, 1, "echoes from nearer are no profile range");
    f.common(a.horizontal, a.vertical, a.receiver);
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    o.choice(
        s.reverse_status, "status_bits", {"accepted_7", "accepted_0"},
        "order of the bits of byte 4: accepted in bit 7 and errors from bit 0 up, or the other way round",
        spec);
    o.choice(s.unit, "profile_unit", {"half_millimetres", "centimetres"}, "of the profile range", spec);
    o.choice(s.subtract_delay, "filter_delay", {"none", "subtracted"},
             "subtracted: the profile range lacks the 16 to 30 mm that one public reader adds to it", spec);
    o.words(s.reverse_bit, "reverse_bit",
            {{"once", imagenex_head::ReverseBit::once}, {"direction", imagenex_head::ReverseBit::direction}},
            "bit 6 of byte 5: the head turns round where it comes up, or runs backwards while it is set",
            "a public driver, which sets it in one command only");
    o.choice(s.clip, "sector_edge", {"before", "clip"},
             "the head reverses before it would pass a sector's edge, or shortens its last step to end there",
             spec);
    double start_angle = 0;  // deg
    o.number(start_angle, "start_angle", "deg", -180, 179.7, "where the head points at power-up",
             "own choice");
    s.start_position =
        (static_cast<int>(std::lround(start_angle / 0.3)) + imagenex_head::ahead) % imagenex_head::circle;
    o.words(s.ceiling, "echo_ceiling", {{"127", 127}, {"255", 255}}, "greatest value of the echo data", spec);
    double threshold = 50;
    o.number(threshold, "profile_threshold", "%", 1, 100,
             "of the scale; the first echo above it is the profile range",
             "own choice: as the imagenex-852, of which there are recordings");
    s.profile_threshold = threshold / 100;
    o.number(s.least_time, "least_time", "s", 0, 1, "from a command to its reply at the shortest ranges",
             sheet);
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the last echo to the reply", sheet);
    describe(s.acoustics, f);
}

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    s.acoustics.tvg = config.effects.has(Effect::tvg);
    return s;
}

imagenex::SwitchCommand usable(imagenex::SwitchCommand c) {
    constexpr std::uint8_t loudest = 40, longest_pulse = 100, farthest_minimum = 250, step = 3;
    c.range = imagenex::pipe_range(c.range).code;
    c.motion &= imagenex::motion::reverse | imagenex::motion::start_of_pulse;
    c.start_gain = std::min(c.start_gain, loudest);
    c.train_angle = quarter(c.train_angle);
    c.sector_width = quarter(c.sector_width);
    c.step_size = c.step_size >= step ? step : std::uint8_t{0};
    c.pulse_length = std::clamp<std::uint8_t>(c.pulse_length, 1, longest_pulse);
    c.minimum_profile_range = std::min(c.minimum_profile_range, farthest_minimum);
    c.frequency = std::clamp(c.frequency, lowest, highest);
    return c;
}

std::uint8_t status_of(const imagenex::SwitchCommand& command, const Settings& settings) {
    namespace bits = imagenex::pipe_status;
    const imagenex::SwitchCommand done = usable(command);
    unsigned status = done == command ? bits::accepted : 0U;
    if (done.range != command.range) status |= bits::range_error;
    if (done.frequency != command.frequency) status |= bits::frequency_error;
    if (!settings.reverse_status) return static_cast<std::uint8_t>(status);
    unsigned reversed = 0;
    for (unsigned bit = 0; bit < 8; ++bit) reversed |= (status >> bit & 1U) << (7 - bit);
    return static_cast<std::uint8_t>(reversed);
}

Shot shot_from(const imagenex::SwitchCommand& command, const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const double range = imagenex::pipe_range(command.range).metres;
    Shot shot;
    shot.bearings = {0.0};
    shot.frequency = a.frequency + frequency_step * (command.frequency - middle);
    shot.beam_width = shot.fan_height = a.beam_width * a.frequency / shot.frequency;
    shot.bins = points * static_cast<std::size_t>(std::lround(range / resolution / points));
    shot.bin_interval = 2 * range / sound_speed / static_cast<double>(shot.bins);
    shot.pulse_length = command.pulse_length * 1e-6;
    shot.source_level = a.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    return shot;
}

}  // namespace echoloop::imagenex831l
