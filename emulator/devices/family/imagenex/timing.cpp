#include "emulator/devices/family/imagenex/timing.h"

#include <algorithm>

namespace echoloop::imagenex_head {
namespace {

double wire_seconds(std::size_t bytes, double baud) { return 10.0 * static_cast<double>(bytes) / baud; }

double usual_or(double asked) { return asked > 0 ? asked : usual_baud; }

/// Fit of the maker's table of turns, within 2.1 ms of every cell; the line at 115200 is in it.
double table_seconds(const imagenex::SwitchCommand& command, std::size_t reply_bytes, double window) {
    constexpr double profile_least = 15e-3, profile_work = 3.4e-3;
    constexpr double echo_work = 4.7e-3, long_step = 17.5e-3;
    constexpr int longest_step = 8;
    const bool held = (command.motion & imagenex::motion::hold) != 0;
    const int step = held ? 0 : std::min<int>(command.step_size, longest_step);
    if (command.profile != 0) return std::max(profile_least, window + profile_work + step * step_seconds);
    return window + echo_work + wire_seconds(reply_bytes, usual_baud) +
           (step == longest_step ? long_step : 0);
}

}  // namespace

double asked_rate(std::uint8_t reply_baud, const Settings& settings) {
    if (!settings.obey_baud) return 0;
    switch (reply_baud) {
        case 0x0B:
            return 9600;
        case 0x03:
            return 14400;
        case 0x0C:
            return 19200;
        case 0x04:
            return 28800;
        case 0x02:
            return 38400;
        case 0x05:
            return 57600;
        case 0x06:
            return 115200;
        default:
            return 0;
    }
}

double shot_seconds(const imagenex::SwitchCommand& command, std::size_t reply_bytes,
                    const Settings& settings) {
    const double window = 2.0 * std::max<int>(command.range, 1) / sound_speed;
    const double wire = wire_seconds(reply_bytes, usual_or(asked_rate(command.reply_baud, settings)));
    if (settings.timing == ShotTiming::none) return window + wire;
    if (settings.timing == ShotTiming::fixed) return std::max(settings.fixed_time, window + wire);
    return table_seconds(command, reply_bytes, window) + wire - wire_seconds(reply_bytes, usual_baud);
}

Time line_time(const imagenex::SwitchCommand& command, std::size_t bytes, const Settings& settings) {
    if (settings.line_rate <= 0) return {};
    const double asked = asked_rate(command.reply_baud, settings);
    return from_seconds(wire_seconds(bytes, asked > 0 ? asked : settings.line_rate));
}

Time answer_time(const imagenex::SwitchCommand& command, std::size_t reply_bytes, const Settings& settings) {
    const double window = 2.0 * std::max<int>(command.range, 1) / sound_speed;
    const Time delay = std::chrono::milliseconds(2 * command.switch_delay);
    const Time all = from_seconds(shot_seconds(command, reply_bytes, settings)) -
                     line_time(command, reply_bytes, settings);
    return std::max(all, from_seconds(window)) + delay;
}

}  // namespace echoloop::imagenex_head
