#include "emulator/devices/s500/s500.h"

#include <cmath>
#include <utility>

#include "emulator/devices/family/auto_range.h"
#include "emulator/devices/family/cerulean_levels.h"
#include "protocols/cerulean/s500_codec.h"

namespace echoloop::s500 {
namespace {

using cerulean::Id;
namespace wire_message = cerulean::s500;

constexpr std::string_view unknown_command = "command not recognised";
constexpr double first_range = 10;  // m, of an automatic range

Time interval_of(const State& state) { return std::chrono::milliseconds(state.interval()); }

std::uint32_t milliseconds(Time time) {
    return static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
}

std::uint32_t millimetres(double metres) { return static_cast<std::uint32_t>(std::lround(1e3 * metres)); }

std::uint8_t percent(double value) { return static_cast<std::uint8_t>(value); }

}  // namespace

S500::S500(const Settings& settings, std::vector<std::string> endpoints)
    : settings_(settings),
      endpoints_(std::move(endpoints)),
      ports_(cerulean_device::make_ports(endpoints_, settings.identity)),
      pieces_(cerulean_device::pieces(endpoints_, settings.identity)),
      link_(ports_.size(), settings.identity.source, true) {
    state_.params.gain_index = -1;
}

Actions S500::started(Time) { return take_actions(); }

Actions S500::received(const Received& data, Time now) {
    if (data.port >= pieces_.size()) {
        discover(data);
        return take_actions();
    }
    for (const ping::Frame& frame : link_.receive(data).frames) obey(frame, {data.port, data.from}, now);
    return take_actions();
}

Actions S500::woken(Time now) {
    if (pacer_.begin(now)) transmit(now);
    return take_actions();
}

DeviceCounters S500::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes = link_.skipped_bytes();
    return counters;
}

void S500::discover(const Received& data) {
    auto words = cerulean_device::discovery_reply(data.bytes, endpoints_, settings_.identity);
    if (words.empty()) return;
    ++counters_.messages;
    actions_.send.push_back({data.port, std::move(words), data.from, {}});
}

void S500::obey(const ping::Frame& frame, const Peer& peer, Time now) {
    if (cerulean::s500::is_short_request(frame) && send_message(frame.header.id, peer)) {
        ++counters_.messages;
        return;
    }
    const auto parsed = cerulean::s500::parse(frame);
    if (!parsed) {
        // What it does not know it drops without a word.
        if (parsed.error().reason == wire::Reason::unknown_message)
            ++counters_.rejected;
        else
            refuse(frame.header.id, "wrong length", peer);
        return;
    }
    std::visit(
        [&](const auto& m) {
            if constexpr (requires { on(m, peer, now); }) {
                ++counters_.messages;
                on(m, peer, now);
            } else {
                ++counters_.rejected;  // what devices say; never answered, else two of them would not end
            }
        },
        *parsed);
}

void S500::on(const ping::GeneralRequest& request, const Peer& peer, Time) {
    const auto requested = static_cast<ping::Id>(request.requested_id);
    if (!send_message(requested, peer))
        refuse(cerulean_device::refused_id(settings_.identity, requested), unknown_command, peer);
}

void S500::on(const cerulean::SetSpeedOfSound& command, const Peer& peer, Time) {
    if (!cerulean_device::is_speed_of_sound(command.speed_of_sound))
        return refuse(static_cast<ping::Id>(Id::set_speed_of_sound), "speed of sound out of range", peer);
    state_.speed_of_sound = command.speed_of_sound;
    acknowledge(Id::set_speed_of_sound, peer);
}

void S500::on(const SetPingParams& command, const Peer& peer, Time now) {
    if (const auto wrong = out_of_range(command); wrong && !settings_.accept_anything)
        return refuse(static_cast<ping::Id>(Id::s500_ping_params), *wrong, peer);
    acknowledge(Id::s500_ping_params, peer);
    if (command.report_id == 0) return pacer_.stop();
    const bool was_automatic = state_.params.length_mm == 0 && pings_ > 0;
    state_.params = limited(command);
    if (state_.params.length_mm != 0)
        state_.length = state_.params.length_mm;
    else if (!was_automatic)
        state_.length = millimetres(first_range);
    if (state_.params.gain_index >= 0) state_.gain = static_cast<std::size_t>(state_.params.gain_index);
    listener_ = peer;
    pacer_.start(now, interval_of(state_));
}

std::optional<Message> S500::message(ping::Id id) const {
    const auto& identity = settings_.identity;
    switch (static_cast<Id>(id)) {
        case Id::device_information:
            return cerulean_device::device_information(identity);
        case Id::protocol_version:
            return cerulean_device::protocol_version(identity);
        case Id::fw_version:
            return wire_message::FwVersion{identity.device_type, identity.device_revision,
                                           identity.firmware[0], identity.firmware[1]};
        case Id::speed_of_sound:
            return wire_message::SpeedOfSound{state_.speed_of_sound};
        case Id::range:
            return wire_message::Range{state_.params.start_mm, state_.length};
        case Id::ping_rate:
            return wire_message::PingRate{state_.interval()};
        case Id::gain_index:
            return wire_message::GainIndex{static_cast<std::uint32_t>(state_.gain)};
        case Id::altitude:
            return wire_message::Altitude{distance_.ping_distance_mm, distance_.ping_confidence};
        case Id::processor_temperature:
            return wire_message::ProcessorTemperature{settings_.processor_temperature};
        case Id::distance2:
            return distance_;
        case Id::profile6:
            return profile_;
        default:
            return std::nullopt;
    }
}

/// False if there is no such message.
bool S500::send_message(ping::Id id, const Peer& peer) {
    const auto found = message(id);
    if (found) reply(*found, peer);
    return found.has_value();
}

void S500::acknowledge(Id id, const Peer& peer) {
    if (settings_.identity.acknowledge) reply(ping::Ack{static_cast<std::uint16_t>(id)}, peer);
}

void S500::refuse(ping::Id id, std::string_view text, const Peer& peer) {
    ++counters_.rejected;
    reply(ping_device::nack(id, text), peer);
}

void S500::reply(const Message& message, const Peer& peer) {
    for (Send& send : link_.reply_in_pieces(message, peer, pieces_.at(peer.port)))
        actions_.send.push_back(std::move(send));
}

void S500::transmit(Time now) {
    pinged_ = state_;
    pinged_at_ = now;
    Shot shot = shot_from(pinged_, settings_);
    shot.ping = ++pings_;
    const double time = ping_time(pinged_, settings_);
    shot.interval = pinged_.single() ? 0 : std::max(time, 1e-3 * pinged_.interval());
    actions_.ping = Ping{std::move(shot), now + from_seconds(time)};
    if (pinged_.single()) pacer_.once();
}

Actions S500::heard(const Echogram& echogram, Time now) {
    if (echogram.shot.ping != pings_ || !pacer_.under_way()) return take_actions();
    ++counters_.pings;
    keep(echogram);
    follow(echogram);
    send_message(static_cast<ping::Id>(pinged_.params.report_id), listener_);
    pacer_.end(now + cerulean_device::line_time(actions_.send, settings_.identity), interval_of(state_));
    return take_actions();
}

/// The reports of this ping.
void S500::keep(const Echogram& echogram) {
    const Acoustics& a = settings_.acoustics;
    const Depth depth = find_depth(echogram, pinged_, settings_);
    smooth_.add(depth);
    const Depth mean = smooth_.mean();
    const std::uint32_t time = milliseconds(pinged_at_);
    distance_ = {millimetres(depth.metres), millimetres(mean.metres), 0,
                 percent(depth.confidence), percent(mean.confidence), time};
    const bool paper = echogram.rule == EchoRule::cerqueira2016;
    auto results = cerulean_device::to_results(echogram.beam(0), paper ? 0 : a.full_scales.at(pinged_.gain));
    const double half = echogram.shot.bandwidth / 2;
    wire_message::Profile6 p;
    p.ping_number = static_cast<std::uint32_t>(pings_ - 1);
    p.start_mm = pinged_.params.start_mm;
    p.length_mm = pinged_.length;
    p.start_ping_hz = static_cast<std::uint32_t>(std::lround(a.frequency - half));
    p.end_ping_hz = static_cast<std::uint32_t>(std::lround(a.frequency + half));
    p.adc_sample_hz = static_cast<std::uint32_t>(std::lround(a.sample_rate));
    p.timestamp_msec = time;
    p.pulse_duration_sec = static_cast<float>(echogram.shot.pulse_length);
    p.analog_gain = static_cast<float>(a.gains.at(pinged_.gain));
    p.max_pwr_db = results.max_db;
    p.min_pwr_db = results.min_db;
    p.this_ping_depth_m = static_cast<float>(depth.metres);
    p.smooth_depth_m = static_cast<float>(mean.metres);
    p.ping_depth_measurement_confidence = percent(depth.confidence);
    p.gain_index = static_cast<std::uint8_t>(pinged_.gain);
    p.decimation = resolution(pinged_, settings_).decimation;
    p.smoothed_depth_measurement_confidence = percent(mean.confidence);
    p.pwr_results = std::move(results.values);
    profile_ = std::move(p);
}

/// Gain and range of the next ping, where they are automatic.
void S500::follow(const Echogram& echogram) {
    constexpr int sure = 50;  // %
    if (state_.params.gain_index < 0)
        state_.gain =
            cerulean_device::fitting_gain(echogram.beam(0), settings_.acoustics.full_scales, pinged_.gain);
    if (state_.params.length_mm != 0) return;
    std::optional<double> bottom;
    if (distance_.ping_confidence >= sure) bottom = 1e-3 * distance_.ping_distance_mm;
    state_.length =
        millimetres(echosounder::next_range(1e-3 * pinged_.length, bottom, shortest_range, longest_range));
}

Actions S500::take_actions() {
    actions_.wake = pacer_.wake();
    return std::exchange(actions_, {});
}

}  // namespace echoloop::s500
