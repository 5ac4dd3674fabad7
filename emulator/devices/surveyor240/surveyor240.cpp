#include "emulator/devices/surveyor240/surveyor240.h"

#include <algorithm>
#include <utility>

#include "protocols/cerulean/surveyor_codec.h"

namespace echoloop::surveyor240 {
namespace {

namespace wire_messages = cerulean::surveyor;
using cerulean::Id;

constexpr Time look = std::chrono::milliseconds(50);  // for a look at the attitude between pings
constexpr Time patience = std::chrono::seconds(1);    // with a look that a busy machine is late with
constexpr Time water_period = std::chrono::seconds(1);
constexpr Time longest_wait = std::chrono::milliseconds(40);  // of a message behind others
constexpr float no_sensor = -1000;                            // the maker's definition

std::uint32_t milliseconds(Time time) {
    return static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
}

/// A first time `period` from now; never for a period of 0.
Time after(Time now, double period) { return period > 0 ? now + from_seconds(period) : Time::max(); }

}  // namespace

Surveyor240::Surveyor240(const Settings& settings, const std::vector<Endpoint>& endpoints)
    : settings_(settings),
      endpoints_(endpoints),
      ports_(cerulean_device::make_ports(endpoints, settings.identity)),
      pieces_(cerulean_device::pieces(endpoints, settings.identity)),
      link_(settings.identity.source, true),
      hosts_(endpoints.size()),
      free_from_(endpoints.size()),
      parameters_(default_parameters()) {
    // Looking straight down until the first echogram says better.
    pose_.orientation = from_rpy(0, deg_to_rad(90), 0);
    yz_.up_vec = up_vector(pose_, settings_);
    yz_.water_degC = yz_.water_bar = no_sensor;
}

Actions Surveyor240::started(Time now) {
    look_at_attitude(now);
    return take_actions();
}

Actions Surveyor240::received(const Received& data, Time now) {
    now_ = now;
    if (data.port >= endpoints_.size()) {  // discovery
        auto answer = cerulean_device::discovery_reply(data.bytes, endpoints_, settings_.identity);
        if (!answer.empty()) actions_.send.push_back({data.port, std::move(answer), data.from, {}});
        return take_actions();
    }
    for (const ping::Frame& frame : link_.receive(data).frames) obey(frame, {data.port, data.from}, now);
    return take_actions();
}

void Surveyor240::line_rate(std::size_t port, double rate) { settings_.identity.line.follow(port, rate); }

void Surveyor240::reconnected(std::size_t port) {
    if (port >= endpoints_.size()) return;
    link_.reset(port);
    hosts_.at(port).reset();
}

DeviceCounters Surveyor240::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes = link_.skipped_bytes();
    return counters;
}

/// The first word of a host: reports begin, and the time of day is asked for.
void Surveyor240::greet(const Peer& peer, Time now) {
    const bool first = !hosts_.at(peer.port);
    hosts_[peer.port] = peer.address;
    if (!first) return;
    if (next_attitude_ == Time::max()) next_attitude_ = after(now, settings_.attitude_period);
    if (next_water_ == Time::max() && (settings_.pressure_sensor || settings_.temperature > no_sensor))
        next_water_ = now + water_period;
    if (settings_.utc_request_period > 0) next_utc_request_ = now;
}

/// What a Surveyor does not know it drops without a word.
void Surveyor240::obey(const ping::Frame& frame, const Peer& peer, Time now) {
    greet(peer, now);
    const auto id = static_cast<std::uint16_t>(frame.header.id);
    if (wire_messages::Codec::is_short_request(frame) && send_message(id, peer)) {
        ++counters_.messages;
        return;
    }
    const auto parsed = wire_messages::Codec::parse(frame);
    if (!parsed) {
        ++counters_.rejected;
        return;
    }
    ++counters_.messages;
    std::visit(
        [&](const auto& message) {
            if constexpr (requires { on(message, peer, now); }) on(message, peer, now);
        },
        *parsed);
}

void Surveyor240::on(const ping::GeneralRequest& request, const Peer& peer, Time) {
    if (send_message(request.requested_id, peer)) return;
    ++counters_.rejected;
    const auto refused = cerulean_device::refused_id(settings_.identity, ping::Id{request.requested_id});
    reply(ping_device::nack(refused, "command not recognised"), peer);
}

void Surveyor240::on(const wire_messages::PingParameters& wanted, const Peer& peer, Time now) {
    const auto why = refusal(wanted, settings_);
    acknowledge(Id::surveyor_ping_parameters, why, peer);
    if (why) return;
    parameters_ = wanted;
    if (parameters_.ping_enable != 0)
        pacer_.start(now, period());
    else
        pacer_.stop();
}

void Surveyor240::on(const wire_messages::UtcResponse& response, const Peer&, Time now) {
    utc_at_power_up_ = response.utc_msec - milliseconds(now);
}

/// A time server is not asked; the host is.
void Surveyor240::on(const wire_messages::SetNetInfo&, const Peer& peer, Time) {
    acknowledge(Id::set_net_info, std::nullopt, peer);
}

void Surveyor240::acknowledge(Id id, std::optional<std::string_view> refusal, const Peer& peer) {
    const auto number = static_cast<std::uint16_t>(id);
    if (refusal) {
        ++counters_.rejected;
        reply(ping_device::nack(ping::Id{number}, *refusal), peer);
    } else if (settings_.identity.acknowledge) {
        reply(ping::Ack{number}, peer);
    }
}

bool Surveyor240::send_message(std::uint16_t id, const Peer& peer) {
    switch (Id{id}) {
        case Id::device_information:
            reply(cerulean_device::device_information(settings_.identity), peer);
            return true;
        case Id::protocol_version:
            reply(cerulean_device::protocol_version(settings_.identity), peer);
            return true;
        case Id::water_stats:
            reply(water(), peer);
            return true;
        case Id::attitude_report:
            reply(attitude(), peer);
            return true;
        case Id::yz_point_data:
            reply(yz_, peer);
            return true;
        case Id::atof_point_data:
            reply(atof_, peer);
            return true;
        default:
            return false;
    }
}

Time Surveyor240::period() const {
    return from_seconds(make_plan(parameters_, automatic_, settings_).period);
}

void Surveyor240::transmit(Time now) {
    plan_ = make_plan(parameters_, automatic_, settings_);
    transmitted_ = now;
    looking_.reset();  // the ping will tell
    const Time due = now + from_seconds(plan_.listening()) + from_seconds(settings_.processing_time);
    actions_.ping = Ping{make_shot(plan_, settings_, ++ping_), due};
}

void Surveyor240::look_at_attitude(Time now) {
    if (looking_ && now - *looking_ < patience) return;
    looking_ = now;
    actions_.ping = Ping{silent_shot(settings_), now + look};
}

Actions Surveyor240::heard(const Echogram& echogram, Time now) {
    now_ = now;
    if (echogram.shot.ping == 0) {
        if (!looking_) return take_actions();
        take_pose(echogram, *looking_);
        looking_.reset();
        if (next_attitude_ != Time::max()) tell(attitude());
        return take_actions();
    }
    if (!pacer_.under_way() || echogram.shot.ping != ping_) return take_actions();
    ++counters_.pings;
    take_pose(echogram, transmitted_);
    send_points(echogram);
    pacer_.end(now + settings_.identity.line.time(actions_.send), period());
    return take_actions();
}

void Surveyor240::send_points(const Echogram& echogram) {
    const auto points = find_points(echogram, settings_);
    const PingRecord record{plan_,  ping_, milliseconds(transmitted_), utc(transmitted_), up(transmitted_),
                            water()};
    atof_ = atof_message(record, points);
    yz_ = yz_message(record, points);
    if (plan_.atof) tell(atof_);
    if (plan_.yz) tell(yz_);
    double farthest = 0;
    for (const Point& point : points) farthest = std::max(farthest, slant_range(point, plan_));
    const float loudest = *std::max_element(echogram.values.begin(), echogram.values.end());
    automatic_ = follow(plan_, automatic_, farthest, level_db(loudest), settings_);
}

void Surveyor240::take_pose(const Echogram& echogram, Time at) {
    pose_ = echogram.world_from_sonar;
    pose_at_ = at;
}

std::array<float, 3> Surveyor240::up(Time at) const {
    const auto read = settings_.sensors.at(at);
    const auto [x, y, z] = up_vector(pose_, settings_);
    return {read("x", x, stray::acceleration), read("y", y, stray::acceleration),
            read("z", z, stray::acceleration)};
}

wire_messages::AttitudeReport Surveyor240::attitude() const {
    const Time at = pose_at_.value_or(Time{});
    return {up(at), {}, utc(at), milliseconds(at)};
}

wire_messages::WaterStats Surveyor240::water() const {
    const auto read = settings_.sensors.at(now_);
    constexpr double per_metre = 0.1;  // bar
    return {settings_.temperature > no_sensor ? read("water", settings_.temperature, stray::water_temperature)
                                              : no_sensor,
            settings_.pressure_sensor ? read("pressure", water_pressure(pose_), per_metre * stray::depth)
                                      : no_sensor};
}

std::uint64_t Surveyor240::utc(Time time) const {
    return utc_at_power_up_ ? *utc_at_power_up_ + milliseconds(time) : 0;
}

/// Pings tell the attitude where they are frequent; else it is looked at first.
bool Surveyor240::is_attitude_fresh(Time now) const {
    if (!pose_at_) return false;
    if (pacer_.under_way()) return true;
    const bool of_a_ping = parameters_.ping_enable != 0 && pose_at_ == transmitted_;
    return of_a_ping && now - *pose_at_ < from_seconds(1.5 * settings_.attitude_period);
}

void Surveyor240::report(Time now) {
    const bool alone = std::none_of(hosts_.begin(), hosts_.end(), [](const auto& host) { return !!host; });
    if (alone) next_attitude_ = next_water_ = next_utc_request_ = Time::max();
    if (now >= next_attitude_) {
        next_attitude_ = after(now, settings_.attitude_period);
        if (is_attitude_fresh(now))
            tell(attitude());
        else
            look_at_attitude(now);
    }
    if (now >= next_water_) {
        next_water_ = now + water_period;
        tell(water());
    }
    if (now >= next_utc_request_) {
        next_utc_request_ = after(now, settings_.utc_request_period);
        tell(wire_messages::UtcRequest{});
    }
}

Actions Surveyor240::woken(Time now) {
    now_ = now;
    report(now);
    if (pacer_.begin(now)) transmit(now);
    return take_actions();
}

void Surveyor240::reply(const wire_messages::Message& message, const Peer& to) { send(message, to, now_); }

void Surveyor240::tell(const wire_messages::Message& message) {
    for (std::size_t port = 0; port < hosts_.size(); ++port)
        if (hosts_[port])
            send(message, {port, *hosts_[port]}, std::clamp(free_from_[port], now_, now_ + longest_wait));
}

void Surveyor240::send(const wire_messages::Message& message, const Peer& to, Time when) {
    for (Send& one : link_.reply_in_pieces(message, to, pieces_.at(to.port))) {
        one.not_before = when;
        actions_.send.push_back(std::move(one));
    }
    Time& free_from = free_from_.at(to.port);
    free_from =
        std::max(when, std::min(free_from, now_ + longest_wait)) + from_seconds(settings_.datagram_gap);
}

Actions Surveyor240::take_actions() {
    actions_.wake = std::min({pacer_.wake(), next_attitude_, next_utc_request_, next_water_});
    return std::exchange(actions_, {});
}

}  // namespace echoloop::surveyor240
