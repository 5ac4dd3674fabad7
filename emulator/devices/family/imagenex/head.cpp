#include "emulator/devices/family/imagenex/head.h"

#include <algorithm>
#include <utility>

#include "emulator/devices/family/imagenex/timing.h"
#include "protocols/imagenex/codec.h"

namespace echoloop::imagenex_head {

using imagenex::SwitchCommand;

Head::Head(const Settings& settings) : settings_(settings) {}

std::vector<Port> Head::ports() const { return {{"line", Port::Kind::stream, {}, false}}; }

Actions Head::started(Time) { return take_actions(); }

Actions Head::received(const Received& data, Time now) {
    const Peer host{data.port, data.from};
    imagenex::Framer& ear = hosts_.of(host);
    ear.feed(data.bytes);
    while (const auto frame = ear.next()) {
        const auto command = imagenex::parse_switch_command(*frame);
        const Peer before = std::exchange(host_, host);
        if (command && is_for_us(*command))
            obey(*command, now);
        else if (obey_other(*frame, now))
            ++counters_.messages;
        else
            host_ = before;
    }
    return take_actions();
}

Actions Head::woken(Time now) {
    if (now >= transmit_at_) transmit(now);
    return take_actions();
}

/// Another host is at the other end: it gets no reply to what its predecessor asked.
void Head::reconnected(std::size_t port) {
    hosts_.clear(port);
    current_.reset();
    waiting_.reset();
    under_way_ = false;
    transmit_at_ = Time::max();
}

DeviceCounters Head::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes = hosts_.skipped_bytes();
    return counters;
}

bool Head::is_for_us(const SwitchCommand& command) const { return command.head_id == settings_.head_id; }

void Head::obey(const SwitchCommand& command, Time now) {
    if (settings_.strict && (command.mode & imagenex::mode::all) != imagenex::mode::all) {
        ++counters_.rejected;
        return;
    }
    ++counters_.messages;
    const bool pings = under_way_ || line_free_ > now;
    if (!pings) {
        begin(command, now);
        return;
    }
    waiting_ = command;
    if (!under_way_) transmit_at_ = std::min(transmit_at_, line_free_);
}

void Head::begin(const SwitchCommand& command, Time now) {
    current_ = command;
    waiting_.reset();
    transmit_at_ = transmit_time(usable(command), now);
    if (transmit_at_ <= now) transmit(now);
}

void Head::transmit(Time now) {
    transmit_at_ = Time::max();
    if (waiting_) {
        begin(*std::exchange(waiting_, std::nullopt), now);
        return;
    }
    if (!current_) return;
    const SwitchCommand command = usable(*current_);
    const Format format = format_of(command, settings_);
    Shot shot = plain_shot(command, format, resolution(command), settings_);
    const Time move = aim(command, shot);
    shot.ping = ++ping_;
    const std::size_t bytes = imagenex::reply_overhead + format.bytes;
    const Time answer = answer_time(command, bytes, settings_) + move;
    shot.interval = to_seconds(answer + line_time(command, bytes, settings_));  // if the host asks in time
    under_way_ = true;
    actions_.ping = Ping{std::move(shot), now + answer};
}

Actions Head::heard(const Echogram& echogram, Time now) {
    if (!under_way_ || !current_ || echogram.shot.ping != ping_) return take_actions();
    under_way_ = false;
    ++counters_.pings;
    const SwitchCommand command = usable(*current_);
    const Format format = format_of(command, settings_);
    const auto samples = amplitudes(echogram, command, settings_);
    imagenex::Reply reply;
    reply.kind = format.kind;
    reply.head_id = settings_.head_id;
    reply.status = status_of(*current_);
    reply.head_position = position_bytes();
    reply.range = command.range;
    const double range = profile_range(samples, command, settings_);
    reply.profile_range = imagenex::Packed14(range > 0 ? profile_units(range, command) : 0);
    reply.data = echo_data(samples, format, settings_);
    wire::Bytes bytes = imagenex::encode(imagenex::Message(std::move(reply)));
    const std::size_t size = bytes.size();
    send(std::move(bytes), now, command.reply_baud);
    end_of_reply(size, now);
    return take_actions();
}

/// What a head cannot do is not accepted.
std::uint8_t Head::status_of(const SwitchCommand& command) const {
    const bool accepted = usable(command) == command;
    return accepted ? settings_.status
                    : static_cast<std::uint8_t>(settings_.status & ~imagenex::status::accepted);
}

void Head::end_of_reply(std::size_t bytes, Time now) {
    const SwitchCommand command = usable(*current_);
    line_free_ = now + line_time(command, bytes, settings_);
    transmit_at_ = waiting_ ? line_free_ : next_by_itself(command, line_free_);
}

void Head::send(wire::Bytes bytes, Time when, std::uint8_t reply_baud) {
    const double rate = settings_.line_rate > 0 ? asked_rate(reply_baud, settings_) : 0;
    actions_.send.push_back({0, std::move(bytes), host_.address, when, false, rate});
}

Actions Head::take_actions() {
    actions_.wake = transmit_at_;
    return std::exchange(actions_, {});
}

}  // namespace echoloop::imagenex_head
