#include "emulator/devices/imagenex-831l/profiler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "emulator/devices/imagenex-831l/echo.h"
#include "protocols/imagenex/codec.h"
#include "protocols/imagenex/pipe_ranges.h"

namespace echoloop::imagenex831l {
namespace {

using imagenex::SwitchCommand;

constexpr std::uint8_t own_id = 0;
constexpr Time moment = std::chrono::milliseconds(50);  // over which the sensor feels an acceleration

/// s for 0.3 deg: a third of a shot of a turn of 1.3 s.
constexpr double step_seconds = 3.25e-3 / 3;

}  // namespace

void Profiler::reconnected(std::size_t) {
    framer_.clear();
    current_.reset();
    waiting_.reset();
}

Actions Profiler::received(const Received& data, Time now) {
    framer_.feed(data.bytes);
    while (const auto frame = framer_.next()) {
        const auto command = imagenex::parse_switch_command(*frame);
        if (!command) continue;
        if (command->head_id != own_id) {
            ++counters_.rejected;
            continue;
        }
        ++counters_.messages;
        if (current_)
            waiting_ = *command;
        else
            transmit(*command, now);
    }
    return take_actions();
}

void Profiler::transmit(const SwitchCommand& asked, Time now) {
    current_ = asked;
    SwitchCommand command = usable(asked);
    Shot shot = shot_from(command, settings_);
    command.motion &= imagenex::motion::reverse;  // what is left of the byte means something else here
    const int travelled = scan_.move(command);
    shot.pan = std::remainder(imagenex_head::angle_of(scan_.position()), 2 * std::numbers::pi);
    shot.ping = ++shots_;
    const double beyond = step_seconds * std::max(0, travelled - command.step_size);
    const double window = 2 * imagenex::pipe_range(command.range).metres / sound_speed;
    const double all = std::max(settings_.least_time, window + settings_.processing_time) + beyond;
    shot.interval = all;  // if the host asks in time
    actions_.ping = Ping{std::move(shot), now + from_seconds(all)};
    tilt_is_new_ = asked.reply_baud == interrogate || asked.reply_baud == calibrate_tilt;
    if (tilt_is_new_) actions_.locate = {std::max(now - moment, Time{}), now};
}

Actions Profiler::located(std::span<const Located> places, Time now) {
    if (places.empty() || !current_) return take_actions();
    tilt_ = sensed(felt(places.front(), places.back()), settings_.sensors, now);
    if (current_->reply_baud == calibrate_tilt) level_ = tilt_;
    return take_actions();
}

Actions Profiler::heard(const Echogram& echogram, Time now) {
    if (!current_ || echogram.shot.ping != shots_) return take_actions();
    ++counters_.pings;
    const SwitchCommand asked = *std::exchange(current_, std::nullopt);
    const SwitchCommand command = usable(asked);
    const auto samples = amplitudes(echogram, command, settings_);
    imagenex::PipeReply reply;
    reply.kind = command.profile != 0 ? imagenex::Kind::ipx : imagenex::Kind::imx;
    reply.status = status_of(asked, settings_);
    reply.head_position = imagenex::head_position(scan_.position(), scan_.clockwise());
    reply.range_code = command.range;
    reply.profile_range = profile_word(profile_range(samples, command, settings_), command, settings_);
    add_tilt(reply);
    if (reply.kind == imagenex::Kind::imx) reply.data = echo_data(samples, settings_);
    reply.data_bytes = imagenex::Packed14(reply.data.size());
    // In one piece: a known host reads it by one call.
    actions_.send.push_back({0, imagenex::encode(imagenex::Message(std::move(reply))), {}, {}});
    if (waiting_) transmit(*std::exchange(waiting_, std::nullopt), now);
    return take_actions();
}

void Profiler::add_tilt(imagenex::PipeReply& reply) const {
    constexpr double degrees = 0.025, milligravities = 0.24414;
    const std::uint8_t flags = tilt_is_new_ ? imagenex::Signed14::is_new : std::uint8_t{0};
    const Tilt shown = tilt_ - level_;
    reply.roll = imagenex::signed14(angle(tilt_.roll) - angle(level_.roll), degrees, flags);
    reply.pitch = imagenex::signed14(angle(tilt_.pitch) - angle(level_.pitch), degrees, flags);
    reply.roll_acceleration = imagenex::signed14(1000 * shown.roll, milligravities, flags);
    reply.pitch_acceleration = imagenex::signed14(1000 * shown.pitch, milligravities, flags);
}

DeviceCounters Profiler::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes += framer_.skipped_bytes();
    return counters;
}

Actions Profiler::take_actions() { return std::exchange(actions_, {}); }

}  // namespace echoloop::imagenex831l
