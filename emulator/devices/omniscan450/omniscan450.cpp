#include "emulator/devices/omniscan450/omniscan450.h"

#include <cmath>
#include <utility>

#include "emulator/devices/family/cerulean/levels.h"

namespace echoloop::omniscan450 {

using cerulean::Id;

Omniscan450::Omniscan450(const Settings& settings, std::vector<Endpoint> endpoints)
    : Sonar(settings.identity, settings.sensors, std::move(endpoints)), settings_(settings) {
    state_.params = typical_params();
}

void Omniscan450::obey(const ping::Frame& frame, const Peer& peer, Time now) {
    obey_with<Message>(frame, peer, [&](const auto& message) {
        constexpr bool known = requires { on(message, peer, now); };
        if constexpr (known) on(message, peer, now);
        return known;
    });
}

void Omniscan450::on(const cerulean::SetSpeedOfSound& command, const Peer& peer, Time) {
    if (!settings_.takes_1002)
        return refuse(ping::Id::set_speed_of_sound, cerulean_device::unknown_command, peer);
    set_speed_of_sound(command.speed_of_sound, Id::set_speed_of_sound, peer, state_.speed_of_sound);
}

void Omniscan450::on(const cerulean::GeneralSpeedOfSound& command, const Peer& peer, Time) {
    constexpr Id id = Id::general_speed_of_sound;
    if (!settings_.takes_116)
        return refuse(static_cast<ping::Id>(id), cerulean_device::unknown_command, peer);
    set_speed_of_sound(command.speed_of_sound, id, peer, state_.speed_of_sound);
}

void Omniscan450::on(const OsPingParams& command, const Peer& peer, Time now) {
    if (const auto wrong = out_of_range(command); wrong && !settings_.accept_anything)
        return refuse(static_cast<ping::Id>(Id::os_ping_params), *wrong, peer);
    acknowledge(Id::os_ping_params, peer);
    if (command.enable == 0) return stop_pings();
    state_.params = limited(command);
    if (command.gain_index >= 0) state_.gain = static_cast<std::size_t>(state_.params.gain_index);
    start_pings(peer, now);
}

bool Omniscan450::send_own(ping::Id id, const Peer& peer) {
    if (static_cast<Id>(id) != Id::os_mono_profile) return false;
    reply(Message(last_), peer);
    return true;
}

Shot Omniscan450::next_shot() {
    pinged_ = state_;
    Shot shot = shot_from(pinged_, settings_);
    shot.interval = std::max(ping_time(), 1e-3 * pinged_.params.msec_per_ping);
    return shot;
}

void Omniscan450::report(const Echogram& echogram) {
    last_ = profile(echogram);
    if (state_.params.gain_index < 0)
        state_.gain =
            cerulean_device::fitting_gain(echogram.beam(0), settings_.acoustics.full_scales, pinged_.gain);
    reply(Message(last_), listener());
}

OsMonoProfile Omniscan450::profile(const Echogram& echogram) const {
    const double full_scale =
        echogram.rule == EchoRule::cerqueira2016 ? 0 : settings_.acoustics.full_scales.at(pinged_.gain);
    const auto heard = cerulean_device::smoothed(echogram.beam(0), filter_bins(pinged_, settings_));
    auto results = cerulean_device::to_results(heard, full_scale);
    const double heading =
        read_compass(cerulean_device::compass(rotate(echogram.world_from_sonar.orientation, {1, 0, 0})));
    OsMonoProfile p;
    p.ping_number = static_cast<std::uint32_t>(pings() - 1);
    p.start_mm = pinged_.params.start_mm;
    p.length_mm = pinged_.params.length_mm;
    p.timestamp_ms = pinged_at();
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

}  // namespace echoloop::omniscan450
