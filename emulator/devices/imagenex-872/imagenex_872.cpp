#include "emulator/devices/imagenex-872/imagenex_872.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocols/imagenex/codec.h"

namespace echoloop::imagenex872 {
namespace {

constexpr std::size_t port_side = 0, starboard_side = 1;
constexpr std::uint8_t port_packet = 0, starboard_packet = 2;  // byte 18 of a command

/// Counts of a side. A level is in dB; the gains lift it, balance with the range. Own choice: no scale of an
/// 872 is public, and a screen's grey follows decibels.
std::vector<std::uint8_t> counts(const Echogram& echogram, std::size_t side,
                                 const imagenex::SwitchCommand& command, const Settings& settings) {
    constexpr double span = 60;  // dB from nothing to full scale
    constexpr double decibels_a_percent = 0.6;
    const double gain = decibels_a_percent * command.start_gain, balance = command.absorption;
    const double bin = range_of(command) / points;
    std::vector<std::uint8_t> out;
    for (std::size_t i = 0; i < points; ++i) {
        const float power = echogram.beam(side)[i];
        double share = 0;
        if (echogram.rule == EchoRule::cerqueira2016) {
            share = double(power);
        } else if (power > 0) {
            const double range = std::max(1.0, bin * (static_cast<double>(i) + 0.5));
            share = 1 + (double(level_db(power)) + gain + balance * std::log10(range) -
                         settings.acoustics.full_scale_level) /
                            span;
        }
        out.push_back(static_cast<std::uint8_t>(std::lround(settings.ceiling * std::clamp(share, 0.0, 1.0))));
    }
    return out;
}

}  // namespace

void Imagenex872::reconnected(std::size_t) {
    framer_.clear();
    wanted_.clear();
    holds_starboard_ = false;
}

Actions Imagenex872::received(const Received& data, Time now) {
    framer_.feed(data.bytes);
    while (const auto frame = framer_.next())
        if (const auto command = imagenex::parse_switch_command(*frame)) obey(*command, now);
    return take_actions();
}

void Imagenex872::obey(const imagenex::SwitchCommand& command, Time now) {
    const bool port = command.trigger == port_packet, starboard = command.trigger == starboard_packet;
    const bool alone = starboard && !under_way_ && !holds_starboard_;
    if ((!port && !starboard) || (alone && !settings_.pings_for_starboard)) {
        ++counters_.rejected;
        return;
    }
    ++counters_.messages;
    if (starboard && holds_starboard_ && !under_way_) {
        holds_starboard_ = false;
        actions_.send.push_back({0, reply(starboard_side), {}, {}});
        return;
    }
    wanted_.push_back(port ? port_side : starboard_side);
    if (!under_way_) transmit(command, now);
}

void Imagenex872::transmit(const imagenex::SwitchCommand& command, Time now) {
    command_ = command;
    under_way_ = true;
    holds_starboard_ = false;
    Shot shot = shot_from(command, settings_);
    shot.ping = ++shots_;
    const double window = 2 * range_of(command) / settings_.sound_speed;
    actions_.ping = Ping{shot, now + from_seconds(window + settings_.processing_time)};
}

Actions Imagenex872::heard(const Echogram& echogram, Time) {
    if (!under_way_ || echogram.shot.ping != shots_) return take_actions();
    under_way_ = false;
    holds_starboard_ = true;
    ++counters_.pings;
    for (const std::size_t side : {port_side, starboard_side})
        samples_[side] = counts(echogram, side, command_, settings_);
    for (const std::size_t side : std::exchange(wanted_, {})) {
        if (side == starboard_side) holds_starboard_ = false;
        actions_.send.push_back({0, reply(side), {}, {}});
    }
    return take_actions();
}

/// In one piece: a known host reads each part of it by one call.
Bytes Imagenex872::reply(std::size_t side) const {
    constexpr unsigned channel_shift = 7;  // byte 6
    imagenex::Reply r;
    r.kind = imagenex::Kind::igx;
    r.status = imagenex::status::accepted;
    r.head_position = imagenex::Packed14((side == port_side ? 2U : 1U) << channel_shift);
    r.range = static_cast<std::uint8_t>(range_of(command_));
    r.data = samples_[side];
    r.data_bytes = imagenex::Packed14(r.data.size());
    Bytes bytes = imagenex::encode(imagenex::Message(r));
    std::ranges::copy(settings_.header, bytes.begin());
    return bytes;
}

DeviceCounters Imagenex872::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes += framer_.skipped_bytes();
    return counters;
}

Actions Imagenex872::take_actions() { return std::exchange(actions_, {}); }

}  // namespace echoloop::imagenex872
