#include "emulator/devices/nortek-nucleus/nucleus.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "emulator/devices/family/doppler/attitude.h"
#include "emulator/devices/family/doppler/moment.h"
#include "protocols/nortek/codec.h"

namespace echoloop::nortek_nucleus {
namespace {

constexpr std::size_t longest_command = 512;  // B
constexpr std::size_t most_listeners = 8;     // of the port of data; own choice
constexpr double bar_per_metre = 0.1005;      // of sea water

float as_float(double value) { return static_cast<float>(value); }

/// From the program's axes to x forward, y to starboard, z down in a world of the same kind.
Quat as_nucleus(const Quat& q) { return {q.w, q.x, -q.y, -q.z}; }

}  // namespace

Shot make_shot(const doppler::Plan& plan, const Settings& settings, std::uint64_t number) {
    Shot shot = doppler::make_shot(plan, settings, number);
    shot.bearings.push_back(std::numbers::pi);  // the last of ascending ones; it looks straight down
    shot.sides.push_back({std::numbers::pi / 2, settings.acoustics.source_level});
    return shot;
}

Nucleus::Nucleus(const Settings& settings, std::vector<Speech> ports)
    : settings_(settings),
      speech_(std::move(ports)),
      modes_(doppler::usual_modes(settings.acoustics.lowest_altitude, settings.acoustics.highest_altitude)),
      pacer_(settings.sensors, jitter::processor),
      measurement_(settings) {
    search_.restart(0, modes_.size() - 1);
    for (std::size_t port = 0; port < speech_.size(); ++port) hosts_[port].login = login_of(speech_[port]);
}

nortek_console::Login Nucleus::login_of(Speech speech) const {
    using nortek_console::Login;
    if (speech != Speech::commands) return {};
    return {settings_.login ? Login::Kind::password : Login::Kind::none, settings_.password, "Nucleus1000"};
}

std::vector<Port> Nucleus::ports() const {
    std::vector<Port> all;
    for (const Speech speech : speech_) {
        constexpr const char* names[] = {"commands", "data", "line"};
        Port port{names[static_cast<std::size_t>(speech)], Port::Kind::stream, {}, false};
        if (speech == Speech::data) {
            port.drivers = most_listeners;
            port.messages_kept = 64;
        }
        all.push_back(port);
    }
    return all;
}

std::int64_t Nucleus::clock(Time now) const {
    return doppler::unix_us(settings_.unix_start, now) + clock_error_;
}

Actions Nucleus::started(Time now) {
    state_.running = settings_.starts_at_once;
    start_or_stop(false, now);
    ping_if_due(now);
    return take_actions();
}

void Nucleus::reconnected(std::size_t port) { hosts_[port].text.clear(); }

Actions Nucleus::connected(std::size_t port, Address, Time) {
    if (speech_.at(port) != Speech::commands) return take_actions();
    hosts_[port] = {.text = "", .login = login_of(Speech::commands)};
    say(port, hosts_[port].login.greeting());
    return take_actions();
}

Actions Nucleus::received(const Received& data, Time now) {
    if (speech_.at(data.port) == Speech::data) {  // nobody is heard there
        counters_.skipped_bytes += data.bytes.size();
        return take_actions();
    }
    std::string& text = hosts_[data.port].text;
    for (const std::uint8_t byte : data.bytes) {
        const char c = static_cast<char>(byte);
        if (c != '\r' && c != '\n') {
            if (text.size() < longest_command) text += c;
            continue;
        }
        if (!text.empty()) read_line(data.port, std::exchange(text, {}), now);
    }
    ping_if_due(now);
    return take_actions();
}

void Nucleus::read_line(std::size_t port, const std::string& line, Time now) {
    if (nortek_console::Login& login = hosts_[port].login; !login.in()) {
        const std::string text = login.answer(line);
        ++(login.in() ? counters_.messages : counters_.rejected);
        return say(port, text);
    }
    const bool ran = state_.running;
    const Answer reply = answer(line, state_, settings_, clock(now));
    ++(reply.good ? counters_.messages : counters_.rejected);
    if (reply.clock) clock_error_ += *reply.clock - clock(now);
    say(port, reply.text);
    if (reply.trigger) pacer_.start(now, Time{});
    if (state_.running != ran) start_or_stop(ran, now);
}

void Nucleus::start_or_stop(bool ran, Time now) {
    if (!state_.running) {
        pacer_.stop();
        next_attitude_ = Time::max();
        return;
    }
    if (ran) return;
    search_.restart(0, modes_.size() - 1);
    next_attitude_ = now;
    if (state_.setup["TRIG"]["SRC"] == "\"INTERNAL\"") pacer_.start(now, from_seconds(plan_.period));
}

void Nucleus::ping_if_due(Time now) {
    if (!state_.running || !pacer_.begin(now)) return;
    if (state_.setup["TRIG"]["SRC"] != "\"INTERNAL\"") pacer_.once();
    plan_ = doppler::make_plan(modes_.at(search_.next(true, now)), settings_.sound_speed, settings_);
    plan_.period =
        std::max(plan_.window + settings_.processing_time, 1 / number_of(state_.setup, "TRIG", "FREQ", 4));
    actions_.ping = Ping{make_shot(plan_, settings_, ++shots_),
                         now + from_seconds(plan_.window + settings_.processing_time)};
}

template <class Data>
Data Nucleus::data_of(Time at) const {
    Data out;
    const std::int64_t us = clock(at);
    out.seconds = static_cast<std::uint32_t>(us / 1'000'000);
    out.microseconds = static_cast<std::uint32_t>(us % 1'000'000);
    out.serial_number = settings_.serial_number;
    if constexpr (requires { out.sound_speed; }) {
        const Sensors& s = settings_.sensors;
        out.sound_speed = as_float(settings_.sound_speed);
        out.temperature = as_float(s.read("water", settings_.temperature, stray::water_temperature, at));
        out.pressure = as_float(bar_per_metre * std::max(s.read("depth", depth_, stray::depth, at), 0.0));
    }
    return out;
}

void Nucleus::send_track(const doppler::Measured& m, Time began) {
    auto out = data_of<nortek::Track>(began);
    out.velocity.fill(nortek::no_velocity);
    out.merit.fill(nortek::no_merit);
    for (std::size_t i = 0; i < out.beam_velocity.size(); ++i) {
        const doppler::BeamReport& beam = m.beams[i];
        out.beam_velocity[i] = beam.valid ? as_float(beam.velocity) : nortek::no_velocity;
        out.distance[i] = beam.valid ? as_float(beam.distance * std::cos(settings_.acoustics.tilt)) : 0;
        out.beam_merit[i] = beam.valid ? as_float(beam.deviation) : nortek::no_merit;
        out.beam_delay[i] = beam.valid ? as_float(2 * beam.distance / settings_.sound_speed) : 0;
        out.beam_duration[i] = as_float(plan_.pulse);
        if (beam.valid) out.status |= (1U << i) | (1U << (3 + i)) | (1U << (6 + i));
    }
    if (m.valid) {
        out.velocity = {as_float(m.velocity.x), as_float(m.velocity.y), as_float(m.velocity.z)};
        for (std::size_t i = 0; i < 3; ++i) out.merit[i] = as_float(std::sqrt(m.covariance[i][i]));
        out.status |= 0x3FU << 9;
        out.delay = as_float(measurement_.echo_time());
    }
    out.duration = as_float(plan_.pulse);
    tell({nortek::bottom_track_id, nortek::nucleus_family, out});
}

void Nucleus::send_altimeter(const Echogram& echogram, Time began) {
    auto out = data_of<nortek::Altimeter>(began);
    out.status = 3U << 16;  // pressure, temperature
    const auto echo = doppler::find_bottom_echo(echogram, settings_.azimuths.size(), settings_);
    if (echo) {
        out.distance = as_float(settings_.sound_speed / 2 * echo->time);
        const double noise = echogram.noise_power > 0 ? 10 * std::log10(echogram.noise_power) : 0;
        out.quality =
            static_cast<std::uint16_t>(std::lround(std::clamp(100 * (echo->level - noise), 0.0, 65535.0)));
        out.status |= 3;
    }
    tell({nortek::altimeter_id, nortek::nucleus_family, out});
}

Actions Nucleus::heard(const Echogram& echogram, Time now) {
    const Time began = pacer_.began().value_or(now);
    if (!pacer_.end(now, from_seconds(plan_.period))) return take_actions();
    ++counters_.pings;
    if (state_.running && echogram.beams() == settings_.azimuths.size() + 1) {
        depth_ = -echogram.world_from_sonar.position.z;
        const auto measured = measurement_.measure(echogram, {settings_.sound_speed, 0, false}, plan_, began);
        search_.found(measured.altitude > 0 ? std::optional(measured.altitude) : std::nullopt, modes_, now);
        if (!search_.lost()) {
            if (is_on(state_.setup, "BT")) send_track(measured, began);
            if (is_on(state_.setup, "ALTI")) send_altimeter(echogram, began);
        }
    }
    ping_if_due(now);
    return take_actions();
}

Actions Nucleus::located(std::span<const Located> places, Time) {
    for (const Located& place : places) {
        auto out = data_of<nortek::Ahrs>(place.time);
        const Quat q = as_nucleus(place.world_from_device.orientation);
        const doppler::Attitude attitude = doppler::attitude_of(q);
        const auto read = settings_.sensors.at(place.time);
        out.roll = read("roll", rad_to_deg(attitude.roll), stray::tilt);
        out.pitch = read("pitch", rad_to_deg(attitude.pitch), stray::tilt);
        const double heading = rad_to_deg(attitude.heading);
        out.heading = as_float(settings_.sensors.read_bearing(
            "heading", heading < 0 ? heading + 360 : heading, stray::compass, place.time));
        // To axes x north, y east, z down, by what it reads.
        const Quat turned = axis_angle({0, 0, 1}, deg_to_rad(static_cast<double>(out.heading))) *
                            axis_angle({0, 1, 0}, deg_to_rad(static_cast<double>(out.pitch))) *
                            axis_angle({1, 0, 0}, deg_to_rad(static_cast<double>(out.roll)));
        out.quaternion = {as_float(turned.w), as_float(turned.x), as_float(turned.y), as_float(turned.z)};
        const Vec3 axes[] = {rotate(turned, {1, 0, 0}), rotate(turned, {0, 1, 0}), rotate(turned, {0, 0, 1})};
        for (std::size_t i = 0; i < 3; ++i) {
            out.matrix[i] = as_float(axes[i].x);
            out.matrix[3 + i] = as_float(axes[i].y);
            out.matrix[6 + i] = as_float(axes[i].z);
        }
        out.depth = as_float(
            settings_.sensors.read("depth", -place.world_from_device.position.z, stray::depth, place.time));
        tell({nortek::ahrs_id, nortek::nucleus_family, out});
    }
    return take_actions();
}

Actions Nucleus::woken(Time now) {
    ping_if_due(now);
    if (now >= next_attitude_) {
        next_attitude_ += from_seconds(1 / number_of(state_.setup, "AHRS", "FREQ", 10));
        if (is_on(state_.setup, "AHRS")) actions_.locate.push_back(now);
    }
    return take_actions();
}

void Nucleus::tell(const nortek::Frame& frame) {
    const Bytes bytes = nortek::encode(frame);
    for (const auto& [port, host] : hosts_)
        if (host.login.in()) actions_.send.push_back({port, bytes, {}, {}});
}

void Nucleus::say(std::size_t port, const std::string& text) {
    actions_.send.push_back({port, {text.begin(), text.end()}, {}, {}});
}

Actions Nucleus::take_actions() {
    actions_.wake = std::min(pacer_.wake(), next_attitude_);
    return std::exchange(actions_, {});
}

}  // namespace echoloop::nortek_nucleus
