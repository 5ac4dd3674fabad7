#include "emulator/devices/kongsberg-kmall/kongsberg.h"

#include <algorithm>
#include <utility>

#include "emulator/devices/kongsberg-kmall/controls.h"
#include "emulator/devices/kongsberg-kmall/records.h"
#include "protocols/kmall/codec.h"

namespace echoloop::kongsberg_kmall {
namespace {

constexpr std::string_view text_ends{"\r\n\0", 3};

constexpr Time texts_interval = std::chrono::seconds(1);  // of 616; that of the others is own choice

/// m/s, of the probe at the head: values of real systems lie 3 to 8 mm/s apart.
Stray probe_of(const Settings& settings) {
    return {.drift = 0.05, .noise = 0.004, .every = settings.probe_interval};
}

// Numbers of the texts to the controller, and of one of its own.
constexpr unsigned choose = 13, ready = 39, get_values = 261, set_values_number = 262,
                   send_records_again = 454, stop = 457, start = 458, water_column_off = 460,
                   water_column_on = 461;

/// By the name that its controller gives it, with the system's number or without, or by its number alone.
bool is_named(const std::string& name, const Settings& settings) {
    const std::string number = std::to_string(settings.sounder);
    return name == sounder_name(settings) || name == "EM" + number || name == number;
}

}  // namespace

Kongsberg::Kongsberg(const Settings& settings, const Wiring& wiring)
    : settings_(settings),
      wiring_(wiring),
      started_(settings.pinging),
      profile_(even_profile(settings)),
      sensors_(settings) {}

std::vector<Port> Kongsberg::ports() const {
    return {{"commands", Port::Kind::datagram, wiring_.own, false}};
}

Actions Kongsberg::started(Time now) {
    if (wiring_.controller) tell_standing(now);
    plan_next_ping(now);
    return take_actions();
}

Actions Kongsberg::received(const Received& data, Time now) {
    const auto datagram = kmall::parse(data.bytes);
    const auto* command = datagram ? std::get_if<kmall::Command>(&*datagram) : nullptr;
    const auto* sound = datagram ? std::get_if<kmall::SoundText>(&*datagram) : nullptr;
    if (sound != nullptr)
        obey(*sound, now);
    else if (command == nullptr)
        ++counters_.rejected;
    else if (is_named(command->sounder, settings_))
        obey(*command, now);
    return take_actions();
}

/// S00 to S02 are used at once, and a new #SVP says so; S10 to S22 wait for an operator, who is not here.
void Kongsberg::obey(const kmall::SoundText& text, Time now) {
    using Later = Settings::LaterProfiles;
    const auto reading = kmall::read_sound_text(text);
    const bool later = reading && reading->format[1] != '0';
    if (!reading || (later && settings_.later_profiles == Later::refused)) {
        ++counters_.rejected;
        return;
    }
    ++counters_.messages;
    if (later && settings_.later_profiles == Later::stored) return;
    profile_ = profile_of(*reading, settings_);
    send_profile(now);
}

/// Other numbers, and texts to other sounders, are passed over.
void Kongsberg::obey(const kmall::Command& command, Time now) {
    ++counters_.messages;
    if (command.number == choose || command.number == start) started_ = true;
    if (command.number == choose) tell({ready, sounder_name(settings_), ""});
    if (command.number == set_values_number) set_values(command.arguments);
    if (command.number == get_values || command.number == set_values_number) tell(values(settings_));
    if (command.number == send_records_again) send_records(now);
    if (command.number == stop || command.number == start) settings_.pinging = command.number == start;
    if (command.number == water_column_off || command.number == water_column_on)
        settings_.water_column = command.number == water_column_on;
    plan_next_ping(now);
}

void Kongsberg::set_values(std::string_view assignments) {
    assignments = assignments.substr(0, assignments.find_first_of(text_ends));
    assignments = assignments.substr(0, assignments.find_last_not_of(' ') + 1);
    while (!assignments.empty()) {
        assignments.remove_prefix(1);  // the comma
        const std::size_t end = std::min(assignments.find(','), assignments.size());
        if (!set_value(assignments.substr(0, end), settings_)) ++counters_.rejected;
        assignments.remove_prefix(end);
    }
}

void Kongsberg::send_records(Time now) {
    const PingRecord at{.number = 0, .time = unix_time(now), .period = 0};
    const kmall::Header header = make_header(at, settings_, "", 0);
    send(make_installation(header, settings_, water_level_), now);
    send(make_runtime(header, settings_), now);
    send_profile(now);
}

void Kongsberg::send_profile(Time now) {
    const PingRecord at{.number = 0, .time = unix_time(now), .period = 0};
    kmall::SoundProfile profile = profile_;
    profile.header = make_header(at, settings_, "#SVP", 1);
    send(profile, now);
}

void Kongsberg::tell(const kmall::Command& text) {
    if (wiring_.controller) actions_.send.push_back({0, kmall::serialise(text), *wiring_.controller, {}});
}

void Kongsberg::tell_standing(Time now) {
    next_texts_ = now + texts_interval;
    tell(found(settings_, standing()));
    tell(unit_found(settings_, standing(), unix_time(now)));
    tell(data_address(settings_, standing()));
    if (started_) tell(status(settings_, standing()));
}

void Kongsberg::plan_next_ping(Time now) {
    if (settings_.pinging)
        pacer_.start(now, from_seconds(ping_period(settings_)));
    else
        pacer_.pause();
}

void Kongsberg::transmit_if_due(Time now) {
    const auto before = pacer_.began();
    if (!pacer_.begin(now)) return;
    ping_.period = before ? to_seconds(*pacer_.began() - *before) : 0;
    ping_.number = static_cast<std::uint16_t>(++pings_begun_);
    ping_.time = unix_time(now);
    ping_settings_ = settings_;
    const Time last_echo = now + from_seconds(range_time(settings_));
    actions_.ping =
        Ping{make_shot(settings_, pings_begun_), last_echo + from_seconds(settings_.processing_time)};
}

Actions Kongsberg::heard(const Echogram& echogram, Time now) {
    if (echogram.shot.ping != pings_begun_ || !pacer_.end(now, {})) return take_actions();
    ++counters_.pings;
    const Shot& shot = echogram.shot;
    const multibeam::TimeGate window{0, static_cast<double>(shot.bins) * shot.bin_interval};
    const std::vector<multibeam::TimeGate> gates(echogram.beams(), window);
    // Of the head's own sensor, where it was when it last measured.
    const Stray probe = probe_of(settings_);
    settings_.sound_speed = probe_.of(echogram.sound_speed, settings_.sensors, probe, now);
    Settings s = ping_settings_;
    s.sound_speed = s.sensors.read("sound speed", settings_.sound_speed, probe, now);
    const auto detections = multibeam::detect(echogram, gates, s.detection.with(s.echoes_last));
    ping_.heave = heave_.at(echogram.world_from_sonar.position.z, now);
    const kmall::Mrz bathymetry = make_mrz(ping_, s, echogram, detections);
    send(bathymetry, now);
    water_level_ = echogram.world_from_sonar.position.z;
    depth_ = depth_below(bathymetry);
    if (settings_.water_column) {
        if (settings_.sensor_datagrams) send(make_heave(ping_, s), now);
        send(make_mwc(ping_, s, echogram, detections), now);
    }
    plan_next_ping(now);
    return take_actions();
}

/// The parts of a big datagram are spread over time, but never beyond the next ping. The next datagram comes
/// behind the last part: readers drop a whole whose parts another datagram parts.
void Kongsberg::send(const kmall::Datagram& datagram, Time now) {
    const std::size_t before = actions_.send.size();
    for (Bytes& part : kmall::divided(kmall::serialise(datagram), settings_.largest_part))
        actions_.send.push_back({0, std::move(part), wiring_.host, {}});
    sent_until_ =
        spread(std::span(actions_.send).subspan(before), std::max(now, sent_until_),
               from_seconds(settings_.datagram_gap), now + from_seconds(0.8 * ping_period(settings_)));
}

Actions Kongsberg::woken(Time now) {
    if (now >= next_texts_) tell_standing(now);
    transmit_if_due(now);
    if (now >= sensors_.wake()) actions_.locate = sensors_.moments(now);
    return take_actions();
}

Actions Kongsberg::located(std::span<const Located> places, Time now) {
    for (const kmall::Datagram& datagram : sensors_.datagrams(places, settings_)) send(datagram, now);
    return take_actions();
}

Actions Kongsberg::take_actions() {
    actions_.wake = std::min({pacer_.wake(), next_texts_, sensors_.wake()});
    return std::exchange(actions_, {});
}

}  // namespace echoloop::kongsberg_kmall
