#include "emulator/devices/tritech-micron/micron.h"

#include <algorithm>
#include <utility>

#include "emulator/devices/tritech-micron/bins.h"
#include "protocols/seanet/codec.h"

namespace echoloop::micron {
namespace {

constexpr int most_queued_requests = 1000;
constexpr std::size_t head_data_overhead = 45;  // bytes of a frame beside its bins

}  // namespace

Micron::Micron(const Settings& settings)
    : settings_(settings), framer_(settings.frame_lengths), boot_(settings_), scan_(settings.scan) {}

std::vector<Port> Micron::ports() const { return {{"line", Port::Kind::stream, {}, false}}; }

Actions Micron::started(Time now) {
    boot_.restart(now);
    return take_actions();
}

Actions Micron::received(const Received& data, Time now) {
    framer_.feed(data.bytes);
    while (const auto frame = framer_.next()) obey(*frame, now);
    return take_actions();
}

Actions Micron::woken(Time now) {
    if (now >= boot_.next_alive()) send_alive(now);
    if (now >= next_line_) begin_line(now);
    return take_actions();
}

void Micron::reconnected(std::size_t) { framer_.clear(); }

DeviceCounters Micron::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes = framer_.skipped_bytes();
    return counters;
}

/// Whatever a head does not understand it drops without a word.
void Micron::obey(const seanet::Frame& frame, Time now) {
    const bool for_us = frame.header.rx_node == settings_.node || frame.header.rx_node == seanet::nodes::host;
    const auto message = seanet::parse(frame);
    if (!for_us || !message) {
        ++counters_.rejected;
        return;
    }
    std::visit(
        [&](const auto& m) {
            if constexpr (requires { on(m, now); }) {
                ++counters_.messages;
                on(m, now);
            } else {
                ++counters_.rejected;  // a message that only sonars send
            }
        },
        *message);
}

void Micron::on(const seanet::ReBoot&, Time now) {
    forget_requests();
    parameters_.reset();
    scan_.centre();
    boot_.restart(now);
}

void Micron::on(const seanet::SendVersion&, Time) {
    seanet::VersionData version;
    version.software_version = settings_.software_version;
    version.info_bits = 1;  // board type sonar
    version.serial_number = settings_.serial_number;
    version.node = settings_.node;
    reply(version);
}

void Micron::on(const seanet::SendBBUser&, Time) {
    seanet::BBUserData block;
    if (!settings_.dst) block.device_marker = 0;
    reply(block);
    if (settings_.dst) {
        reply(seanet::FpgaCalData{});
        reply(seanet::FpgaVersionData{});
    }
    boot_.bb_user_sent();
}

void Micron::on(const seanet::StopAlives&, Time) { boot_.stop_alives(); }

void Micron::on(const seanet::HeadCommand& command, Time now) { configure(command.parameters, now); }

/// Drivers that send zeros in V3B demand the main ADSpan and ADLow back, so the main fields count.
void Micron::on(const seanet::HeadCommandDual& command, Time now) { configure(command.parameters, now); }

void Micron::on(const seanet::HeadCommandReverse&, Time) {
    if (!parameters_) return;
    parameters_->hd_ctrl ^= seanet::hd_ctrl::scanright;
    scan_.reverse();
}

void Micron::on(const seanet::HeadCommandGain& command, Time) {
    if (!parameters_) return;
    parameters_->ad_span = command.v3b.ad_span1;
    parameters_->ad_low = command.v3b.ad_low1;
    parameters_->initial_gain1 = command.v3b.initial_gain1;
}

void Micron::configure(const seanet::HeadParameters& parameters, Time now) {
    namespace bits = seanet::hd_ctrl;
    if (!usable(parameters) || (settings_.refuse_while_centring && !boot_.centred(now))) {
        ++counters_.rejected;
        return;
    }
    const bool early = !parameters_ && pending_requests_ > 0;
    forget_requests();
    if (early) pending_requests_ = 1;
    parameters_ = parameters;
    const auto has = [&](std::uint16_t bit) { return (parameters.hd_ctrl & bit) != 0; };
    scan_.configure({has(bits::cont), has(bits::scanright), has(bits::stare_llim), has(bits::motoff),
                     parameters.left_limit, parameters.right_limit, parameters.step_size});
    boot_.head_command();
    // Some drivers wait only a second for the alive that acknowledges their parameters.
    boot_.hasten_alive(now);
    if (now >= boot_.next_alive()) send_alive(now);
    if (pending_requests_ > 0) next_line_ = std::max(now, boot_.centred_at());
}

void Micron::forget_requests() {
    lines_left_ = pending_requests_ = 0;
    line_under_way_ = false;
    next_line_ = Time::max();
    ++ping_;
}

void Micron::send_alive(Time now) { reply(boot_.alive(now, scan_.position())); }

void Micron::on(const seanet::SendData& request, Time now) {
    boot_.set_clock(request.time_ms, now);
    const bool busy = line_under_way_ || lines_left_ > 0 || next_line_ != Time::max();
    if (ready(now) && !busy) {
        lines_left_ = settings_.replies;
        ask_for_line(now);
        return;
    }
    if (!ready(now) && settings_.early_request == "ignore") return;
    pending_requests_ = settings_.queue_requests ? std::min(pending_requests_ + 1, most_queued_requests) : 1;
    if (parameters_ && !busy) next_line_ = std::max(now, boot_.centred_at());
}

/// The serial port sends one line while the head does nothing else.
void Micron::ask_for_line(Time now) {
    if (line_free_ <= now)
        begin_line(now);
    else
        next_line_ = line_free_;
}

void Micron::begin_line(Time now) {
    next_line_ = Time::max();
    if (!ready(now)) return;
    if (lines_left_ == 0) {
        if (pending_requests_ == 0) return;
        --pending_requests_;
        lines_left_ = settings_.replies;
    }
    --lines_left_;
    line_under_way_ = true;
    Shot shot = shot_from(*parameters_, settings_, scan_.position());
    shot.ping = ++ping_;
    const Time answer = ping_time(shot);
    shot.interval = to_seconds(answer + line_time(reply_bytes(shot)));  // if the driver asks in time
    const Time due = now + answer;
    actions_.ping = Ping{std::move(shot), due};
    boot_.line_served(due);
}

Time Micron::line_time(std::size_t frame_bytes) const {
    return settings_.baud > 0 ? from_seconds(10.0 * static_cast<double>(frame_bytes) / settings_.baud)
                              : Time{};
}

std::size_t Micron::reply_bytes(const Shot& shot) const {
    const bool bits8 = (parameters_->hd_ctrl & seanet::hd_ctrl::adc8on) != 0;
    return head_data_overhead + (bits8 ? shot.bins : (shot.bins + 1) / 2);
}

/// From the transmission to the first byte of the reply; the line time follows on the wire.
Time Micron::ping_time(const Shot& shot) const {
    const double window = static_cast<double>(shot.bins) * shot.bin_interval;
    const double motor = scan_.step() * parameters_->motor_time * 10e-6;
    const double wire = to_seconds(line_time(reply_bytes(shot)));
    double period = settings_.period_scale * (window + motor);
    if (settings_.period_law == "B") period = 2 * period - wire;
    if (settings_.period_law == "fixed") period = settings_.fixed_period - wire;
    return from_seconds(std::max(period, window));
}

Actions Micron::heard(const Echogram& echogram, Time now) {
    if (!line_under_way_ || echogram.shot.ping != ping_ || !parameters_) return take_actions();
    line_under_way_ = false;
    ++counters_.pings;
    const seanet::HeadData line = head_data(echogram);
    reply(line);
    scan_.advance();
    line_free_ = now + line_time(head_data_overhead + line.bins.size());
    boot_.line_served(line_free_);
    if (lines_left_ > 0 || pending_requests_ > 0) next_line_ = line_free_;
    return take_actions();
}

seanet::HeadData Micron::head_data(const Echogram& echogram) const {
    const seanet::HeadParameters& p = *parameters_;
    const bool bits8 = (p.hd_ctrl & seanet::hd_ctrl::adc8on) != 0;
    auto levels = levels_8bit(echogram, settings_, p.initial_gain1);
    seanet::HeadData line;
    line.device_type = settings_.device_type;
    line.head_status = bits8 ? seanet::head_status::data_8bit : std::uint8_t{0};
    line.sweep_code = scan_.sweep_code();
    line.hd_ctrl = static_cast<std::uint16_t>((p.hd_ctrl | settings_.hd_ctrl_set) & ~settings_.hd_ctrl_clear);
    line.range_scale = p.range_scale;
    line.tx_n = p.tx_n1;
    line.gain = p.initial_gain1;
    line.slope = p.slope1;
    line.ad_span = p.ad_span;
    line.ad_low = p.ad_low;
    line.ad_interval = p.ad_interval;
    line.left_limit = p.left_limit;
    line.right_limit = p.right_limit;
    line.step_size = p.step_size;
    line.bearing = scan_.position();
    line.bins = bits8 ? std::move(levels) : pack_4bit(levels, settings_, p.ad_low, p.ad_span);
    return line;
}

template <class Message>
void Micron::reply(const Message& message) {
    actions_.send.push_back(
        {0, seanet::encode(message, {settings_.node, settings_.head_data_remaining}), {}, {}});
}

Actions Micron::take_actions() {
    actions_.wake = std::min(boot_.next_alive(), next_line_);
    return std::exchange(actions_, {});
}

}  // namespace echoloop::micron
