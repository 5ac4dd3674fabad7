#include "emulator/devices/tritech-profiler/profiler.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "emulator/devices/family/tritech/bins.h"

namespace echoloop::profiler {
namespace {

namespace bits = seanet::profiler_ctrl;
constexpr std::size_t frame_overhead = 51;  // bytes beside the echo times

/// dB of a count on the scale of 0..255.
double decibels(std::uint8_t count) { return count * tritech::full_scale_db / 255; }

}  // namespace

Profiler::Profiler(const Settings& settings) : Head(settings.head), settings_(settings) {}

bool Profiler::configure(const seanet::Message& message, Time now) {
    if (const auto* command = std::get_if<seanet::ProfilerCommand>(&message))
        return take_parameters(*command, now);
    const auto* gains = std::get_if<seanet::ProfilerGainCommand>(&message);
    if (!gains || !parameters_) return false;
    take_gains(gains->gains);
    return true;
}

bool Profiler::take_parameters(const seanet::ProfilerCommand& command, Time now) {
    const seanet::ProfilerParameters& p = command.parameters;
    if (!usable(p) || (settings_.head.refuse_while_centring && !centred(now))) return false;
    parameters_ = p;
    settings_of_ = {
        Setting{{p.tx_n1, p.rx_n1, p.slope1}, p.ad_threshold, p.filt_gain, p.agc_max, p.agc_set_point},
        Setting{{p.tx_n2, p.rx_n2, p.slope2}, p.ad_threshold, p.filt_gain, p.agc_max, p.agc_set_point}};
    if (settings_.gains_count) take_gains(command.gains);
    gain_ = most_gain();
    pass_ = make_pass(p, settings_);
    echo_times_.clear();
    configured(now);
    return true;
}

void Profiler::take_gains(const seanet::ProfilerGains& g) {
    for (int i : {0, 1}) {
        Setting& s = settings_of_[static_cast<std::size_t>(i)];
        s.threshold = i == 0 ? g.ad_threshold1 : g.ad_threshold2;
        s.filt_gain = i == 0 ? g.filt_gain1 : g.filt_gain2;
        s.agc_max = i == 0 ? g.agc_max1 : g.agc_max2;
        s.agc_set_point = i == 0 ? g.agc_set_point1 : g.agc_set_point2;
        const std::uint16_t slope = i == 0 ? g.adv_slope1 : g.adv_slope2;
        if (slope != 0) s.channel.slope = slope;
    }
    gain_ = most_gain();
}

double Profiler::most_gain() const { return decibels(setting().agc_max); }

/// Brings the strongest echo towards the set point, a few dB a ping, never above AGCmax.
void Profiler::adapt_gain(double peak) {
    constexpr double fastest = 6;  // dB a ping
    if (!has(bits::agc) || !std::isfinite(peak)) return;
    const double wanted = decibels(setting().agc_set_point) - peak;
    gain_ = std::clamp(gain_ + std::clamp(wanted, -fastest, fastest), 0.0, most_gain());
}

std::uint16_t Profiler::position() const {
    return parameters_ ? pass_.bearing(std::min(echo_times_.size(), pass_.pings() - 1)) : std::uint16_t{3200};
}

void Profiler::begin(Time now) {
    echo_times_.clear();
    transmit(now);
}

void Profiler::transmit(Time now) {
    tuning_ = tritech::tune(settings_.acoustics, setting().channel);
    Shot shot = ping_shot(*parameters_, settings_, tuning_, position());
    const double motor = pass_.way_to(echo_times_.size()) * parameters_->motor_time * 10e-6;
    const double period =
        std::max(window(*parameters_), settings_.period_scale * (window(*parameters_) + motor));
    shot.interval = period;
    const Time due = now + from_seconds(period);
    shot.ping = begin_ping(due);
    actions_.ping = Ping{std::move(shot), due};
}

Actions Profiler::heard(const Echogram& echogram, Time now) {
    if (!is_under_way(echogram.shot.ping)) return take_actions();
    ++counters_.pings;
    const EchoRule rule{choice(*parameters_), decibels(setting().threshold), parameters_->lockout * 1e-6,
                        gain_};
    const Echo echo = find_echo(echogram, rule, settings_.acoustics, tuning_);
    echo_times_.push_back(echo.time);
    adapt_gain(echo.peak);
    if (echo_times_.size() < pass_.pings()) {
        transmit(now);
        return take_actions();
    }
    const std::size_t bytes = frame_overhead + 2 * echo_times_.size();
    reply(pass_data());
    pass_.turn();
    finish_reply(now, bytes);
    return take_actions();
}

seanet::ProfilerData Profiler::pass_data() {
    const seanet::ProfilerParameters& p = *parameters_;
    const Setting& s = setting();
    seanet::ProfilerData data;
    data.device_type =
        settings_.device_type < 0 ? p.hd_type : static_cast<std::uint8_t>(settings_.device_type);
    data.sweep_code =
        pass_.clockwise() ? seanet::SweepCode::at_right_limit : seanet::SweepCode::at_left_limit;
    // Hosts learn from this bit in which order the times stand.
    const auto direction = pass_.clockwise() ? bits::scanright : std::uint16_t{0};
    data.hd_ctrl = tritech::shown_hd_ctrl(
        static_cast<std::uint16_t>((p.hd_ctrl & ~bits::scanright) | direction), settings_.head);
    data.range_scale = p.range_scale;
    data.tx_n = s.channel.tx_n;
    data.gain = static_cast<std::uint8_t>(std::lround(gain_ * 255 / tritech::full_scale_db));
    data.slope = s.channel.slope;
    data.ad_threshold = s.threshold;
    data.filt_gain = s.filt_gain;
    data.left_limit = p.left_limit;
    data.right_limit = p.right_limit;
    data.step_size = p.step_size;
    data.scan_time = p.scan_time;
    data.echo_times = std::exchange(echo_times_, {});
    return data;
}

}  // namespace echoloop::profiler
