#include "emulator/devices/imagenex-852/sounder.h"

#include <algorithm>
#include <cmath>

namespace echoloop::imagenex852 {
namespace {

using imagenex::SwitchCommand;

constexpr Time longest_wait = std::chrono::milliseconds(100);  // for a manual trigger
constexpr std::uint8_t trigger_available = 4;                  // status

}  // namespace

Sounder::Sounder(const Settings& settings)
    : Head(settings.head), position_bytes_(settings.position_bytes), trigger_rate_(settings.trigger_rate) {}

SwitchCommand Sounder::usable(SwitchCommand c) const {
    const auto limit = [](std::uint8_t& value, int least, int most) {
        value = static_cast<std::uint8_t>(std::clamp<int>(value, least, most));
    };
    limit(c.range, 1, 50);
    limit(c.start_gain, 0, 40);
    limit(c.pulse_length, 1, 255);
    limit(c.minimum_profile_range, 0, 250);
    c.logf = 0;
    c.step_size = 0;  // a motor would take time
    if (c.data_bits != 0) c.data_bits = 8;
    return c;
}

double Sounder::resolution(const SwitchCommand&) const { return range_resolution; }

Time Sounder::aim(const SwitchCommand& command, Shot& shot) {
    shot.pulse_length = command.pulse_length * 1e-6;
    return {};
}

std::uint64_t Sounder::profile_units(double range, const SwitchCommand&) const {
    constexpr std::uint64_t centimetres = 2;
    return centimetres * static_cast<std::uint64_t>(std::max(1L, std::lround(range / range_resolution)));
}

bool Sounder::is_triggered(const SwitchCommand& command) const {
    return trigger_rate_ > 0 && (command.trigger & imagenex::trigger::enable) != 0;
}

bool Sounder::is_automatic(const SwitchCommand& command) const {
    const bool available = (settings().status & trigger_available) != 0;
    return is_triggered(command) && available && (command.trigger & imagenex::trigger::automatic) != 0;
}

Time Sounder::next_pulse(Time now) const {
    return from_seconds((std::floor(to_seconds(now) * trigger_rate_ + 1e-9) + 1) / trigger_rate_);
}

Time Sounder::transmit_time(const SwitchCommand& command, Time now) {
    if (!is_triggered(command)) return now;
    return is_automatic(command) ? next_pulse(now) : std::min(next_pulse(now), now + longest_wait);
}

Time Sounder::next_by_itself(const SwitchCommand& command, Time now) {
    return is_automatic(command) ? next_pulse(now) : Time::max();
}

}  // namespace echoloop::imagenex852
