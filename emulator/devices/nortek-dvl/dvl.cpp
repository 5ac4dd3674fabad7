#include "emulator/devices/nortek-dvl/dvl.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "emulator/devices/family/doppler/moment.h"
#include "emulator/devices/family/survey/sound_speed.h"
#include "protocols/nortek/codec.h"
#include "protocols/nortek/sentences.h"

namespace echoloop::nortek_dvl {
namespace {

constexpr std::size_t longest_command = 512;  // B
constexpr std::string_view break_words = "K1W%!Q";
constexpr char break_key = 3;                        // Ctrl-C
constexpr Time patience = std::chrono::seconds(60);  // for MC or CO behind a break; own choice
constexpr double bar_per_metre = 0.1005;             // of sea water

}  // namespace

Dvl::Dvl(const Settings& settings, std::vector<Outlet> outlets)
    : settings_(settings),
      outlets_(std::move(outlets)),
      state_{.setup = default_setup(settings)},
      live_(settings),
      modes_(doppler::usual_modes(settings.acoustics.lowest_altitude, settings.acoustics.highest_altitude)),
      pacer_(settings.sensors, jitter::processor),
      measurement_(settings) {
    for (std::size_t port = 0; port < outlets_.size(); ++port)
        hosts_[port].login = login_of(outlets_[port].speech);
}

nortek_console::Login Dvl::login_of(Speech speech) const {
    if (speech != Speech::commands) return {};
    return {settings_.login, settings_.password, settings_.product};
}

std::vector<Port> Dvl::ports() const {
    std::vector<Port> all;
    for (const Outlet& one : outlets_) all.push_back(one.port);
    return all;
}

std::int64_t Dvl::clock(Time now) const { return doppler::unix_us(settings_.unix_start, now) + clock_error_; }

Actions Dvl::started(Time now) {
    if (settings_.starts_at_once) {
        state_.mode = Mode::measuring;
        start_measuring(now);
        ping_if_due(now);
    }
    return take_actions();
}

void Dvl::reconnected(std::size_t port) { hosts_[port].text.clear(); }

Actions Dvl::connected(std::size_t port, Address peer, Time) {
    const Speech speech = outlets_.at(port).speech;
    if (speech == Speech::commands) {
        hosts_[port] = {.text = "", .login = login_of(speech)};
        say(port, hosts_[port].login.greeting());
    } else if (settings_.greeting && (speech == Speech::data || speech == Speech::text)) {
        char text[64];
        std::snprintf(text, sizeof text, "\r\nNortek NORTEK-%06u Data Interface\r\n",
                      settings_.serial_number);
        say(port, text, peer);
    }
    return take_actions();
}

Actions Dvl::received(const Received& data, Time now) {
    const Speech speech = outlets_.at(data.port).speech;
    if (speech != Speech::commands && speech != Speech::line) {  // nobody is heard there
        counters_.skipped_bytes += data.bytes.size();
        return take_actions();
    }
    for (const std::uint8_t byte : data.bytes) hear_byte(data.port, static_cast<char>(byte), now);
    ping_if_due(now);
    return take_actions();
}

/// Of a line's end CR LF the second is none of its own, since an empty line may be a password.
void Dvl::hear_byte(std::size_t port, char c, Time now) {
    Host& host = hosts_[port];
    const bool second = c == '\n' && host.last == '\r';
    host.last = c;
    if (second) return;
    if (c == break_key && host.login.in()) return take_break(port, now);
    if (c == '\r' || c == '\n') {
        const std::string line = std::exchange(host.text, {});
        if (!line.empty() || !host.login.in()) read_line(port, line, now);
        return;
    }
    if (host.text.size() < longest_command) host.text += c;
    if (host.login.in() && host.text.ends_with(break_words)) take_break(port, now);
}

void Dvl::take_break(std::size_t port, Time now) {
    hosts_[port].text.clear();
    const Mode before = state_.mode;
    say(port, answer_break(state_, settings_).text);
    ++counters_.messages;
    follow_mode(before, now);
}

void Dvl::read_line(std::size_t port, const std::string& line, Time now) {
    if (nortek_console::Login& login = hosts_[port].login; !login.in()) {
        say(port, login.answer(line));
        ++counters_.messages;
        return;
    }
    const Mode before = state_.mode;
    const Answer reply = answer(line, state_, settings_, clock(now));
    ++(reply.good ? counters_.messages : counters_.rejected);
    if (reply.clock) clock_error_ += *reply.clock - clock(now);
    say(port, reply.text);
    if (reply.trigger && !pacer_.under_way()) pacer_.start(now, Time{});
    follow_mode(before, now);
}

void Dvl::follow_mode(Mode before, Time now) {
    asked_until_ = state_.mode == Mode::confirmation ? now + patience : Time::max();
    if (state_.mode == before) return;
    if (state_.mode == Mode::measuring)
        start_measuring(now);
    else
        stop_measuring();
}

void Dvl::start_measuring(Time now) {
    const Setup& setup = state_.setup;
    live_ = settings_;
    doppler::Acoustics& a = live_.acoustics;
    a.fastest = number_of(setup, "BT", "VR", a.fastest);
    if (nortek_console::value_of(setup, "BT", "PLMODE") == "\"USER\"")
        a.source_level += number_of(setup, "BT", "PL", 0);
    modes_ = doppler::usual_modes(
        a.lowest_altitude, std::min(number_of(setup, "BT", "RANGE", a.highest_altitude), a.highest_altitude));
    measurement_ = doppler::Measurement(live_);
    search_.restart(0, modes_.size() - 1);
    if (trigger_of(setup) == Trigger::internal)
        pacer_.start(now, from_seconds(plan_.period));
    else
        next_edge_ = edge_after(now - Time(1));
}

void Dvl::stop_measuring() {
    pacer_.stop();
    next_edge_ = Time::max();
}

/// Pulses are up for half of their time.
Time Dvl::edge_after(Time now) const {
    const Trigger trigger = trigger_of(state_.setup);
    if (settings_.trigger_rate == 0 || trigger == Trigger::internal || trigger == Trigger::command)
        return Time::max();
    const double edges = settings_.trigger_rate * (trigger == Trigger::edges ? 2 : 1);
    const double first = trigger == Trigger::fall ? 0.5 / settings_.trigger_rate : 0;
    constexpr double hair = 1e-6;  // of the time between two, so that no rounding makes one of them twice
    const double passed = std::floor((to_seconds(now) - first) * edges + hair);
    return Time(std::llround(1e9 * (first + std::max(passed + 1, 0.0) / edges)));
}

double Dvl::speed_at(Time now) const {
    const double fixed = number_of(state_.setup, "DVL", "SV", settings_.sound_speed);
    if (fixed > 0) return fixed;
    const Sensors& s = settings_.sensors;
    return survey::sound_speed(s.read("water", settings_.temperature, stray::water_temperature, now),
                               number_of(state_.setup, "DVL", "SA", settings_.salinity),
                               std::max(s.read("depth", depth_, stray::depth, now), 0.0));
}

void Dvl::ping_if_due(Time now) {
    if (state_.mode != Mode::measuring || !pacer_.begin(now)) return;
    if (trigger_of(state_.setup) != Trigger::internal) pacer_.once();
    speed_ = speed_at(now);
    plan_ = doppler::make_plan(modes_.at(search_.next(true, now)), speed_, live_);
    const double listening = plan_.window + settings_.processing_time;
    plan_.period = std::max(listening, 1 / number_of(state_.setup, "DVL", "SR", settings_.rate));
    actions_.ping = Ping{doppler::make_shot(plan_, live_, ++shots_), now + from_seconds(listening)};
}

void Dvl::report(const Echogram& echogram, Time began) {
    depth_ = -echogram.world_from_sonar.position.z;
    const auto bottom = measurement_.measure(echogram, {speed_, 0, false}, plan_, began);
    search_.found(bottom.altitude > 0 ? std::optional(bottom.altitude) : std::nullopt, modes_, began);
    if (search_.lost()) return;
    const Sensors& s = settings_.sensors;
    const Circumstances how{clock(began),
                            plan_,
                            plan_.window + settings_.processing_time,
                            s.read("water", settings_.temperature, stray::water_temperature, began),
                            bar_per_metre * std::max(s.read("depth", depth_, stray::depth, began), 0.0),
                            state_.broke};
    tell(track_of(bottom, how, live_), false);
    if (!tracks_water(state_.setup)) return;
    auto water = measurement_.measure(echogram, {speed_, 0, true}, plan_, began);
    const bool hides = bottom.altitude > 0 && bottom.altitude < 1.5 * settings_.water_layer;  // own choice
    tell(track_of(hides ? doppler::Measurement::nothing(live_, speed_) : water, how, live_), true);
}

Actions Dvl::heard(const Echogram& echogram, Time now) {
    const Time began = pacer_.began().value_or(now);
    if (!pacer_.end(now, from_seconds(plan_.period))) return take_actions();
    ++counters_.pings;
    if (state_.mode == Mode::measuring && echogram.beams() == settings_.azimuths.size())
        report(echogram, began);
    ping_if_due(now);
    return take_actions();
}

Actions Dvl::woken(Time now) {
    if (now >= asked_until_) {
        const Mode before = std::exchange(state_.mode, Mode::measuring);
        follow_mode(before, now);
    }
    if (now >= next_edge_) {
        if (!pacer_.under_way()) pacer_.start(now, Time{});
        next_edge_ = edge_after(now);
    }
    ping_if_due(now);
    return take_actions();
}

void Dvl::tell(const nortek::DvlTrack& track, bool water) {
    const int format = static_cast<int>(number_of(state_.setup, "BT", water ? "WTDF" : "DF",
                                                  water ? settings_.water_format : settings_.bottom_format));
    const std::string_view address = nortek::line_address(format);
    if (address.empty()) {
        const std::uint8_t id = water ? nortek::dvl_water_track_id : nortek::dvl_bottom_track_id;
        return tell(nortek::encode({id, nortek::dvl_family, track}), false);
    }
    for (const std::string& line : nortek::track_lines(track, address, settings_.voltage))
        tell({line.begin(), line.end()}, true);
}

void Dvl::tell(const Bytes& bytes, bool is_text) {
    for (const auto& [port, host] : hosts_) {
        const Outlet& outlet = outlets_[port];
        if (host.login.in() && (is_text || outlet.speech != Speech::text))
            actions_.send.push_back({port, bytes, outlet.host, {}});
    }
}

void Dvl::say(std::size_t port, const std::string& text, Address to) {
    actions_.send.push_back({port, {text.begin(), text.end()}, to, {}});
}

Actions Dvl::take_actions() {
    actions_.wake = std::min({pacer_.wake(), next_edge_, asked_until_});
    return std::exchange(actions_, {});
}

}  // namespace echoloop::nortek_dvl
