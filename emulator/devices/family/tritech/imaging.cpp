#include "emulator/devices/family/tritech/imaging.h"

#include <algorithm>
#include <utility>

#include "emulator/devices/family/tritech/bins.h"

namespace echoloop::tritech {
namespace {

namespace bits = seanet::hd_ctrl;
constexpr std::size_t head_data_overhead = 45;  // bytes of a frame beside its bins
constexpr std::size_t aux_data_overhead = 16;   // bytes of a frame beside its text

}  // namespace

Imaging::Imaging(const ImagingSettings& settings)
    : Head(settings.head), settings_(settings), scan_(settings.scan) {}

bool Imaging::configure(const seanet::Message& message, Time now) {
    if (const auto* command = std::get_if<seanet::HeadCommand>(&message))
        return take_parameters(command->parameters, nullptr, now);
    if (const auto* command = std::get_if<seanet::HeadCommandDual>(&message))
        return take_parameters(command->parameters, settings_.v3b_counts ? &command->v3b : nullptr, now);
    if (!parameters_) return false;
    if (const auto* command = std::get_if<seanet::HeadCommandGain>(&message)) {
        take_gains(command->v3b);
        return true;
    }
    if (!std::holds_alternative<seanet::HeadCommandReverse>(message)) return false;
    turn_round();
    return true;
}

void Imaging::turn_round() {
    parameters_->hd_ctrl ^= bits::scanright;
    scan_.reverse();
}

void Imaging::forget() {
    parameters_.reset();
    scan_.centre();
    aux_under_way_ = false;
    aux_text_.clear();
}

/// Drivers that send zeros in V3B demand the main ADSpan and ADLow back: `v3b` is null unless an option says
/// otherwise.
bool Imaging::take_parameters(const seanet::HeadParameters& p, const seanet::V3B* v3b, Time now) {
    if (!usable(p) || (settings_.head.refuse_while_centring && !centred(now))) return false;
    parameters_ = p;
    settings_of_ = {Setting{{p.tx_n1, p.rx_n1, p.slope1}, p.ad_span, p.ad_low, p.initial_gain1},
                    Setting{{p.tx_n2, p.rx_n2, p.slope2}, p.ad_span, p.ad_low, p.initial_gain2}};
    if (v3b) take_gains(*v3b);
    scan_.configure({has(bits::cont), has(bits::scanright), has(bits::stare_llim), has(bits::motoff),
                     p.left_limit, p.right_limit, p.step_size});
    lines_ = 0;
    aux_under_way_ = false;
    configured(now);
    return true;
}

void Imaging::take_gains(const seanet::V3B& v) {
    settings_of_ = {Setting{settings_of_[0].channel, v.ad_span1, v.ad_low1, v.initial_gain1},
                    Setting{settings_of_[1].channel, v.ad_span2, v.ad_low2, v.initial_gain2}};
    if (!settings_.acoustics.tunable) return;  // a DST knows no slope
    if (v.adv_slope1 != 0) settings_of_[0].channel.slope = v.adv_slope1;
    if (v.adv_slope2 != 0) settings_of_[1].channel.slope = v.adv_slope2;
}

/// Of the channel that the next line uses. A DST has one, whatever the chan2 bit says.
const Imaging::Setting& Imaging::setting() const {
    bool second = settings_.acoustics.tunable && has(bits::chan2);
    if (settings_.ping_pong && has(bits::pingpong) && lines_ % 2 == 1) second = !second;
    return settings_of_[second ? 1 : 0];
}

void Imaging::begin(Time now) {
    tuning_ = tune(settings_.acoustics, setting().channel);
    Shot shot = line_shot(*parameters_, settings_, tuning_, scan_.position());
    const Time answer = ping_time(shot);
    const Time period = answer + line_time(reply_bytes(shot));
    // If the driver asks in time; an echosounder in between listens at another frequency.
    shot.interval = side_work_due() > now + period ? to_seconds(period) : 0;
    shot.ping = begin_ping(now + answer);
    actions_.ping = Ping{std::move(shot), now + answer};
}

std::size_t Imaging::reply_bytes(const Shot& shot) const {
    return head_data_overhead + (has(bits::adc8on) ? shot.bins : (shot.bins + 1) / 2);
}

/// From the transmission to the first byte of the reply; the line time follows on the wire.
Time Imaging::ping_time(const Shot& shot) const {
    const double window = static_cast<double>(shot.bins) * shot.bin_interval;
    const double motor = scan_.step() * parameters_->motor_time * 10e-6;
    const double wire = to_seconds(line_time(reply_bytes(shot)));
    double period = settings_.period_scale * (window + motor);
    if (settings_.period_law == "B") period = 2 * period - wire;
    if (settings_.period_law == "fixed") period = settings_.fixed_period - wire;
    return from_seconds(std::max(period, window));
}

Actions Imaging::heard(const Echogram& echogram, Time now) {
    if (!is_under_way(echogram.shot.ping)) return take_actions();
    if (aux_under_way_) {
        sounded(echogram, now);
        return take_actions();
    }
    ++counters_.pings;
    const seanet::HeadData line = head_data(echogram);
    reply(line);
    scan_.advance();
    ++lines_;
    const std::size_t appended = send_aux();
    finish_reply(now, head_data_overhead + line.bins.size() + appended);
    return take_actions();
}

std::uint8_t Imaging::head_status() const {
    namespace status = seanet::head_status;
    std::uint8_t bits = has(bits::adc8on) ? status::data_8bit : std::uint8_t{0};
    const int line = lines_ + 1;
    if (settings_.motor_error_after > 0 && line > settings_.motor_error_after) bits |= status::motor_error;
    if (settings_.power_loss_every > 0 && line % settings_.power_loss_every == 0) bits |= status::power_loss;
    if (!aux_text_.empty()) bits |= status::message_appended;
    return bits;
}

seanet::HeadData Imaging::head_data(const Echogram& echogram) const {
    const seanet::HeadParameters& p = *parameters_;
    const Setting& s = setting();
    auto levels = levels_8bit(echogram, settings_.acoustics, tuning_, s.gain);
    seanet::HeadData line;
    line.device_type =
        settings_.device_type < 0 ? p.hd_type : static_cast<std::uint8_t>(settings_.device_type);
    line.head_status = head_status();
    line.sweep_code = scan_.sweep_code();
    line.hd_ctrl = shown_hd_ctrl(p.hd_ctrl, settings_.head);
    line.range_scale = p.range_scale;
    line.tx_n = s.channel.tx_n;
    line.gain = s.gain;
    line.slope = s.channel.slope;
    line.ad_span = s.ad_span;
    line.ad_low = s.ad_low;
    line.ad_interval = p.ad_interval;
    line.left_limit = p.left_limit;
    line.right_limit = p.right_limit;
    line.step_size = p.step_size;
    line.bearing = scan_.position();
    line.bins =
        has(bits::adc8on) ? std::move(levels) : pack_4bit(levels, settings_.packing, s.ad_low, s.ad_span);
    return line;
}

Time Imaging::side_work_due() const {
    return settings_.aux.connected && parameters_ ? next_aux_ : Time::max();
}

void Imaging::begin_side_work(Time now) {
    Shot shot = aux_shot(settings_.aux);
    shot.ping = begin_side_ping();
    aux_under_way_ = true;
    next_aux_ = now + from_seconds(settings_.aux.period);
    actions_.ping = Ping{std::move(shot), now + from_seconds(aux_window(settings_.aux))};
}

/// The depth is appended to the next line, or comes alone while nobody asks for lines.
void Imaging::sounded(const Echogram& echogram, Time now) {
    aux_under_way_ = false;
    aux_text_ = aux_text(echogram, settings_.aux).value_or("");
    finish_side_work(now, has_requests() ? 0 : send_aux());
}

/// The bytes of the frame; 0 if there is nothing to say.
std::size_t Imaging::send_aux() {
    if (aux_text_.empty()) return 0;
    const std::string text = std::exchange(aux_text_, {});
    reply(seanet::AuxData{{text.begin(), text.end()}});
    return aux_data_overhead + text.size();
}

}  // namespace echoloop::tritech
