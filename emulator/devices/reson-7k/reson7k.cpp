#include "emulator/devices/reson-7k/reson7k.h"

#include <algorithm>
#include <utility>

namespace echoloop::reson7k_device {
namespace {

using reson7k::ErrorCode;
using reson7k::RemoteControl;

constexpr std::uint32_t centre = 7000;  // device id of the sonar's control centre
constexpr std::uint32_t configuration = reson7k::Configuration::type;
constexpr std::uint32_t settings_record = reson7k::RemoteSettings::type;

bool is_about_records(std::uint32_t command) {
    return command >= command::request && command <= command::unsubscribe;
}

}  // namespace

Reson7k::Reson7k(const Settings& settings, Address own)
    : settings_(settings), own_(own), controls_(settings.start) {}

std::vector<Port> Reson7k::ports() const {
    constexpr std::size_t hosts = 8;  // own choice: how many a real one takes is not known
    return {{"stream", Port::Kind::stream, {}, false, hosts},
            {"datagrams", Port::Kind::datagram, own_, false}};
}

Actions Reson7k::started(Time now) {
    plan_next_ping(now);
    return take_actions();
}

/// Closing the connection ends its subscriptions.
Actions Reson7k::disconnected(std::size_t port, Address peer, Time) {
    if (port != stream_port) return take_actions();
    if (const auto left = framers_.extract(peer)) counters_.skipped_bytes += left.mapped().skipped_bytes();
    subscribers_.end({stream_port, peer});
    return take_actions();
}

Actions Reson7k::received(const Received& data, Time now) {
    if (data.port == datagram_port) {
        reson7k::Framer framer(reson7k::host_record, reson7k::Source::network);
        framer.feed(data.bytes);
        framer.finish();
        while (const auto record = framer.next()) hear_record(*record, {datagram_port, data.from}, now);
        counters_.skipped_bytes += framer.skipped_bytes();
    } else {
        auto& framer =
            framers_.try_emplace(data.from, reson7k::host_record, reson7k::Source::network).first->second;
        framer.feed(data.bytes);
        while (const auto record = framer.next()) hear_record(*record, {stream_port, data.from}, now);
    }
    return take_actions();
}

/// Every command is answered. Two records set the time-varied gain, from whatever device they say that they
/// are; others are for nobody here.
void Reson7k::hear_record(const reson7k::Record& record, const Peer& from, Time now) {
    const auto message = reson7k::parse(record);
    const auto* control = message ? std::get_if<RemoteControl>(&*message) : nullptr;
    if (control == nullptr) {
        const bool taken = message && apply_record(*message, controls_);
        ++(taken ? counters_.messages : counters_.rejected);
        return;
    }
    const bool named = record.frame.device == settings_.device && record.frame.enumerator == 0;
    const bool to_centre = record.frame.device == centre && is_about_records(control->command);
    const Refusal refusal = obey(*control, from, named || to_centre || settings_.any_device, now);
    ++(refusal ? counters_.rejected : counters_.messages);
    const auto frame = frame_of(settings_, unix_time(now));
    if (refusal)
        send(reson7k::NotAcknowledge{control->ticket, control->tracking, *refusal}, frame, from);
    else
        send(reson7k::Acknowledge{control->ticket, control->tracking}, frame, from);
    if (!refusal && control->command == command::request) answer_request(*word_at(*control, 0), from, now);
}

Refusal Reson7k::obey(const RemoteControl& control, const Peer& from, bool named, Time now) {
    if (!named) return ErrorCode::bad_device;
    if (control.command == command::request) return check_request(control);
    if (is_about_records(control.command)) return subscribe(control, from);
    const Refusal refusal = apply(control, settings_.acoustics, controls_);
    if (!refusal) plan_next_ping(now);
    return refusal;
}

Refusal Reson7k::subscribe(const RemoteControl& control, const Peer& from) {
    std::set<std::uint32_t> types;
    const bool addressed = word_at(control, 0).has_value();
    if (settings_.ends_by_third_party ? control.command == command::add_receiver && !addressed
                                      : control.command == command::end_all) {
        subscribers_.end(from);
        return std::nullopt;
    }
    switch (control.command) {
        case command::add_receiver:
        case command::delete_receiver:
            return change_receiver(control);
        case command::subscribe:
        case command::unsubscribe:
            if (const Refusal refusal = read_types(control, 0, types)) return refusal;
            break;
        case command::subscribe_range: {
            const auto first = word_at(control, 0), last = word_at(control, 4);
            if (!first || !last || *last < *first) return ErrorCode::invalid;
            for (const std::uint32_t type : ping_records())
                if (type >= *first && type <= *last) types.insert(type);
            break;
        }
        default:
            return ErrorCode::unknown_command;
    }
    if (control.command == command::unsubscribe)
        subscribers_.remove(from, types);
    else if (!types.empty() && !subscribers_.add(from, types))
        return ErrorCode::denied;
    return types.empty() ? Refusal(ErrorCode::no_such_record) : std::nullopt;
}

/// Record types behind their number at `at`. Those that this sonar never sends are passed over.
Refusal Reson7k::read_types(const RemoteControl& control, std::size_t at,
                            std::set<std::uint32_t>& types) const {
    const auto count = word_at(control, at);
    if (!count || *count > (control.parameters.size() - at - 4) / 4) return ErrorCode::invalid;
    for (std::uint32_t i = 0; i < *count; ++i) {
        const std::uint32_t type = *word_at(control, at + 4 + 4 * i);
        const auto known = ping_records();
        if (std::find(known.begin(), known.end(), type) != known.end()) types.insert(type);
    }
    return std::nullopt;
}

/// A host elsewhere that gets records by UDP. A sonar on loopback sends to loopback only, and connects to
/// nobody by TCP.
Refusal Reson7k::change_receiver(const RemoteControl& control) {
    constexpr std::size_t address_size = 8;
    const auto ip = word_at(control, 0), rest = word_at(control, 4);
    if (!ip || !rest) return ErrorCode::invalid;
    const auto port = static_cast<std::uint16_t>(*rest);
    if (*ip == 0 || port == 0) return ErrorCode::invalid;
    const bool by_tcp = *rest >> 16 != 0;
    if (by_tcp || (is_loopback(own_.ip) && !is_loopback(*ip))) return ErrorCode::denied;
    const Peer peer{datagram_port, {*ip, port}};
    if (control.command == command::delete_receiver)
        return subscribers_.end(peer) ? std::nullopt : Refusal(ErrorCode::invalid);
    std::set<std::uint32_t> types;
    if (const Refusal refusal = read_types(control, address_size, types)) return refusal;
    if (types.empty()) return ErrorCode::no_such_record;
    return subscribers_.add(peer, types) ? std::nullopt : Refusal(ErrorCode::denied);
}

Refusal Reson7k::check_request(const RemoteControl& control) const {
    const auto type = word_at(control, 0);
    if (!type) return ErrorCode::invalid;
    if (*type == configuration || *type == settings_record || *type == reson7k::BeamGeometry::type)
        return std::nullopt;
    const auto known = ping_records();
    const bool streamed = std::find(known.begin(), known.end(), *type) != known.end();
    return streamed ? ErrorCode::subscription_only : ErrorCode::no_such_record;
}

void Reson7k::answer_request(std::uint32_t type, const Peer& to, Time now) {
    const auto frame = frame_of(settings_, unix_time(now));
    if (type == configuration) return send(make_configuration(settings_), frame, to);
    if (type == reson7k::BeamGeometry::type) return send(make_geometry(controls_, settings_), frame, to);
    PingRecord current = ping_;
    current.controls = controls_;
    current.number = 0;
    if (ping_.number == 0) current.since_last = ping_period(controls_, settings_);
    send(make_remote_settings(current, settings_), frame, to);
}

void Reson7k::plan_next_ping(Time now) {
    if (!controls_.pinging || controls_.max_rate <= 0) return pacer_.pause();
    pacer_.start(now, from_seconds(ping_period(controls_, settings_)));
}

void Reson7k::transmit(Time now) {
    // Readers divide by it: the first ping has the time to the next one.
    const double since =
        ping_.number > 0 ? to_seconds(now - transmitted_) : ping_period(controls_, settings_);
    transmitted_ = now;
    ping_ = {controls_, ping_.number + 1, unix_time(now) + controls_.pulse, since};
    const double due = range_time(controls_) + settings_.processing_time;
    actions_.ping = Ping{make_shot(controls_, settings_, ping_.number), now + from_seconds(due)};
}

Actions Reson7k::heard(const Echogram& echogram, Time now) {
    const bool expected = pacer_.under_way() && echogram.shot.ping == ping_.number &&
                          echogram.beams() == settings_.beams && echogram.shot.bins > 0;
    if (!expected) return take_actions();
    pacer_.end(now, {});
    ++counters_.pings;
    for (const std::uint32_t type : ping_records())
        if (subscribers_.wanted(type)) publish(type, echogram);
    pace(now);
    plan_next_ping(now);
    return take_actions();
}

/// One record of the ping to all who have subscribed to it.
void Reson7k::publish(std::uint32_t type, const Echogram& echogram) {
    const auto make = [&]() -> reson7k::Message {
        switch (type) {
            case reson7k::SonarSettings::type:
                return make_settings(ping_, settings_);
            case reson7k::RemoteSettings::type:
                return make_remote_settings(ping_, settings_);
            case reson7k::BeamGeometry::type:
                return make_geometry(ping_.controls, settings_);
            case reson7k::RawDetections::type:
                return make_detections(ping_, settings_, echogram);
            case reson7k::Image::type:
                return make_image(ping_, settings_, echogram);
            case reson7k::Beamformed::type:
                return make_beamformed(ping_, settings_, echogram);
            default:
                return make_water_column(ping_, settings_, echogram);
        }
    };
    const Bytes record = reson7k::encode(make(), frame_of(settings_, ping_.time));
    for (const auto& entry : subscribers_.entries())
        if (entry.types.contains(type)) send_record(record, entry.peer);
}

/// Spreads the datagrams of a ping to all hosts, but never beyond the next ping, however many they are. Those
/// of two pings do not mix.
void Reson7k::pace(Time now) {
    auto& sends = actions_.send;
    const auto first = std::stable_partition(sends.begin(), sends.end(),
                                             [](const Send& one) { return one.port != datagram_port; });
    if (first == sends.end()) return;
    const Time end = now + from_seconds(0.8 * ping_period(controls_, settings_));
    datagrams_until_ = spread({first, sends.end()}, std::max(now, datagrams_until_),
                              from_seconds(settings_.datagram_gap), end);
}

void Reson7k::send(const reson7k::Message& message, const reson7k::RecordFrame& frame, const Peer& to) {
    send_record(reson7k::encode(message, frame), to);
}

/// An answer by UDP waits for the datagrams that are under way: readers drop a record whose packets another
/// one parts.
void Reson7k::send_record(ByteView record, const Peer& to) {
    const Time when = to.port == datagram_port ? datagrams_until_ : Time{};
    auto packets = reson7k::packets_of(record, ++transmission_, settings_.device);
    for (Bytes& packet : packets) actions_.send.push_back({to.port, std::move(packet), to.address, when});
}

Actions Reson7k::woken(Time now) {
    if (pacer_.begin(now)) transmit(now);
    return take_actions();
}

DeviceCounters Reson7k::counters() const {
    DeviceCounters counters = counters_;
    for (const auto& [host, framer] : framers_) counters.skipped_bytes += framer.skipped_bytes();
    return counters;
}

Actions Reson7k::take_actions() {
    actions_.wake = pacer_.wake();
    return std::exchange(actions_, {});
}

}  // namespace echoloop::reson7k_device
