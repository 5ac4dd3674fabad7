#include "emulator/devices/ping1d/ping1d.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace echoloop::ping1d {
namespace {

using ping::Id;

constexpr Time shortest_pause = std::chrono::milliseconds(10);  // between the end of a ping and the next
constexpr Time boot_loader_time = std::chrono::seconds(5);

}  // namespace

Ping1d::Ping1d(const Settings& settings, std::vector<Port> ports)
    : settings_(settings),
      ports_(std::move(ports)),
      link_(settings.device_id, settings.marks_are_breaks),
      tracker_(settings.tracking_lag) {}

void Ping1d::power_up(Time now) {
    state_ = settings_.power_up;
    last_ = {};
    streams_.clear();
    tracker_ = echosounder::Tracker(settings_.tracking_lag);
    if (settings_.stream_at_start) streams_[Id::profile] = {};
    restarting_ = false;
    pacer_.reset();
    pacer_.start(now, {});
}

Actions Ping1d::started(Time now) {
    power_up(now);
    return take_actions();
}

Actions Ping1d::received(const Received& data, Time now) {
    now_ = now;
    if (restarting_) return take_actions();
    for (const ping::Frame& frame : link_.receive(data).frames) obey(frame, {data.port, data.from}, now);
    return take_actions();
}

Actions Ping1d::woken(Time now) {
    if (restarting_ && now >= pacer_.wake()) power_up(now);
    if (pacer_.begin(now)) transmit(now);
    return take_actions();
}

DeviceCounters Ping1d::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes = link_.skipped_bytes();
    return counters;
}

/// What an echosounder does not know it drops without a word.
void Ping1d::obey(const ping::Frame& frame, const Peer& peer, Time now) {
    if (ping::is_short_request(frame) && send_message(frame.header.id, peer)) {
        ++counters_.messages;
        return;
    }
    const auto parsed = ping::parse(frame);
    if (!parsed) {
        ++counters_.rejected;
        return;
    }
    std::visit(
        [&](const auto& m) {
            if constexpr (requires { on(m, peer); }) {
                ++counters_.messages;
                on(m, peer);
            } else {
                ++counters_.rejected;
            }
        },
        *parsed);
    if (restarting_) {
        pacer_.reset();
        pacer_.start(now + boot_loader_time, {});
    } else if (state_.enabled && pacer_.wake() == Time::max()) {
        pacer_.start(now, {});  // pings that are enabled again begin at once
    }
}

void Ping1d::on(const ping::GeneralRequest& request, const Peer& peer) {
    const auto requested = static_cast<Id>(request.requested_id);
    if (send_message(requested, peer)) return;
    const Id refused = settings_.nack_requested_id ? requested : Id::general_request;
    acknowledge(false, refused, "command not recognised", peer);
}

void Ping1d::set_id(std::uint8_t id, Id command, const Peer& peer) {
    const bool good = id != 0 && id != 255;
    if (good) link_.set_id(id);
    acknowledge(good, command, "id out of range", peer);
}

void Ping1d::on(const ping::Ping1dSetDeviceId& command, const Peer& peer) {
    set_id(command.device_id, Id::ping1d_set_device_id, peer);
}

void Ping1d::on(const ping::SetDeviceId& command, const Peer& peer) {
    set_id(command.device_id, Id::set_device_id, peer);
}

void Ping1d::on(const ping::SetRange& command, const Peer& peer) {
    const bool good = command.scan_length >= shortest_length && command.scan_length <= longest_length &&
                      command.scan_start <= longest_length;
    const auto* why = state_.automatic ? "Range is automatic" : "Range scan length out of range";
    if (!acknowledge(good && !state_.automatic, Id::set_range, why, peer)) return;
    state_.start = command.scan_start;
    state_.length = command.scan_length;
}

void Ping1d::on(const ping::SetSpeedOfSound& command, const Peer& peer) {
    constexpr std::uint32_t lowest = 100000, highest = 10000000;  // mm/s
    const bool good = command.speed_of_sound >= lowest && command.speed_of_sound <= highest;
    if (!acknowledge(good, Id::set_speed_of_sound, "Speed of sound out of range", peer)) return;
    state_.speed_of_sound = command.speed_of_sound;
    tracker_ = echosounder::Tracker(settings_.tracking_lag);  // what it has was told in other metres
}

void Ping1d::on(const ping::SetModeAuto& command, const Peer& peer) {
    if (acknowledge(command.mode_auto <= 1, Id::set_mode_auto, "Mode out of range", peer))
        state_.automatic = command.mode_auto == 1;
}

void Ping1d::on(const ping::SetPingInterval& command, const Peer& peer) {
    acknowledge(true, Id::set_ping_interval, "", peer);
    state_.interval = command.ping_interval;
}

void Ping1d::on(const ping::SetGainSetting& command, const Peer& peer) {
    if (acknowledge(command.gain_setting <= 6, Id::set_gain_setting, "Gain setting out of range", peer))
        state_.gain = command.gain_setting;
}

void Ping1d::on(const ping::SetPingEnable& command, const Peer& peer) {
    acknowledge(true, Id::set_ping_enable, "", peer);
    state_.enabled = command.ping_enabled != 0;
    if (!state_.enabled) pacer_.pause();
}

void Ping1d::on(const ping::SetOssProfileConfiguration& command, const Peer& peer) {
    const bool good = command.number_of_points >= 10 && command.number_of_points <= 1200;
    if (!acknowledge(good, Id::set_oss_profile_configuration, "Number of points out of range", peer)) return;
    state_.points = command.number_of_points;
    state_.normalise = command.normalization_enabled != 0;
}

void Ping1d::on(const ping::ContinuousStart& command, const Peer& peer) {
    const auto id = static_cast<Id>(command.id);
    const bool good = id == Id::profile || id == Id::distance || id == Id::distance_simple;
    if (good) streams_[settings_.always_profile ? Id::profile : id] = peer;
    if (!good || settings_.ack_continuous)
        acknowledge(good, Id::continuous_start, "Message cannot be streamed", peer);
}

void Ping1d::on(const ping::ContinuousStop& command, const Peer& peer) {
    streams_.erase(settings_.always_profile ? Id::profile : static_cast<Id>(command.id));
    if (settings_.ack_continuous) acknowledge(true, Id::continuous_stop, "", peer);
}

void Ping1d::on(const ping::GotoBootloader&, const Peer& peer) {
    acknowledge(true, Id::goto_bootloader, "", peer);
    restarting_ = true;
}

bool Ping1d::acknowledge(bool good, Id id, std::string_view text, const Peer& peer) {
    if (good) {
        reply(ping::Ack{static_cast<std::uint16_t>(id)}, peer);
    } else {
        ++counters_.rejected;
        reply(ping_device::nack(id, text), peer);
    }
    return good;
}

std::uint16_t Ping1d::read(std::string_view name, std::uint16_t truth, const Stray& stray) const {
    constexpr double most = 65535;
    return static_cast<std::uint16_t>(
        std::lround(std::clamp(settings_.sensors.read(name, truth, stray, now_), 0.0, most)));
}

std::uint16_t Ping1d::voltage() const {
    return read("supply", settings_.voltage, settings_.voltage * stray::supply);
}

std::optional<ping::Message> Ping1d::message(Id id) const {
    const auto& [major, minor, patch] = settings_.firmware;
    const auto& p = settings_.protocol;
    switch (id) {
        case Id::device_information:
            return ping::DeviceInformation{
                settings_.device_type, settings_.device_revision, major, minor, patch, 0};
        case Id::protocol_version:
            return ping::ProtocolVersion{p[0], p[1], p[2], 0};
        case Id::firmware_version:
            return ping::FirmwareVersion{settings_.device_type, settings_.device_model, major, minor};
        case Id::device_id:
            return ping::DeviceId{link_.id()};
        case Id::voltage5:
            return ping::Voltage5{voltage()};
        case Id::speed_of_sound:
            return ping::SpeedOfSound{state_.speed_of_sound};
        case Id::range:
            return ping::Range{state_.start, state_.length};
        case Id::mode_auto:
            return ping::ModeAuto{state_.automatic};
        case Id::ping_interval:
            return ping::PingInterval{state_.interval};
        case Id::gain_setting:
            return ping::GainSetting{state_.gain};
        case Id::transmit_duration:
            return ping::TransmitDuration{state_.transmit_duration()};
        case Id::general_info:
            return ping::GeneralInfo{major, minor, voltage(), state_.interval, state_.gain, state_.automatic};
        case Id::distance_simple:
            return ping::DistanceSimple{last_.distance, static_cast<std::uint8_t>(last_.confidence)};
        case Id::distance:
            return ping::Distance{last_.distance,    last_.confidence, last_.transmit_duration,
                                  last_.ping_number, last_.scan_start, last_.scan_length,
                                  last_.gain_setting};
        case Id::processor_temperature:
            return ping::ProcessorTemperature{
                read("processor", settings_.processor_temperature, 100 * stray::board_temperature)};
        case Id::pcb_temperature:
            return ping::PcbTemperature{
                read("board", settings_.pcb_temperature, 100 * stray::board_temperature)};
        case Id::ping_enable:
            return ping::PingEnable{state_.enabled};
        case Id::profile:
            return last_;
        case Id::oss_profile_configuration:
            return ping::OssProfileConfiguration{state_.points, state_.normalise, 0};
        default:
            return std::nullopt;
    }
}

/// False if there is no such message.
bool Ping1d::send_message(Id id, const Peer& peer) {
    const auto found = message(id);
    if (found && is_old(settings_) && (id == Id::voltage5 || id == Id::processor_temperature))
        actions_.send.push_back(link_.reply_without_content(id, peer));
    else if (found)
        reply(*found, peer);
    return found.has_value();
}

void Ping1d::reply(const ping::Message& message, const Peer& peer) {
    actions_.send.push_back(link_.reply(message, peer));
}

void Ping1d::transmit(Time now) {
    pinged_ = state_;
    Shot shot = shot_from(state_, settings_);
    shot.ping = ++ping_;
    const double window =
        shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval + settings_.processing_time;
    shot.interval = std::max(window, state_.interval * 1e-3);
    actions_.ping = Ping{std::move(shot), now + from_seconds(window)};
}

Bottom Ping1d::tracked(const Bottom& found, Time now) {
    std::optional<double> metres;
    if (found.confidence > 0) metres = 1e-3 * found.distance;
    const auto reading = tracker_.follow(metres, to_seconds(now));
    if (!reading) return found;
    // What the last good ping was worth fades while nothing agrees with it.
    const int worth = found.confidence > 0 ? found.confidence : 100;
    return {static_cast<std::uint32_t>(std::lround(1e3 * reading->distance)),
            static_cast<std::uint8_t>(std::lround(worth * reading->trust))};
}

Actions Ping1d::heard(const Echogram& echogram, Time now) {
    if (!pacer_.under_way() || echogram.shot.ping != ping_) return take_actions();
    ++counters_.pings;
    const Bottom bottom = find_bottom(echogram, pinged_, settings_);
    const Bottom told = tracked(bottom, now);
    last_ = {told.distance,
             told.confidence,
             pinged_.transmit_duration(),
             ping_,
             pinged_.start,
             pinged_.length,
             pinged_.gain,
             profile_points(echogram, pinged_, settings_)};
    if (state_.automatic) follow(state_, bottom, loudest(last_.profile_data, pinged_, settings_));
    for (const auto& [id, peer] : streams_) send_message(id, peer);
    pacer_.end(now, std::chrono::milliseconds(state_.interval));
    // Not so soon that the next message would queue up behind what is about to be sent, and grow old.
    pacer_.hold(now +
                std::max(shortest_pause, settings_.line.time(actions_.send) - from_seconds(state_.window())));
    return take_actions();
}

void Ping1d::line_rate(std::size_t port, double rate) { settings_.line.follow(port, rate); }

Actions Ping1d::take_actions() {
    actions_.wake = pacer_.wake();
    return std::exchange(actions_, {});
}

}  // namespace echoloop::ping1d
