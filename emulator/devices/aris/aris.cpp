#include "emulator/devices/aris/aris.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "emulator/devices/aris/date_time.h"
#include "emulator/devices/aris/version.h"
#include "protocols/aris/codec.h"

namespace echoloop::aris_device {
namespace {

enum PortIndex : std::size_t { command_port, beacon_port, frame_port };

Time period_of(const aris::SetAcoustics& acoustics) {
    return from_seconds(1 / static_cast<double>(acoustics.frame_rate));
}

std::optional<std::uint32_t> address_in(const std::string& text) {
    try {
        return read_ipv4(text);
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

}  // namespace

Aris::Aris(const Settings& settings, const Wiring& wiring)
    : settings_(settings),
      wiring_(wiring),
      clock_offset_(static_cast<std::int64_t>(settings.unix_start * 1e6)) {}

std::vector<Port> Aris::ports() const {
    return {{"commands", Port::Kind::stream, {}, false},
            {"beacon", Port::Kind::datagram, {wiring_.own.ip, 0}, false},
            {"frames", Port::Kind::datagram, {wiring_.own.ip, 0}, false}};
}

Actions Aris::started(Time now) {
    next_beacon_ = now;
    return take_actions();
}

/// Salinity, lens, focus and clock stay as they are; the rest is the next controller's to set.
void Aris::forget_controller() {
    framer_.clear();
    parts_.drop();
    control_ = {};
    pacer_.stop();
    next_silence_ = Time::max();
    connected_ = false;
    frame_.number = 0;  // receivers start anew with each connection, and drop numbers below one that they had
    peer_ = 0;
}

void Aris::reconnected(std::size_t port) {
    if (port != command_port) return;
    forget_controller();
    connected_ = true;
}

Actions Aris::connected(std::size_t port, Address peer, Time now) {
    if (port == command_port) {
        peer_ = peer.ip;
        expect_words(now);
    }
    return take_actions();
}

void Aris::expect_words(Time now) {
    if (settings_.silence_limit > 0) next_silence_ = now + from_seconds(settings_.silence_limit);
}

Actions Aris::disconnected(std::size_t port, Address, Time) {
    if (port == command_port) forget_controller();
    return take_actions();
}

Actions Aris::received(const Received& data, Time now) {
    if (data.port == frame_port) take_ack(data.bytes);
    if (data.port != command_port) return take_actions();
    connected_ = true;
    expect_words(now);
    framer_.feed(data.bytes);
    while (const auto command = framer_.next()) obey(*command, now);
    return take_actions();
}

/// Without effect, as on the real one.
void Aris::take_ack(ByteView bytes) {
    ++(aris::parse_frame_part_ack(bytes) ? counters_.messages : counters_.rejected);
}

void Aris::obey(const aris::Command& command, Time now) {
    using Type = aris::CommandType;
    bool good = true;
    switch (static_cast<Type>(command.type)) {
        case Type::set_date_time:
            good = set_clock(command.date_time->text, now);
            break;
        case Type::set_receiver:
            good = set_receiver(*command.receiver);
            break;
        case Type::set_stream:
            control_.delay = command.stream->delay.value_or(aris::PacketDelay{});
            break;
        case Type::set_acoustics:
            good = set_acoustics(*command.acoustics);
            break;
        case Type::set_salinity:
            good = set_salinity(command.salinity->salinity);
            break;
        case Type::set_telephoto:
            good = set_telephoto(command.telephoto->telephoto);
            break;
        case Type::set_focus:
            good = set_focus(*command.focus, now);
            break;
        case Type::home_focus:
            focus_.go(0, now);
            break;
        default:  // rotator, log, ping: nothing to hear of them
            break;
    }
    ++(good ? counters_.messages : counters_.rejected);
    plan_next_frame(now);
}

bool Aris::set_clock(const std::string& text, Time now) {
    const auto seconds = read_date_time(text);
    if (seconds) clock_offset_ = *seconds * 1'000'000 - now.count() / 1000;
    return seconds.has_value();
}

/// A sonar on a loopback address sends to loopback only.
bool Aris::set_receiver(const aris::SetReceiver& wish) {
    const bool own_loopback = is_loopback(wiring_.own.ip);
    const std::uint32_t fallback = settings_.controller != 0 ? settings_.controller : peer_;
    const auto ip = wish.ip.empty() ? std::optional(fallback) : address_in(wish.ip);
    if (ip == 0U && !wish.ip.empty()) {
        control_.receiver.reset();
        parts_.drop();
        return true;
    }
    const bool reachable = ip && *ip != 0 && (!own_loopback || is_loopback(*ip));
    if (!reachable || wish.port == 0 || wish.port > 65535) return false;
    control_.receiver = {*ip, static_cast<std::uint16_t>(wish.port)};
    return true;
}

/// Settings that are refused leave the last ones in force.
bool Aris::set_acoustics(const aris::SetAcoustics& wish) {
    if (!is_valid(wish, settings_)) {
        control_.cookies.invalid = wish.cookie;
        return false;
    }
    control_.acoustics = constrained(wish, settings_);
    const bool as_they_are = *control_.acoustics == wish;
    (as_they_are ? control_.cookies.applied : control_.cookies.constrained) = wish.cookie;
    return true;
}

bool Aris::set_salinity(std::uint32_t salinity) {
    if (salinity != 0 && salinity != 15 && salinity != 35) return false;
    salinity_ = salinity;
    return true;
}

/// Made for 48 and 96 beams.
bool Aris::set_telephoto(bool telephoto) {
    if (telephoto && settings_.variant.system_type == aris::system_type::aris3000) return false;
    telephoto_ = telephoto;
    return true;
}

/// By range, or by the position of older software where there is none.
bool Aris::set_focus(const aris::SetFocus& wish, Time now) {
    if (!std::isfinite(wish.range) || wish.range < 0) return false;
    const bool is_3000 = settings_.variant.system_type == aris::system_type::aris3000;
    const Lens lens = telephoto_ ? Lens::telephoto : is_3000 ? Lens::aris_3000 : Lens::aris_1200_1800;
    const auto range = static_cast<double>(wish.range);
    focus_.go(range > 0 ? focus_position(range, lens, salinity_) : wish.position, now);
    return true;
}

/// Not before the parts of the last frame have gone when those of the next one come.
void Aris::plan_next_frame(Time now) {
    if (!control_.acoustics || !control_.receiver) return pacer_.pause();
    pacer_.start(now, period_of(*control_.acoustics));
    pacer_.hold(parts_.out() - from_seconds(frame_time(*control_.acoustics)));
}

void Aris::transmit(Time now) {
    const aris::SetAcoustics& acoustics = *control_.acoustics;
    frame_ = {frame_.number + 1,
              acoustics,
              telephoto_,
              salinity_,
              control_.cookies,
              control_.delay,
              focus_,
              now,
              static_cast<std::uint64_t>(clock_offset_ + now.count() / 1000)};
    const Time heard = from_seconds(frame_time(acoustics) + settings_.processing_time);
    const Time due = now + std::min(heard, period_of(acoustics));
    actions_.ping = Ping{make_shot(acoustics, telephoto_, settings_, ++pings_), due};
    actions_.ping->shot.interval = interval(now, due);
}

double Aris::interval(Time now, Time due) const {
    const auto parts = static_cast<Time::rep>(part_count(frame_, settings_));
    const Time out = std::max(due, parts_.out()) + parts * from_seconds(part_delay(frame_, settings_));
    return std::max(1 / static_cast<double>(frame_.acoustics.frame_rate),
                    to_seconds(out - now) - frame_time(frame_.acoustics));
}

Actions Aris::heard(const Echogram& echogram, Time now) {
    const bool expected = pacer_.under_way() && echogram.shot.ping == pings_ &&
                          echogram.shot.bins == frame_.acoustics.samples &&
                          echogram.beams() == frame_.beams();
    if (!expected) return take_actions();
    pacer_.end(now, {});
    ++counters_.pings;
    if (control_.receiver) send_frame(echogram, now);
    plan_next_frame(now);
    return take_actions();
}

void Aris::send_frame(const Echogram& echogram, Time now) {
    std::vector<Send> parts;
    for (Bytes& part : make_parts(frame_, settings_, echogram))
        parts.push_back({frame_port, std::move(part), *control_.receiver, {}});
    parts_.add(std::move(parts), now, from_seconds(part_delay(frame_, settings_)));
    parts_.hand_over(now, actions_.send);
}

void Aris::send_beacon(Time now) {
    aris::Availability beacon;
    beacon.serial = settings_.serial;
    beacon.system_type = settings_.variant.system_type;
    beacon.version = {version_major, version_minor, version_build};
    beacon.state = connected_ ? aris::connection_state::busy : aris::connection_state::available;
    beacon.capabilities = {{"KA"}};
    beacon.link = settings_.ethernet;
    beacon.cpu_temperature = static_cast<float>(
        settings_.sensors.read("CPU", settings_.temperature, stray::board_temperature, now));
    if (settings_.voyager) beacon.variants = {{"VG"}};
    actions_.send.push_back({beacon_port, aris::encode(beacon), wiring_.beacon, {}});
}

Actions Aris::woken(Time now) {
    if (now >= next_beacon_) {
        next_beacon_ = now + from_seconds(settings_.beacon_period);
        send_beacon(now);
    }
    if (now >= next_silence_) {
        forget_controller();
        actions_.send.push_back({command_port, {}, {}, {}, true});
    }
    parts_.hand_over(now, actions_.send);
    if (pacer_.begin(now)) transmit(now);
    return take_actions();
}

DeviceCounters Aris::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes = framer_.skipped_bytes();
    return counters;
}

Actions Aris::take_actions() {
    actions_.wake = std::min({pacer_.wake(), next_beacon_, next_silence_, parts_.wake()});
    return std::exchange(actions_, {});
}

}  // namespace echoloop::aris_device
