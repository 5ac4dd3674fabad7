#include "emulator/devices/edgetech-2205/edgetech_2205.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace echoloop::edgetech_2205 {

using edgetech::Command, edgetech::Type;

namespace {

enum PortIndex : std::size_t { command_port, data_port };
enum Trigger : std::uint32_t { internal, external, coupled };

constexpr std::uint8_t first_subsystem = edgetech::low_frequency;

/// 0 low, 1 high; nothing of a subsystem that is not there.
std::optional<std::size_t> band_of(std::uint32_t subsystem) {
    if (subsystem != edgetech::low_frequency && subsystem != edgetech::high_frequency) return std::nullopt;
    return subsystem - first_subsystem;
}

/// The member of a subsystem that a type of message sets as it is.
std::uint32_t Subsystem::*plain_setting(Type type) {
    switch (type) {
        case Type::trigger:
            return &Subsystem::trigger;
        case Type::pulse_select:
            return &Subsystem::pulse_select;
        case Type::ping_gain:
            return &Subsystem::ping_gain;
        case Type::gain_control:
            return &Subsystem::gain_control;
        default:
            return nullptr;
    }
}

}  // namespace

Edgetech2205::Edgetech2205(const Settings& settings)
    : settings_(settings), motion_(settings.sensors, settings.origin.value_or(GeoPlace{})) {
    for (const std::size_t band : {0U, 1U}) {
        const bool begins =
            settings.start == Start::both || settings.start == (band == 0 ? Start::low : Start::high);
        bands_[band].pings = begins;
        bands_[band].active = {begins, begins};
    }
}

std::vector<Port> Edgetech2205::ports() const {
    return {{"commands", Port::Kind::stream, {}, false}, {"data", Port::Kind::stream, {}, false}};
}

Actions Edgetech2205::started(Time now) {
    plan(now);
    return take_actions();
}

void Edgetech2205::reconnected(std::size_t port) {
    if (port == command_port) framer_.clear();
}

Actions Edgetech2205::received(const Received& data, Time now) {
    if (data.port != command_port || off_) {
        counters_.skipped_bytes += data.bytes.size();
        return take_actions();
    }
    framer_.feed(data.bytes);
    while (const auto frame = framer_.next())
        if (const auto message = edgetech::parse(*frame)) obey(*message, now);
    plan(now);
    return take_actions();
}

void Edgetech2205::obey(const edgetech::Message& message, Time now) {
    const edgetech::Header& header = message.header;
    if (header.command == Command::get) {
        const auto body = get(header, now);
        ++(body ? counters_.messages : counters_.rejected);
        return answer(header, body ? Command::reply : Command::error, body.value_or(edgetech::Unread{}));
    }
    const bool understood = header.command == Command::set && set(message, now);
    ++(understood ? counters_.messages : counters_.rejected);
    if (!understood) return answer(header, Command::error, edgetech::Unread{});
    if (settings_.replies_to_sets && !off_) answer(header, Command::reply, message.body);
}

void Edgetech2205::answer(edgetech::Header header, Command command, const edgetech::Body& body) {
    header.command = command;
    header.version = settings_.version;
    actions_.send.push_back({command_port, edgetech::encode({header, body}), {}, {}});
}

/// False if it is not understood.
bool Edgetech2205::set(const edgetech::Message& message, Time now) {
    const edgetech::Header& header = message.header;
    if (header.type == Type::alive) return true;
    if (const auto* time = std::get_if<edgetech::SystemTime>(&message.body)) {
        clock_offset_ += time->seconds + 1e-3 * (time->milliseconds % 1000) - unix_time(now);
        return header.type == Type::system_time;
    }
    const auto* setting = std::get_if<edgetech::Setting>(&message.body);
    if (header.type == Type::shutdown && setting != nullptr) {
        if (setting->value != 0) shut_down();
        return true;
    }
    const auto band = band_of(header.subsystem);
    if (!band) return false;
    Subsystem& subsystem = bands_[*band];
    if (const auto* coupling = std::get_if<edgetech::Coupling>(&message.body)) {
        const auto source = band_of(coupling->source);
        if (!source || *source == *band || coupling->divider == 0) return false;
        subsystem.source = coupling->source;
        subsystem.divider = coupling->divider;
        subsystem.delay = coupling->delay;
        return true;
    }
    if (setting == nullptr) return false;
    if (auto member = plain_setting(header.type)) {
        subsystem.*member = setting->value;
        return true;
    }
    switch (header.type) {
        case Type::data_active:
            if (header.channel > starboard_side) return false;
            subsystem.active[header.channel] = setting->value != 0;
            return true;
        case Type::ping:
            subsystem.pings = setting->value != 0;
            return true;
        case Type::range:
            subsystem.range = limited_range(setting->value, *band);
            return true;
        default:
            return false;
    }
}

std::optional<edgetech::Body> Edgetech2205::get(const edgetech::Header& header, Time now) const {
    if (header.type == Type::alive) return edgetech::Unread{};
    if (header.type == Type::system_time) {
        edgetech::SonarData time;
        stamp(time, unix_time(now));
        return edgetech::SystemTime{static_cast<std::uint32_t>(time.seconds), time.milliseconds};
    }
    const auto band = band_of(header.subsystem);
    if (!band) return std::nullopt;
    const Subsystem& subsystem = bands_[*band];
    if (const auto member = plain_setting(header.type)) return edgetech::Setting{subsystem.*member};
    switch (header.type) {
        case Type::coupling:
            return edgetech::Coupling{subsystem.source, subsystem.divider, subsystem.delay};
        case Type::data_active:
            if (header.channel > starboard_side) return std::nullopt;
            return edgetech::Setting{subsystem.active[header.channel]};
        case Type::ping:
            return edgetech::Setting{subsystem.pings};
        case Type::range:
            return edgetech::Setting{subsystem.range};
        default:
            return std::nullopt;
    }
}

/// As it is after the power comes back: a vehicle would switch it off now, and on again.
void Edgetech2205::shut_down() {
    off_ = settings_.stays_off;
    bands_ = {};
    coupled_.reset();
    heard_.clear();
    pacer_.stop();
    for (const std::size_t port : {command_port, data_port}) {
        Send send;
        send.port = port;
        send.hang_up = true;
        actions_.send.push_back(std::move(send));
    }
}

bool Edgetech2205::pings_by_itself(std::size_t band) const {
    return bands_[band].pings && bands_[band].trigger == internal;
}

std::optional<std::size_t> Edgetech2205::next_band() const {
    if (coupled_) return coupled_;
    const std::size_t other = 1 - band_;
    if (pings_by_itself(other)) return other;
    return pings_by_itself(band_) ? std::optional(band_) : std::nullopt;
}

void Edgetech2205::plan(Time now) {
    if (!next_band()) return pacer_.pause();
    pacer_.start(now, from_seconds(shots_ == 0 ? 0 : ping_time(pinged_, settings_)));
}

void Edgetech2205::transmit(Time now) {
    band_ = next_band().value_or(band_);
    coupled_.reset();
    pinged_ = bands_[band_];
    pinged_.number = ++bands_[band_].number;
    const std::size_t other = 1 - band_;
    const Subsystem& follower = bands_[other];
    if (follower.pings && follower.trigger == coupled && band_of(follower.source) == band_ &&
        pinged_.number % follower.divider == 0)
        coupled_ = other;
    Shot shot = shot_from(pinged_, band_, settings_);
    shot.ping = ++shots_;
    actions_.ping = Ping{shot, now + from_seconds(ping_time(pinged_, settings_))};
}

Actions Edgetech2205::woken(Time now) {
    if (pacer_.begin(now)) transmit(now);
    return take_actions();
}

Actions Edgetech2205::heard(const Echogram& echogram, Time now) {
    if (!pacer_.under_way() || echogram.shot.ping != shots_) return take_actions();
    pacer_.end(now, from_seconds(ping_time(pinged_, settings_)));
    ++counters_.pings;
    const Time began = pacer_.began().value_or(now);
    heard_.clear();
    for (const std::size_t side : {port_side, starboard_side}) {
        edgetech::SonarData data = sonar_data(echogram, side, settings_, weightings_[band_][side]);
        if (!pinged_.active[side]) continue;
        describe_ping(data, pinged_, band_, settings_);
        stamp(data, unix_time(began));
        edgetech::Header header;
        header.version = settings_.version;
        header.subsystem = static_cast<std::uint8_t>(first_subsystem + band_);
        header.channel = static_cast<std::uint8_t>(side);
        heard_.push_back({header, std::move(data)});
    }
    plan(now);
    Actions actions = take_actions();
    actions.locate = {began};
    return actions;
}

Actions Edgetech2205::located(std::span<const Located> places, Time) {
    for (edgetech::Message& message : heard_) {
        auto& data = std::get<edgetech::SonarData>(message.body);
        if (settings_.navigation && !places.empty()) {
            if (&message == &heard_.front()) reading_ = motion_.read(places[0]);
            tell_place(data, reading_, -places[0].world_from_device.position.z, settings_.origin.has_value());
        }
        actions_.send.push_back({data_port, edgetech::encode(message), {}, {}});
    }
    heard_.clear();
    return take_actions();
}

DeviceCounters Edgetech2205::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes += framer_.skipped_bytes();
    return counters;
}

Actions Edgetech2205::take_actions() {
    actions_.wake = pacer_.wake();
    return std::exchange(actions_, {});
}

}  // namespace echoloop::edgetech_2205
