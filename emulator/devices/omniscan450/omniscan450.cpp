#include "emulator/devices/omniscan450/omniscan450.h"

#include <cmath>
#include <utility>

#include "emulator/devices/family/cerulean_levels.h"
#include "protocols/cerulean/omniscan_codec.h"

namespace echoloop::omniscan450 {
namespace {

using cerulean::Id;

constexpr std::string_view unknown_command = "command not recognised";

Time interval_of(const State& state) { return from_seconds(1e-3 * state.params.msec_per_ping); }

}  // namespace

Omniscan450::Omniscan450(const Settings& settings, std::vector<std::string> endpoints)
    : settings_(settings),
      endpoints_(std::move(endpoints)),
      ports_(cerulean_device::make_ports(endpoints_, settings.identity)),
      pieces_(cerulean_device::pieces(endpoints_, settings.identity)),
      link_(ports_.size(), settings.identity.source, true) {
    state_.params = typical_params();
}

Actions Omniscan450::started(Time) { return take_actions(); }

Actions Omniscan450::received(const Received& data, Time now) {
    if (data.port >= pieces_.size()) {
        discover(data);
        return take_actions();
    }
    for (const ping::Frame& frame : link_.receive(data).frames) obey(frame, {data.port, data.from}, now);
    return take_actions();
}

Actions Omniscan450::woken(Time now) {
    if (pacer_.begin(now)) transmit(now);
    return take_actions();
}

DeviceCounters Omniscan450::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes = link_.skipped_bytes();
    return counters;
}

void Omniscan450::discover(const Received& data) {
    auto words = cerulean_device::discovery_reply(data.bytes, endpoints_, settings_.identity);
    if (words.empty()) return;
    ++counters_.messages;
    actions_.send.push_back({data.port, std::move(words), data.from, {}});
}

void Omniscan450::obey(const ping::Frame& frame, const Peer& peer, Time now) {
    if (cerulean::omniscan::is_short_request(frame) && send_message(frame.header.id, peer)) {
        ++counters_.messages;
        return;
    }
    const auto message = cerulean::omniscan::parse(frame);
    if (!message) {
        // What it does not know it drops without a word.
        if (message.error().reason == wire::Reason::unknown_message)
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
        *message);
}

void Omniscan450::on(const ping::GeneralRequest& request, const Peer& peer, Time) {
    const auto requested = static_cast<ping::Id>(request.requested_id);
    if (!send_message(requested, peer))
        refuse(cerulean_device::refused_id(settings_.identity, requested), unknown_command, peer);
}

void Omniscan450::on(const cerulean::SetSpeedOfSound& command, const Peer& peer, Time) {
    set_speed_of_sound(command.speed_of_sound, settings_.takes_1002, Id::set_speed_of_sound, peer);
}

void Omniscan450::on(const cerulean::GeneralSpeedOfSound& command, const Peer& peer, Time) {
    set_speed_of_sound(command.speed_of_sound, settings_.takes_116, Id::general_speed_of_sound, peer);
}

void Omniscan450::set_speed_of_sound(std::uint32_t speed, bool known, Id id, const Peer& peer) {
    if (!known) return refuse(static_cast<ping::Id>(id), unknown_command, peer);
    if (!cerulean_device::is_speed_of_sound(speed))
        return refuse(static_cast<ping::Id>(id), "speed of sound out of range", peer);
    state_.speed_of_sound = speed;
    acknowledge(id, peer);
}

void Omniscan450::on(const OsPingParams& command, const Peer& peer, Time now) {
    if (const auto wrong = out_of_range(command); wrong && !settings_.accept_anything)
        return refuse(static_cast<ping::Id>(Id::os_ping_params), *wrong, peer);
    acknowledge(Id::os_ping_params, peer);
    if (command.enable == 0) return pacer_.stop();
    state_.params = limited(command);
    if (command.gain_index >= 0) state_.gain = static_cast<std::size_t>(state_.params.gain_index);
    listener_ = peer;
    pacer_.start(now, interval_of(state_));
}

bool Omniscan450::send_message(ping::Id id, const Peer& peer) {
    if (id == ping::Id::device_information) {
        reply(cerulean_device::device_information(settings_.identity), peer);
    } else if (id == ping::Id::protocol_version) {
        reply(cerulean_device::protocol_version(settings_.identity), peer);
    } else if (id == static_cast<ping::Id>(Id::os_mono_profile)) {
        reply(last_, peer);
    } else {
        return false;
    }
    return true;
}

void Omniscan450::acknowledge(Id id, const Peer& peer) {
    if (settings_.identity.acknowledge) reply(ping::Ack{static_cast<std::uint16_t>(id)}, peer);
}

void Omniscan450::refuse(ping::Id id, std::string_view text, const Peer& peer) {
    ++counters_.rejected;
    reply(ping_device::nack(id, text), peer);
}

void Omniscan450::reply(const Message& message, const Peer& peer) {
    for (Send& send : link_.reply_in_pieces(message, peer, pieces_.at(peer.port)))
        actions_.send.push_back(std::move(send));
}

void Omniscan450::transmit(Time now) {
    pinged_ = state_;
    pinged_at_ = now;
    Shot shot = shot_from(pinged_, settings_);
    shot.ping = ++pings_;
    const double time = ping_time(pinged_, settings_);
    shot.interval = std::max(time, 1e-3 * pinged_.params.msec_per_ping);
    actions_.ping = Ping{std::move(shot), now + from_seconds(time)};
}

Actions Omniscan450::heard(const Echogram& echogram, Time now) {
    if (echogram.shot.ping != pings_ || !pacer_.under_way()) return take_actions();
    ++counters_.pings;
    last_ = profile(echogram);
    if (state_.params.gain_index < 0)
        state_.gain =
            cerulean_device::fitting_gain(echogram.beam(0), settings_.acoustics.full_scales, pinged_.gain);
    reply(last_, listener_);
    pacer_.end(now + cerulean_device::line_time(actions_.send, settings_.identity), interval_of(state_));
    return take_actions();
}

OsMonoProfile Omniscan450::profile(const Echogram& echogram) const {
    const double full_scale =
        echogram.rule == EchoRule::cerqueira2016 ? 0 : settings_.acoustics.full_scales.at(pinged_.gain);
    const auto heard = cerulean_device::smoothed(echogram.beam(0), filter_bins(pinged_, settings_));
    auto results = cerulean_device::to_results(heard, full_scale);
    const double heading = cerulean_device::compass(rotate(echogram.world_from_sonar.orientation, {1, 0, 0}));
    OsMonoProfile p;
    p.ping_number = static_cast<std::uint32_t>(pings_ - 1);
    p.start_mm = pinged_.params.start_mm;
    p.length_mm = pinged_.params.length_mm;
    p.timestamp_ms =
        static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::milliseconds>(pinged_at_).count());
    p.ping_hz = static_cast<std::uint32_t>(std::lround(settings_.acoustics.frequency));
    p.gain_index = static_cast<std::uint16_t>(pinged_.gain);
    p.sos_dmps = static_cast<std::uint16_t>((pinged_.speed_of_sound + 50) / 100);
    p.channel_number = settings_.channel;
    p.pulse_duration_sec = static_cast<float>(pulse_length(pinged_, settings_));
    p.analog_gain = static_cast<float>(settings_.acoustics.gains.at(pinged_.gain));
    p.max_pwr_db = results.max_db;
    p.min_pwr_db = results.min_db;
    p.transducer_heading_deg = static_cast<float>(heading);
    p.vehicle_heading_deg = static_cast<float>(std::fmod(heading - settings_.mount_bearing + 720, 360));
    p.pwr_results = std::move(results.values);
    return p;
}

Actions Omniscan450::take_actions() {
    actions_.wake = pacer_.wake();
    return std::exchange(actions_, {});
}

}  // namespace echoloop::omniscan450
