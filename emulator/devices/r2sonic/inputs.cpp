#include "emulator/devices/r2sonic/inputs.h"

#include <cmath>
#include <string_view>

namespace echoloop::r2sonic_device {
namespace {

using namespace std::chrono_literals;

constexpr const char* input_names[input_count]{"SIM motion", "SIM GPS", "SIM SVP"};
constexpr std::string_view input_letters = "MGS";  // third character of a command
constexpr std::size_t longest_line = 512;

/// How long an input counts as heard: own choice. Motion comes a hundred times a second (manual), time once.
constexpr Time lasting[input_count]{1s, 3s, 5s};

}  // namespace

Inputs::Inputs(const std::vector<Endpoint>& all, std::size_t first) {
    for (std::size_t i = first; i < all.size(); ++i) wired_.push_back({.endpoint = all[i], .place = i});
}

std::vector<Port> Inputs::ports() const {
    std::vector<Port> ports;
    for (std::size_t i = 0; i < wired_.size(); ++i) {
        const Endpoint& e = wired_[i].endpoint;
        Port port;
        port.name = input_names[i];
        if (e.on_udp()) {
            port.kind = Port::Kind::datagram;
            port.bind = {e.ip, e.port};
        } else {
            port.endpoint = wired_[i].place;
        }
        ports.push_back(port);
    }
    return ports;
}

void Inputs::obey(const r2sonic::Command& command) {
    const std::string_view name = command.name.view();
    if (name.size() != 4 || name[3] != '0') return;
    const std::size_t index = input_letters.find(name[2]);
    if (index >= wired_.size()) return;
    Line& line = wired_[index];
    const std::string_view what = name.substr(0, 2);
    if (what == "EN") line.on = command.as_u32() != 0;
    if (what == "BD") line.baud = command.as_u32();
    if (what == "PT") line.udp_port = command.as_u32();
}

/// Bytes at another baud are garbage, and datagrams to another port never come.
bool Inputs::hears(const Line& line) const {
    if (!line.on) return false;
    if (line.endpoint.on_udp()) return line.udp_port == 0 || line.udp_port == line.endpoint.port;
    return line.baud == 0 || line.rate <= 0 || line.rate == line.baud;
}

void Inputs::received(std::size_t index, ByteView bytes, Time now, double unix_time) {
    Line& line = wired_.at(index);
    if (!hears(line)) {
        if (line.on) counters_.skipped_bytes += bytes.size();
        line.pending.clear();
        return;
    }
    const auto input = static_cast<Input>(index);
    for (const std::uint8_t byte : bytes) {
        line.pending += static_cast<char>(byte);
        if (byte == '\n') {
            const bool good = take(input, line.pending, now, unix_time);
            if (good) line.last_good = now;
            line.pending.clear();
        } else if (line.pending.size() > longest_line) {
            counters_.skipped_bytes += line.pending.size();
            line.pending.clear();
        }
    }
    if (!line.endpoint.on_udp()) return;
    counters_.skipped_bytes += line.pending.size();  // a line ends with its datagram
    line.pending.clear();
}

/// True if the input has its value from the line.
bool Inputs::take(Input input, std::string_view line, Time now, double unix_time) {
    bool good = false;
    if (input == Input::motion) {
        const auto reading = read_motion(line);
        good = reading.has_value();
        if (reading) motion_ = *reading;
    } else if (input == Input::gps) {
        good = take_time(line, now, unix_time);
    } else {
        const auto speed = read_sound_speed(line);
        good = speed.has_value();
        if (speed) sound_speed_ = speed;
    }
    // Sentences that it has no use for may be among those that it has (manual on the GPS input).
    const std::string_view own = input == Input::motion ? "$PHOCT" : "$GPZDA";
    const bool other = !good && input != Input::svp && is_sentence(line) && !line.starts_with(own);
    ++(good || other ? counters_.messages : counters_.rejected);
    return good;
}

/// While a Trimble's UTC comes, ZDA is not looked at (manual).
bool Inputs::take_time(std::string_view line, Time now, double unix_time) {
    constexpr Time trimble_lasts = 2500ms;  // own choice
    const auto reading = read_time(line);
    if (!reading) return false;
    if (!reading->of_the_last_pulse) last_trimble_ = now;
    if (reading->of_the_last_pulse && last_trimble_ && now - *last_trimble_ < trimble_lasts) return true;
    const double pulse = std::floor(unix_time) + (reading->of_the_last_pulse ? 0 : 1);
    clock_ahead_ = reading->unix_time - pulse;
    return true;
}

std::optional<MotionReading> Inputs::motion(Time now) const {
    return lamp(Input::motion, now) == Lamp::good ? std::optional(motion_) : std::nullopt;
}

double Inputs::clock(Time now, double unix_time) const {
    if (!is_wired(Input::gps)) return unix_time;
    return clock_ahead_ ? unix_time + *clock_ahead_ : to_seconds(now);
}

Lamp Inputs::lamp(Input input, Time now) const {
    const auto index = static_cast<std::size_t>(input);
    if (!is_wired(input)) return Lamp::good;
    const Line& line = wired_[index];
    if (!line.on) return Lamp::off;
    return line.last_good && now - *line.last_good <= lasting[index] ? Lamp::good : Lamp::bad;
}

}  // namespace echoloop::r2sonic_device
