#include "emulator/devices/r2sonic/r2sonic.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocols/r2sonic/codec.h"
#include "protocols/r2sonic/commands.h"

namespace echoloop::r2sonic_device {
namespace {

using namespace std::chrono_literals;

constexpr Time status_period = 1s;
constexpr Time presence_period = 1300ms;  // of R2DS, as a real 2022 and its SIM send it
constexpr Time sync_delay = 10ms;         // from the edge to the middle of the pulse, manual on SYI0

bool follows_bottom(const Controls& controls) { return (controls.auto_range & 0x10000) != 0; }

}  // namespace

R2Sonic::R2Sonic(const Settings& settings, const Wiring& wiring)
    : settings_(settings),
      network_(wiring, settings),
      inputs_(wiring.all, first_input),
      first_input_port_(network_.ports().size()),
      controls_(settings.start),
      sync_edge_(wiring.sim ? 0 : 1) {}  // without a SIM nobody can set it

std::vector<Port> R2Sonic::ports() const {
    std::vector<Port> ports = network_.ports();
    for (Port& port : inputs_.ports()) ports.push_back(std::move(port));
    return ports;
}

void R2Sonic::reconnected(std::size_t port) {
    if (is_input(port)) inputs_.reconnected(port - first_input_port_);
}

void R2Sonic::line_rate(std::size_t port, double rate) {
    if (is_input(port)) inputs_.line_rate(port - first_input_port_, rate);
}

DeviceCounters R2Sonic::counters() const {
    DeviceCounters sum = counters_;
    const DeviceCounters& heard = inputs_.counters();
    sum.messages += heard.messages;
    sum.rejected += heard.rejected;
    sum.skipped_bytes += heard.skipped_bytes;
    return sum;
}

Actions R2Sonic::started(Time now) {
    next_status_ = next_presence_ = now;
    plan_next_ping(now);
    return take_actions();
}

Actions R2Sonic::received(const Received& data, Time now) {
    if (is_input(data.port)) {
        inputs_.received(data.port - first_input_port_, data.bytes, now, true_time(now));
        return take_actions();
    }
    ++datagrams_received_;
    if (const auto packet = r2sonic::parse(data.bytes))
        obey(*packet, data, now);
    else
        ++counters_.rejected;
    return take_actions();
}

void R2Sonic::obey(const r2sonic::Packet& packet, const Received& data, Time now) {
    ++counters_.messages;
    if (const auto* set = std::get_if<r2sonic::Cmd0>(&packet)) {
        for (const r2sonic::Command& command : set->commands) count_unknown(command.name.view());
        if (data.port == head_commands && head_on_) obey_head(*set);
        if (data.port == sim_commands && network_.has_sim()) obey_sim(*set);
        plan_next_ping(now);
    } else if (const auto* request = std::get_if<r2sonic::R2dd>(&packet)) {
        for (Send& answer : network_.answers(*request, data.from, head_on_))
            actions_.send.push_back(std::move(answer));
    } else if (const auto* config = std::get_if<r2sonic::R2dc>(&packet)) {
        if (!network_.configure(*config, head_on_)) ++counters_.rejected;
    }
}

void R2Sonic::obey_head(const r2sonic::Cmd0& set) {
    const double range = controls_.range;
    for (const r2sonic::Command& command : set.commands) {
        const Applied applied = apply(controls_, command, *settings_.variant);
        if (applied == Applied::ping && controls_.trigger == 2) ping_asked_ = true;
        if (applied == Applied::refused) ++counters_.rejected;
    }
    // Programs send RNG0 again and again: only another value starts from there.
    if (!follows_bottom(controls_) || controls_.range != range) followed_range_.reset();
}

/// The controls that the next ping has.
Controls R2Sonic::controls_in_use() const {
    Controls in_use = controls_;
    in_use.range = followed_range_.value_or(controls_.range);
    if (inputs_.is_wired(Input::svp) && !in_use.use_sound_speed) {
        in_use.use_sound_speed = true;
        in_use.sound_speed = inputs_.sound_speed().value_or(controls_.sound_speed);
    }
    return in_use;
}

/// As the head is told it: by the SIM's motion input, where there is one, which knows no depth.
Attitude R2Sonic::attitude(Time now) const {
    if (!inputs_.is_wired(Input::motion)) return attitude_;
    const MotionReading told = inputs_.motion(now).value_or(MotionReading{});
    return {told.roll, told.pitch, attitude_.depth};
}

void R2Sonic::obey_sim(const r2sonic::Cmd0& set) {
    for (const r2sonic::Command& command : set.commands) {
        inputs_.obey(command);
        const std::string_view name = command.name.view();
        if (name == "SPO0") switch_head(command.as_u32() != 0);
        if (name == "SYI0") sync_edge_ = std::min(command.as_u32(), 2U);
        if (name == "STM0") sim_status_ = command.as_u32();
    }
}

/// Programs send all that they know once a second, so a name that no head has counts once.
void R2Sonic::count_unknown(std::string_view name) {
    constexpr std::size_t most = 64;
    if (r2sonic::find_command(name) != nullptr || unknown_names_.size() >= most) return;
    if (unknown_names_.emplace(name).second) ++counters_.rejected;
}

/// A head that gets its power back has forgotten everything.
void R2Sonic::switch_head(bool on) {
    if (on == head_on_) return;
    head_on_ = on;
    controls_ = settings_.start;
    followed_range_.reset();
    ping_ = {};
    ping_asked_ = false;
    pacer_.reset();
    seabed_ = {};
}

/// The first ping after `from` that a pulse at the sync input fires; pulses last half their period.
Time R2Sonic::next_sync(Time from) const {
    if (sync_edge_ == 0 || settings_.sync_in <= 0) return Time::max();
    const double period = 1 / settings_.sync_in,
                 offset = to_seconds(sync_delay) + (sync_edge_ == 2 ? period / 2 : 0);
    const double edge = std::max(0.0, std::ceil((to_seconds(from) - offset) / period - 1e-6));
    return from_seconds(edge * period + offset);
}

void R2Sonic::plan_next_ping(Time now) {
    if (!head_on_ || (controls_.trigger == 2 && !ping_asked_)) return pacer_.pause();
    pacer_.start(now, from_seconds(ping_period(controls_in_use(), settings_)));
    if (controls_.trigger == 1) pacer_.hold(next_sync(pacer_.wake()));
}

void R2Sonic::transmit(Time now) {
    ping_asked_ = false;
    ping_.period = ping_.number > 0 ? to_seconds(now - transmitted_) : 0;
    transmitted_ = now;
    ping_.controls = controls_in_use();
    if (settings_.mode_sets > 0)
        ping_.controls = with_set(ping_.controls, ping_.number % settings_.mode_sets);
    ping_.time = unix_time(now);
    ping_.since_start = now;
    ping_.attitude = attitude(now);
    ++ping_.number;
    const double roll = ping_.attitude.roll;
    ping_.beams = beam_angles(ping_.controls, roll, bottom_normal(seabed_, roll));
    const Time due =
        now + from_seconds(range_time(ping_.controls, settings_)) + from_seconds(settings_.processing_time);
    actions_.ping =
        Ping{make_shot(ping_.controls, settings_, ping_.beams, ping_.attitude.pitch, ping_.number), due};
}

Actions R2Sonic::heard(const Echogram& echogram, Time now) {
    const auto& angles = ping_.beams.angles;
    if (!pacer_.under_way() || echogram.shot.ping != ping_.number || echogram.beams() != angles.size())
        return take_actions();
    pacer_.end(now, {});
    ++counters_.pings;
    // Of the head's own sensor, where it was when it last measured.
    settings_.sound_speed =
        probe_.of(echogram.sound_speed, settings_.sensors, stray::sound_speed, ping_.since_start);
    attitude_ = attitude_of(echogram.world_from_sonar);
    const double c = working_sound_speed(ping_.controls, settings_);
    const double window = static_cast<double>(echogram.shot.bins) * echogram.shot.bin_interval;
    const multibeam::Gates set = bottom_gates(ping_.controls, seabed_);
    std::vector<multibeam::TimeGate> gates;
    for (const double angle : angles) gates.push_back(multibeam::time_gate(set, angle, c, window));
    const auto detections =
        multibeam::detect(echogram, gates, settings_.acoustics.detection.with(settings_.pulse));
    const auto axis_gate = multibeam::time_gate(set, 0, c, window);
    seabed_ = {multibeam::median_depth(detections, angles, c), multibeam::median_slope(detections, angles)};
    const r2sonic::G0 gate{static_cast<float>(axis_gate.min), static_cast<float>(axis_gate.max),
                           static_cast<float>(set.depth ? 0 - set.depth->slope : 0)};  // never -0
    send(Network::source(Product::bathymetry), make_bth0(ping_, settings_, echogram, detections, gates, gate),
         Product::bathymetry);
    actions_.send.back().not_before =
        now + from_seconds(std::max(0.0, settings_.bathymetry_time - settings_.processing_time));
    send_products(echogram, detections, gates, now);
    if (follows_bottom(controls_)) follow_bottom(detections);
    plan_next_ping(now);
    return take_actions();
}

/// Keeps the farthest of the points, but for stray ones, within the range; without a bottom it looks farther.
void R2Sonic::follow_bottom(const std::vector<multibeam::Detection>& detections) {
    const double in_use = controls_in_use().range;
    if (ping_.controls.range != in_use) return;  // another one was commanded meanwhile
    std::vector<double> times;
    for (const auto& d : detections)
        if (d.found()) times.push_back(d.time);
    double range = 2 * in_use;
    if (times.size() > detections.size() / 4) {
        const auto farthest = times.begin() + static_cast<std::ptrdiff_t>(times.size() * 49 / 50);
        std::nth_element(times.begin(), farthest, times.end());
        range = 1.2 * *farthest * working_sound_speed(controls_in_use(), settings_) / 2;
    }
    if (std::abs(range - in_use) > 0.05 * in_use) followed_range_ = std::clamp(range, 2.0, 1200.0);
}

/// Spread over time, since receivers lose bursts, but never beyond the next ping, and behind those of the
/// last one: readers drop parts of a ping that come behind another ping's head.
void R2Sonic::send_products(const Echogram& echogram, const std::vector<multibeam::Detection>& detections,
                            const std::vector<multibeam::TimeGate>& gates, Time now) {
    const std::size_t first = actions_.send.size();
    const auto add = [&](std::vector<Bytes> datagrams, Product product) {
        for (Bytes& bytes : datagrams)
            actions_.send.push_back(
                {Network::source(product), std::move(bytes), network_.destination(product), now});
    };
    add(image_datagrams(ping_, settings_, echogram), Product::image);
    add(snippet_datagrams(ping_, settings_, echogram, detections), Product::snippets);
    add(truepix_datagrams(ping_, settings_, echogram, gates), Product::truepix);
    add(water_column_datagrams(ping_, settings_, echogram), Product::water_column);
    const auto datagrams = std::span(actions_.send).subspan(first);
    const Time end = now + from_seconds(0.8 * ping_period(ping_.controls, settings_));
    // Own choice: Linux holds 212,992 bytes for a socket whose reader asks for no more, overhead among them.
    constexpr Batch batch{std::chrono::milliseconds(4), 56'000};
    products_until_ =
        spread(datagrams, std::max(now, products_until_), from_seconds(settings_.datagram_gap), end, batch);
    datagrams_sent_ += static_cast<std::uint32_t>(datagrams.size());
}

void R2Sonic::send_presence(Time now) {
    next_presence_ = now + presence_period;
    const auto tell = [&](std::size_t port, const wire::Text<12>& serial, std::uint32_t config) {
        send(port, r2sonic::R2ds{serial, config, 0}, Product::status);
    };
    if (head_on_) tell(head_commands, settings_.serial, network_.head_config());
    if (network_.has_sim()) tell(sim_commands, settings_.sim_serial, network_.sim_config());
}

Health R2Sonic::health(Time now) const {
    Health h{.unix_time = unix_time(now),
             .since_start = now,
             .attitude = attitude(now),
             .received = datagrams_received_,
             .sent = datagrams_sent_,
             .head_on = head_on_,
             .sync_pulses = settings_.sync_in > 0};
    if (inputs_.is_wired(Input::motion)) h.motion = inputs_.motion(now).value_or(MotionReading{});
    if (inputs_.is_wired(Input::svp)) h.sound_speed = inputs_.sound_speed().value_or(0);
    for (std::size_t i = 0; i < input_count; ++i) h.lamps[i] = inputs_.lamp(static_cast<Input>(i), now);
    return h;
}

void R2Sonic::send_status(Time now) {
    next_status_ = now + status_period;
    const Health health = this->health(now);
    if (head_on_ && controls_.status != 0)
        send(head_commands, head_status(settings_, health), Product::status);
    if (network_.has_sim() && sim_status_ != 0)
        send(sim_commands, sim_status(settings_, health), Product::status);
}

Actions R2Sonic::woken(Time now) {
    if (now >= next_presence_) send_presence(now);
    if (now >= next_status_) send_status(now);
    if (pacer_.begin(now)) transmit(now);
    return take_actions();
}

void R2Sonic::send(std::size_t port, const r2sonic::Packet& packet, Product product) {
    actions_.send.push_back({port, r2sonic::serialise(packet), network_.destination(product), {}});
    ++datagrams_sent_;
}

Actions R2Sonic::take_actions() {
    actions_.wake = std::min({pacer_.wake(), next_presence_, next_status_});
    return std::exchange(actions_, {});
}

}  // namespace echoloop::r2sonic_device
