// The messages of a Ping1D that an S500 understands beside its own.
#include "emulator/devices/family/cerulean/common.h"
#include "emulator/devices/s500/s500.h"
#include "protocols/ping/codec.h"

namespace echoloop::s500 {
namespace {

constexpr std::uint16_t rail = 5000;  // mV

}  // namespace

std::optional<ping::Message> S500::ping1d_message(ping::Id id) const {
    const auto& firmware = settings_.identity.firmware;
    const auto automatic = static_cast<std::uint8_t>(state_.params.gain_index < 0);
    const auto pulse = static_cast<std::uint16_t>(1e6F * profile_.pulse_duration_sec);
    switch (id) {
        case ping::Id::device_id:
            return ping::DeviceId{source()};
        case ping::Id::voltage5:
            return ping::Voltage5{rail};
        case ping::Id::mode_auto:
            return ping::ModeAuto{automatic};
        case ping::Id::transmit_duration:
            return ping::TransmitDuration{pulse};
        case ping::Id::general_info:
            return ping::GeneralInfo{
                firmware[0], firmware[1], rail, state_.interval(), static_cast<std::uint8_t>(state_.gain),
                automatic};
        case ping::Id::distance:
            return ping::Distance{distance_.ping_distance_mm, distance_.ping_confidence, pulse,
                                  profile_.ping_number,       profile_.start_mm,         profile_.length_mm,
                                  profile_.gain_index};
        case ping::Id::processor_temperature:
            return ping::ProcessorTemperature{static_cast<std::uint16_t>(processor_temperature())};
        case ping::Id::ping_enable:
            return ping::PingEnable{enabled_};
        default:
            return std::nullopt;
    }
}

std::optional<std::string_view> S500::take(const ping::Ping1dSetDeviceId& command, const Peer&, Time) {
    if (command.device_id == 0 || command.device_id == 255) return "id out of range";
    set_source(command.device_id);
    return std::nullopt;
}

std::optional<std::string_view> S500::take(const ping::SetRange& command, const Peer&, Time) {
    SetPingParams wanted = state_.params;
    wanted.start_mm = command.scan_start;
    wanted.length_mm = command.scan_length;
    if (wanted.length_mm == 0 || !is_range(wanted)) return "range out of range";
    state_.params = wanted;
    state_.length = wanted.length_mm;
    return std::nullopt;
}

std::optional<std::string_view> S500::take(const ping::SetSpeedOfSound& command, const Peer&, Time) {
    if (!cerulean_device::is_speed_of_sound(command.speed_of_sound)) return "speed of sound out of range";
    state_.speed_of_sound = command.speed_of_sound;
    return std::nullopt;
}

std::optional<std::string_view> S500::take(const ping::SetModeAuto& command, const Peer&, Time) {
    if (command.mode_auto > 1) return "mode out of range";
    const bool automatic = command.mode_auto == 1;
    state_.params.gain_index = automatic ? std::int16_t{-1} : static_cast<std::int16_t>(state_.gain);
    state_.params.length_mm = automatic ? 0 : state_.length;
    return std::nullopt;
}

std::optional<std::string_view> S500::take(const ping::SetPingInterval& command, const Peer&, Time) {
    if (command.ping_interval > INT16_MAX) return "ping interval out of range";
    state_.params.msec_per_ping = static_cast<std::int16_t>(command.ping_interval);
    return std::nullopt;
}

std::optional<std::string_view> S500::take(const ping::SetGainSetting& command, const Peer&, Time) {
    if (command.gain_setting > highest_gain) return "gain out of range";
    state_.params.gain_index = command.gain_setting;
    state_.gain = command.gain_setting;
    return std::nullopt;
}

std::optional<std::string_view> S500::take(const ping::SetPingEnable& command, const Peer& peer, Time now) {
    enabled_ = command.ping_enabled != 0;
    if (enabled_)
        start_pings(peer, now);
    else
        stop_pings();
    return std::nullopt;
}

bool S500::obey_as_ping1d(const ping::Frame& frame, const Peer& peer, Time now) {
    const ping::Id id = frame.header.id;
    if (ping::is_short_request(frame)) {
        const bool known = send_message(id, peer);
        if (known) understood();
        return known;
    }
    const auto message = ping::parse(frame);
    if (!message) return false;
    return std::visit(
        [&](const auto& command) {
            constexpr bool known = requires { take(command, peer, now); };
            if constexpr (known) {
                if (const auto why = take(command, peer, now)) {
                    refuse(id, *why, peer);
                } else {
                    understood();
                    reply(ping::Message(ping::Ack{static_cast<std::uint16_t>(id)}), peer);
                }
            }
            return known;
        },
        *message);
}

}  // namespace echoloop::s500
