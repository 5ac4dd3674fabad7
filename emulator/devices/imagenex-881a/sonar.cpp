#include "emulator/devices/imagenex-881a/sonar.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "emulator/devices/family/imagenex/timing.h"
#include "protocols/imagenex/codec.h"

namespace echoloop::imagenex881a {

using imagenex::SwitchCommand;

double frequency_of(const SwitchCommand& command) { return 175e3 + 5e3 * command.frequency; }

/// The same aperture has wider beams at lower frequencies.
void set_sound(const SwitchCommand& command, double design_frequency, Shot& shot) {
    shot.frequency = frequency_of(command);
    shot.pulse_length = command.pulse_length * 10e-6;
    const double wider = design_frequency / shot.frequency;
    shot.beam_width *= wider;
    shot.fan_height = std::min(shot.fan_height * wider, 2 * std::numbers::pi / 3);
}

Sonar::Sonar(const Settings& settings)
    : Head(settings.head),
      scan_(settings.start_position, settings.clip),
      azimuth_drive_(settings.azimuth_drive) {}

SwitchCommand Sonar::usable(SwitchCommand c) const {
    const auto limit = [](std::uint8_t& value, int least, int most) {
        value = static_cast<std::uint8_t>(std::clamp<int>(value, least, most));
    };
    limit(c.range, 1, 200);
    limit(c.start_gain, 0, 40);
    limit(c.logf, 0, 3);
    limit(c.train_angle, 0, 120);
    limit(c.sector_width, 0, 120);
    limit(c.step_size, 0, 8);
    if (c.step_size > 4 && c.step_size < 8) c.step_size = 4;
    limit(c.pulse_length, 1, 100);
    limit(c.minimum_profile_range, 0, 250);
    limit(c.frequency, 0, 200);
    return c;
}

double Sonar::resolution(const SwitchCommand& command) const { return command.range < 5 ? 0.002 : 0.01; }

Time Sonar::aim(const SwitchCommand& command, Shot& shot) {
    const int travelled = scan_.move(command);
    shot.pan = std::remainder(angle_of(scan_.position()) + angle_of(azimuth_), 2 * std::numbers::pi);
    set_sound(command, settings().acoustics.frequency, shot);
    const int beyond = std::max(0, travelled - command.step_size);
    return from_seconds(beyond * imagenex_head::step_seconds);
}

imagenex::Packed14 Sonar::position_bytes() const {
    return imagenex::head_position(scan_.position(), scan_.clockwise());
}

std::uint64_t Sonar::profile_units(double range, const SwitchCommand& command) const {
    return static_cast<std::uint64_t>(std::max(1L, std::lround(range / resolution(command))));
}

/// The drive turns the head about the same axis, and answers when it has arrived.
bool Sonar::obey_other(const wire::Bytes& frame, Time now) {
    const auto message = imagenex::parse(frame);
    const auto* command = message ? std::get_if<imagenex::AzimuthCommand>(&*message) : nullptr;
    if (!azimuth_drive_ || command == nullptr) return false;
    const int before = azimuth_;
    const bool hold = (command->motion & imagenex::motion::hold) != 0;
    if (command->calibrate == 1)
        azimuth_ = ahead;
    else if (!hold)
        azimuth_ = static_cast<int>(command->angle % circle);
    imagenex::AzimuthReply reply;
    reply.status = imagenex::status::accepted;
    reply.azimuth = imagenex::Packed14(static_cast<std::uint64_t>(azimuth_));
    const Time delay = std::chrono::milliseconds(2 * command->switch_delay);
    const double travel = std::abs(azimuth_ - before) * imagenex_head::step_seconds;
    send(imagenex::encode(imagenex::Message(reply)), now + delay + from_seconds(travel), command->reply_baud);
    return true;
}

}  // namespace echoloop::imagenex881a
