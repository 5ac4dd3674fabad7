#include "emulator/devices/family/tritech/head.h"

#include <algorithm>
#include <utility>

#include "protocols/seanet/codec.h"

namespace echoloop::tritech {

Head::Head(const HeadSettings& settings)
    : settings_(settings),
      hosts_(seanet::Framer(settings.frame_lengths)),
      boot_(settings.boot),
      requests_(settings.replies, settings.queue_requests) {}

std::vector<Port> Head::ports() const { return {{"line", Port::Kind::stream, {}, false}}; }

Actions Head::started(Time now) {
    boot_.restart(now);
    return take_actions();
}

Actions Head::received(const Received& data, Time now) {
    const Peer host{data.port, data.from};
    seanet::Framer& framer = hosts_.of(host);
    framer.feed(data.bytes);
    while (const auto frame = framer.next()) obey(*frame, host, now);
    return take_actions();
}

Actions Head::woken(Time now) {
    if (now >= boot_.next_alive()) send_alive(now);
    if (now >= next_begin_) begin_due(now);
    return take_actions();
}

void Head::reconnected(std::size_t port) { hosts_.clear(port); }

DeviceCounters Head::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes = hosts_.skipped_bytes();
    return counters;
}

/// Whatever a head does not understand it drops without a word.
void Head::obey(const seanet::Frame& frame, const Peer& host, Time now) {
    const bool for_us = frame.header.rx_node == settings_.node || frame.header.rx_node == seanet::nodes::host;
    const auto message = seanet::parse(frame);
    const Peer before = host_;
    host_ = host;
    const bool understood = for_us && message && seanet::from_host(*message) &&
                            (answer(*message, now) || configure(*message, now));
    if (!understood) host_ = before;
    ++(understood ? counters_.messages : counters_.rejected);
}

bool Head::answer(const seanet::Message& message, Time now) {
    if (std::holds_alternative<seanet::ReBoot>(message)) {
        reboot(now);
    } else if (std::holds_alternative<seanet::SendVersion>(message)) {
        reply(settings_.version);
    } else if (std::holds_alternative<seanet::SendBBUser>(message)) {
        send_user_block();
    } else if (std::holds_alternative<seanet::StopAlives>(message)) {
        boot_.stop_alives();
    } else if (const auto* send_data = std::get_if<seanet::SendData>(&message)) {
        request(*send_data, now);
    } else {
        return false;
    }
    return true;
}

void Head::reboot(Time now) {
    drop_requests();
    has_parameters_ = false;
    forget();
    boot_.restart(now);
}

void Head::send_user_block() {
    reply(settings_.user_block);
    if (settings_.dst) {
        reply(settings_.fpga_cal);
        reply(settings_.fpga_version);
    }
    boot_.bb_user_sent();
}

void Head::request(const seanet::SendData& request, Time now) {
    boot_.set_clock(request.time_ms, now);
    if (!ready(now) && !settings_.answers_early) return;
    requests_.ask();
    schedule(now);
}

void Head::configured(Time now) {
    const bool early = !has_parameters_ && requests_.any();
    drop_requests();
    if (early) requests_.ask();
    has_parameters_ = true;
    boot_.head_command();
    // Some drivers wait only a second for the alive that acknowledges their parameters.
    boot_.hasten_alive(now);
    if (now >= boot_.next_alive()) send_alive(now);
    schedule(now);
}

void Head::drop_requests() {
    requests_.clear();
    under_way_ = false;
    next_begin_ = Time::max();
    ++ping_;
}

void Head::send_alive(Time now) { reply(boot_.alive(now, position())); }

/// Decides when the water is used next. The serial port sends one reply while the head does nothing else.
void Head::schedule(Time now) {
    next_begin_ = Time::max();
    if (under_way_ || !has_parameters_) return;
    const Time free = std::max({now, boot_.centred_at(), line_free_});
    if (requests_.any()) next_begin_ = std::max(free, boot_.wake_motor(free));
    const Time side = side_work_due();
    if (side != Time::max()) next_begin_ = std::min(next_begin_, std::max(free, side));
    if (next_begin_ <= now) begin_due(now);
}

void Head::begin_due(Time now) {
    next_begin_ = Time::max();
    if (under_way_ || !ready(now)) return;
    const bool turn_of_line = requests_.any() && side_work_last_;  // slow side work must not starve lines
    side_work_last_ = now >= side_work_due() && !turn_of_line;
    if (side_work_last_) {
        begin_side_work(now);
    } else if (requests_.any()) {
        requests_.take();
        begin(now);
    }
}

Time Head::line_time(std::size_t frame_bytes) const {
    if (settings_.line_rate <= 0) return {};
    return from_seconds(10.0 * static_cast<double>(frame_bytes) / settings_.line_rate);
}

std::uint64_t Head::begin_ping(Time due) {
    boot_.line_served(due);
    return begin_side_ping();
}

std::uint64_t Head::begin_side_ping() {
    under_way_ = true;
    return ++ping_;
}

void Head::finish_reply(Time now, std::size_t bytes) {
    boot_.line_served(std::max(now, line_free_) + line_time(bytes));
    finish_side_work(now, bytes);
}

void Head::finish_side_work(Time now, std::size_t bytes) {
    under_way_ = false;
    line_free_ = std::max(now, line_free_) + line_time(bytes);
    schedule(now);
}

void Head::reply(const seanet::Message& message) {
    actions_.send.push_back(
        {0, seanet::encode(message, {settings_.node, settings_.head_data_remaining}), host_.address, {}});
}

Actions Head::take_actions() {
    actions_.wake = std::min(boot_.next_alive(), next_begin_);
    return std::exchange(actions_, {});
}

}  // namespace echoloop::tritech
