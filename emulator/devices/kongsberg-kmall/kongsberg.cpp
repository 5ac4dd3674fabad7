#include "emulator/devices/kongsberg-kmall/kongsberg.h"

#include <algorithm>
#include <utility>

#include "protocols/kmall/codec.h"

namespace echoloop::kongsberg_kmall {
namespace {

constexpr Time processing = std::chrono::milliseconds(5);  // from the last sample to the datagram

// Numbers of the controller's texts.
constexpr unsigned stop = 457, start = 458, water_column_off = 460, water_column_on = 461;

/// By the name that its controller gives it, with the system's number or without, or by its number alone.
bool is_named(const std::string& name, const Settings& settings) {
    const std::string number = std::to_string(settings.sounder), model = "EM" + number;
    return name == model + '_' + std::to_string(settings.system_id) || name == model || name == number;
}

}  // namespace

Kongsberg::Kongsberg(const Settings& settings, const Wiring& wiring) : settings_(settings), wiring_(wiring) {}

std::vector<Port> Kongsberg::ports() const {
    return {{"commands", Port::Kind::datagram, wiring_.own, false}};
}

Actions Kongsberg::started(Time now) {
    plan_next_ping(now);
    return take_actions();
}

Actions Kongsberg::received(const Received& data, Time now) {
    const auto datagram = kmall::parse(data.bytes);
    const auto* command = datagram ? std::get_if<kmall::Command>(&*datagram) : nullptr;
    if (command == nullptr)
        ++counters_.rejected;
    else if (is_named(command->sounder, settings_))
        obey(*command, now);
    return take_actions();
}

/// Other numbers, and texts to other sounders, are passed over.
void Kongsberg::obey(const kmall::Command& command, Time now) {
    ++counters_.messages;
    if (command.number == stop || command.number == start) settings_.pinging = command.number == start;
    if (command.number == water_column_off || command.number == water_column_on)
        settings_.water_column = command.number == water_column_on;
    if (!ping_under_way_) plan_next_ping(now);
}

void Kongsberg::plan_next_ping(Time now) {
    const Time earliest = pings_begun_ > 0 ? transmitted_ + from_seconds(ping_period(settings_)) : now;
    next_ping_ = settings_.pinging ? std::max(now, earliest) : Time::max();
}

void Kongsberg::transmit(Time now) {
    next_ping_ = Time::max();
    ping_under_way_ = true;
    ping_.period = pings_begun_ > 0 ? to_seconds(now - transmitted_) : 0;
    ping_.number = static_cast<std::uint16_t>(++pings_begun_);
    ping_.time = settings_.unix_start + to_seconds(now);
    transmitted_ = now;
    actions_.ping =
        Ping{make_shot(settings_, pings_begun_), now + from_seconds(range_time(settings_)) + processing};
}

Actions Kongsberg::heard(const Echogram& echogram, Time now) {
    if (!ping_under_way_ || echogram.shot.ping != pings_begun_) return take_actions();
    ping_under_way_ = false;
    ++counters_.pings;
    const Shot& shot = echogram.shot;
    const multibeam::TimeGate window{0, static_cast<double>(shot.bins) * shot.bin_interval};
    const std::vector<multibeam::TimeGate> gates(echogram.beams(), window);
    const auto detections = multibeam::detect(
        echogram, gates, {.margin = settings_.detection_margin, .echoes_last = settings_.echoes_last});
    send(make_mrz(ping_, settings_, echogram, detections), now);
    if (settings_.water_column) send(make_mwc(ping_, settings_, echogram, detections), now);
    plan_next_ping(now);
    return take_actions();
}

/// The parts of a big datagram are spread over time, but never beyond the next ping.
void Kongsberg::send(const kmall::Datagram& datagram, Time now) {
    auto parts = kmall::divided(kmall::serialise(datagram));
    const double room = 0.8 * ping_period(settings_) / static_cast<double>(parts.size());
    const Time gap = from_seconds(std::min(settings_.datagram_gap, room));
    Time when = now;
    for (Bytes& part : parts) {
        actions_.send.push_back({0, std::move(part), wiring_.host, when});
        when += gap;
    }
}

Actions Kongsberg::woken(Time now) {
    if (now >= next_ping_) transmit(now);
    return take_actions();
}

Actions Kongsberg::take_actions() {
    actions_.wake = next_ping_;
    return std::exchange(actions_, {});
}

}  // namespace echoloop::kongsberg_kmall
