#include "emulator/devices/s500/s500.h"

#include <cmath>
#include <utility>

#include "emulator/devices/family/cerulean/levels.h"
#include "emulator/devices/family/sounder/auto_range.h"
#include "protocols/ping/codec.h"

namespace echoloop::s500 {
namespace {

using cerulean::Id;
namespace wire_message = cerulean::s500;

constexpr std::uint32_t first_length = 10000;  // mm, of an automatic range

std::uint32_t millimetres(double metres) { return static_cast<std::uint32_t>(std::lround(1e3 * metres)); }

std::uint8_t percent(double value) { return static_cast<std::uint8_t>(value); }

}  // namespace

S500::S500(const Settings& settings, std::vector<Endpoint> endpoints)
    : Sonar(settings.identity, settings.sensors, std::move(endpoints)), settings_(settings) {
    state_.params.gain_index = -1;
}

void S500::obey(const ping::Frame& frame, const Peer& peer, Time now) {
    if (obey_as_ping1d(frame, peer, now)) return;
    const auto unknown = [](const auto& parsed) {
        return !parsed && parsed.error().reason == wire::Reason::unknown_message;
    };
    if (unknown(ping::parse(frame)) && unknown(wire_message::Codec::parse(frame))) {
        const std::string text = "Unknown message id " + std::to_string(static_cast<int>(frame.header.id));
        not_understood();
        return reply(ping::Message(ping::AsciiText{{text.begin(), text.end()}}), peer);
    }
    obey_with<Message>(frame, peer, [&](const auto& m) {
        constexpr bool known = requires { on(m, peer, now); };
        if constexpr (known) on(m, peer, now);
        return known;
    });
}

void S500::on(const SetPingParams& command, const Peer& peer, Time now) {
    if (const auto wrong = out_of_range(command); wrong && !settings_.accept_anything)
        return refuse(static_cast<ping::Id>(Id::s500_ping_params), *wrong, peer);
    acknowledge(Id::s500_ping_params, peer);
    enabled_ = command.report_id != 0;
    if (!enabled_) return stop_pings();
    const bool was_automatic = state_.params.length_mm == 0 && pings() > 0;
    state_.params = limited(command);
    if (state_.params.length_mm != 0)
        state_.length = state_.params.length_mm;
    else if (!was_automatic)
        state_.length = first_length;
    if (state_.params.gain_index >= 0) state_.gain = static_cast<std::size_t>(state_.params.gain_index);
    start_pings(peer, now);
}

std::optional<Message> S500::message(ping::Id id) const {
    const auto& identity = settings_.identity;
    switch (static_cast<Id>(id)) {
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
            if (!settings_.long_temperature) return std::nullopt;
            return wire_message::ProcessorTemperature{processor_temperature()};
        case Id::distance2:
            return distance_;
        case Id::profile6:
            return profile_;
        default:
            return std::nullopt;
    }
}

std::uint32_t S500::processor_temperature() const {
    const Stray stray = 100 * stray::board_temperature;
    return static_cast<std::uint32_t>(
        std::max(std::lround(read("processor", settings_.processor_temperature, stray)), 0L));
}

bool S500::send_own(ping::Id id, const Peer& peer) {
    if (const auto found = message(id)) {
        reply(*found, peer);
        return true;
    }
    const auto found = ping1d_message(id);
    if (found) reply(*found, peer);
    return found.has_value();
}

Shot S500::next_shot() {
    pinged_ = state_;
    Shot shot = shot_from(pinged_, settings_);
    shot.interval = pinged_.single() ? 0 : std::max(ping_time(), 1e-3 * pinged_.interval());
    if (pinged_.single()) only_this_ping();
    return shot;
}

void S500::report(const Echogram& echogram) {
    keep(echogram);
    follow(echogram);
    if (pinged_.params.report_id != 0)
        send_message(static_cast<ping::Id>(pinged_.params.report_id), listener());
}

/// The reports of this ping.
void S500::keep(const Echogram& echogram) {
    const Acoustics& a = settings_.acoustics;
    const Depth depth = find_depth(echogram, pinged_, settings_);
    smooth_.add(depth);
    const Depth mean = smooth_.mean();
    const std::uint32_t time = pinged_at();
    distance_ = {millimetres(depth.metres), millimetres(mean.metres), 0,
                 percent(depth.confidence), percent(mean.confidence), time};
    const bool paper = echogram.rule == EchoRule::cerqueira2016;
    auto results = cerulean_device::to_results(echogram.beam(0), paper ? 0 : a.full_scales.at(pinged_.gain));
    const double half = echogram.shot.bandwidth / 2;
    wire_message::Profile6 p;
    p.ping_number = static_cast<std::uint32_t>(pings() - 1);
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
    std::optional<std::uint32_t> bottom;
    if (distance_.ping_confidence >= sure) bottom = distance_.ping_distance_mm;
    state_.length = echosounder::next_length(pinged_.length, bottom, shortest_automatic, longest_automatic);
}

}  // namespace echoloop::s500
