#include "emulator/devices/ping360/ping360.h"

#include <algorithm>
#include <utility>

#include "emulator/devices/ping360/ranges.h"
#include "emulator/devices/ping360/samples.h"

namespace echoloop::ping360 {
namespace {

using ping::Id;

constexpr std::size_t most_waiting = 16;
constexpr Time restart_time = std::chrono::seconds(1), boot_loader_time = std::chrono::seconds(5);

bool is_discovery(const Port& port) { return port.kind == Port::Kind::datagram; }

/// Settings of an automatic scan of which nobody has asked yet: a full circle.
ping::AutoTransmit boot_scan() {
    ping::AutoTransmit scan;
    scan.stop_angle = circle - 1;
    scan.num_steps = 1;
    return scan;
}

}  // namespace

ping::AutoDeviceData automatic(ping::DeviceData d, const ping::AutoTransmit& scan) {
    return {d.mode,
            d.gain_setting,
            d.angle,
            d.transmit_duration,
            d.sample_period,
            d.transmit_frequency,
            scan.start_angle,
            scan.stop_angle,
            scan.num_steps,
            scan.delay,
            d.number_of_samples,
            std::move(d.data)};
}

Ping360::Ping360(const Settings& settings, std::vector<Port> lines)
    : settings_(settings),
      ports_(std::move(lines)),
      link_(2, settings.marks_are_breaks),
      discovery_(settings.announced),
      last_(boot_settings()),
      last_scan_(boot_scan()) {
    for (Port& port : discovery_.ports()) ports_.push_back(std::move(port));
}

std::vector<Port> Ping360::ports() const { return ports_; }

Actions Ping360::started(Time now) {
    last_move_ = now;
    return take_actions();
}

Actions Ping360::received(const Received& data, Time now) {
    if (now < silent_until_) return take_actions();
    if (is_discovery(ports_.at(data.port))) {
        hear_discovery(data, now);
        return take_actions();
    }
    const Peer peer{data.port, data.from};
    const auto heard = link_.receive(data);
    if (heard.line_break) end_jobs([&](const Peer& of) { return of == peer; }, now);
    for (const ping::Frame& frame : heard.frames) obey(frame, peer, now);
    return take_actions();
}

Actions Ping360::woken(Time now) {
    if (now >= transmit_at_) transmit(now);
    return take_actions();
}

/// Hosts that have no other way to a line break close the port and open it again.
void Ping360::reconnected(std::size_t port) {
    link_.reset(port);
    end_jobs([&](const Peer& of) { return of.port == port; }, last_move_);
}

void Ping360::line_rate(std::size_t port, double rate) { settings_.line.follow(port, rate); }

DeviceCounters Ping360::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes = link_.skipped_bytes();
    return counters;
}

void Ping360::on(const ping::Transducer& command, const Peer& peer, Time now) {
    if (const auto wrong = out_of_range(command); wrong && !settings_.accept_anything) {
        refuse(Id::transducer, *wrong, peer, now);
        return;
    }
    Job job{peer,
            {command.mode,
             command.gain_setting,
             command.angle,
             command.transmit_duration,
             command.sample_period,
             command.transmit_frequency,
             command.number_of_samples,
             {}},
            command.transmit != 0};
    if (scan_) stop();
    if (job_) {
        if (waiting_.size() < most_waiting)
            waiting_.push_back(std::move(job));
        else
            ++counters_.rejected;
        return;
    }
    job_ = std::move(job);
    begin(now);
}

void Ping360::on(const ping::AutoTransmit& command, const Peer& peer, Time now) {
    if (!settings_.scans_by_itself()) return refuse(Id::auto_transmit, unknown_command, peer, now);
    if (const auto wrong = out_of_range(command); wrong && !settings_.accept_anything) {
        refuse(Id::auto_transmit, *wrong, peer, now);
        return;
    }
    stop();
    last_scan_ = command;
    scan_.emplace(command, settings_.ends_twice);
    job_ = Job{peer,
               {command.mode,
                command.gain_setting,
                0,
                command.transmit_duration,
                command.sample_period,
                command.transmit_frequency,
                command.number_of_samples,
                {}},
               true,
               command};
    begin(now);
}

void Ping360::on(const ping::MotorOff&, const Peer& peer, Time now) {
    stop();
    motor_on_ = false;
    reply(ping::Ack{static_cast<std::uint16_t>(Id::motor_off)}, peer, now);
}

void Ping360::on(const ping::Reset& command, const Peer&, Time now) {
    stop();
    last_ = boot_settings();
    last_scan_ = boot_scan();
    angle_ = 0;
    motor_on_ = true;
    last_move_ = now;
    silent_until_ = now + (command.bootloader != 0 ? boot_loader_time : restart_time);
}

void Ping360::reply(const ping::Message& message, const Peer& peer, Time now) {
    const std::vector<Send> sent{link_.reply(message, peer)};
    actions_.send.push_back(sent.front());
    line_free_ = std::max(line_free_, now) + settings_.line.time(sent);
}

void Ping360::refuse(Id id, std::string_view text, const Peer& peer, Time now) {
    ++counters_.rejected;
    reply(ping_device::nack(id, text), peer, now);
}

/// Drops everything at hand; the echo of a ping in the water is stale from now on. Commands that are never
/// answered for that count as refused.
void Ping360::stop() {
    counters_.rejected += waiting_.size() + (job_ && !scan_ ? 1 : 0);
    job_.reset();
    scan_.reset();
    waiting_.clear();
    under_way_ = false;
    transmit_at_ = Time::max();
}

/// A line break, which is the business of those only who share the line with it.
void Ping360::end_jobs(const std::function<bool(const Peer&)>& is_on_that_line, Time now) {
    counters_.rejected += std::erase_if(waiting_, [&](const Job& job) { return is_on_that_line(job.peer); });
    if (!job_ || !is_on_that_line(job_->peer)) return;
    if (!scan_) ++counters_.rejected;
    scan_.reset();
    under_way_ = false;
    transmit_at_ = Time::max();
    next_job(now);
}

/// The job at hand turns the head as soon as the line is free, and no earlier than `earliest`.
void Ping360::begin(Time earliest) {
    if (scan_) job_->settings.angle = static_cast<std::uint16_t>(scan_->angle());
    const Time start = std::max(earliest, line_free_);
    transmit_at_ = start + turn_duration(job_->settings.angle % circle, start);
}

/// The short way round; from the home position if the motor was off.
Time Ping360::turn_duration(int to, Time now) const {
    const int apart = std::abs(to - angle_), homed = std::min(to, circle - to);
    if (apart == 0) return {};
    const bool idle = settings_.idle_off > 0 && to_seconds(now - last_move_) > settings_.idle_off;
    const int steps = idle || !motor_on_ ? circle + homed : std::min(apart, circle - apart);
    return from_seconds(settings_.turn_time * steps / circle);
}

void Ping360::transmit(Time now) {
    transmit_at_ = Time::max();
    if (!job_) return;
    motor_on_ = true;
    angle_ = job_->settings.angle % circle;
    last_move_ = now;
    if (!job_->transmit) {
        answer({}, now);
        return;
    }
    Shot shot = shot_from(job_->settings, angle_, settings_);
    shot.ping = ++ping_;
    const double processing = settings_.by_ethernet.at(job_->peer.port) ? settings_.ethernet_time : 0;
    const double time = static_cast<double>(shot.bins) * shot.bin_interval + processing;
    const int step = scan_ ? scan_->step() : 1;
    shot.interval = time + settings_.turn_time * step / circle;  // if the host asks in time
    under_way_ = true;
    actions_.ping = Ping{std::move(shot), now + from_seconds(time)};
}

Actions Ping360::heard(const Echogram& echogram, Time now) {
    if (!under_way_ || !job_ || echogram.shot.ping != ping_) return take_actions();
    under_way_ = false;
    ++counters_.pings;
    answer(samples_8bit(echogram, settings_, job_->settings.gain_setting), now);
    return take_actions();
}

void Ping360::answer(std::vector<std::uint8_t> samples, Time now) {
    ping::DeviceData data = job_->settings;
    if (!settings_.echo_400) data.angle = static_cast<std::uint16_t>(data.angle % circle);
    data.data = std::move(samples);
    last_ = data;
    if (const auto& a = job_->automatic) {
        reply(automatic(std::move(data), *a), job_->peer, now);
    } else {
        reply(std::move(data), job_->peer, now);
    }
    next_job(now);
}

void Ping360::next_job(Time now) {
    if (scan_) {
        scan_->advance();
        begin(std::max(now, line_free_) + std::chrono::milliseconds(job_->automatic->delay));
        return;
    }
    job_.reset();
    if (waiting_.empty()) return;
    job_ = std::move(waiting_.front());
    waiting_.pop_front();
    begin(now);
}

Actions Ping360::take_actions() {
    actions_.wake = transmit_at_;
    return std::exchange(actions_, {});
}

}  // namespace echoloop::ping360
