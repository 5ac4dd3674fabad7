#include "emulator/devices/dvl-wayfinder/dvl.h"

#include <algorithm>
#include <utility>

#include "emulator/devices/dvl-wayfinder/report.h"
#include "emulator/devices/family/doppler/moment.h"
#include "emulator/devices/family/doppler/teledyne_period.h"

namespace echoloop::dvl_wayfinder {
namespace {

constexpr std::size_t data_size = 98;  // B, of a ping's packet

}  // namespace

Dvl::Dvl(const Settings& settings)
    : settings_(settings),
      state_(state_of(settings)),
      pacer_(settings.sensors, jitter::processor),
      measurement_(settings) {
    choose_modes();
}

void Dvl::choose_modes() {
    const doppler::Acoustics& a = settings_.acoustics;
    const double range = static_cast<double>(state_.setup.most_range);
    modes_ = doppler::usual_modes(a.lowest_altitude, std::min(range, a.highest_altitude));
    search_.restart(0, modes_.size() - 1);
    altitude_ = 0;
}

std::int64_t Dvl::clock(Time now) const { return doppler::unix_us(settings_.unix_start, now) + clock_error_; }

double Dvl::rate() const {
    const double now = baud_of(state_.setup), first = baud_of(state_of(settings_).setup);
    return settings_.baud > 0 && now != first ? now : 0;
}

DeviceCounters Dvl::counters() const {
    DeviceCounters all = counters_;
    all.skipped_bytes = framer_.skipped_bytes();
    return all;
}

void Dvl::say(wayfinder::Kind kind, const wayfinder::Body& body, double rate) {
    Send send{0, wayfinder::encode({kind, body}), {}, {}};
    send.line_rate = rate;
    actions_.send.push_back(std::move(send));
}

Actions Dvl::started(Time now) {
    follow({.setup = state_.setup, .pinging = false}, false, now);
    ping_if_due(now);
    return take_actions();
}

Actions Dvl::received(const Received& data, Time now) {
    framer_.feed(data.bytes);
    while (const auto packet = framer_.next()) hear_packet(*packet, now);
    ping_if_due(now);
    return take_actions();
}

void Dvl::hear_packet(ByteView bytes, Time now) {
    const auto packet = wayfinder::parse(bytes);
    const State before = state_;
    const double before_rate = rate();
    const auto answer = packet && packet->kind == wayfinder::Kind::command
                            ? obey(packet->body, state_, settings_, clock(now))
                            : std::nullopt;
    if (!answer) {
        ++counters_.rejected;
        return;
    }
    const bool refused = std::holds_alternative<wayfinder::Refusal>(answer->body);
    ++(refused ? counters_.rejected : counters_.messages);
    if (answer->clock) clock_error_ += *answer->clock - clock(now);
    say(wayfinder::Kind::response, answer->body, before_rate);
    follow(before, answer->trigger, now);
}

void Dvl::follow(const State& before, bool trigger, Time now) {
    if (state_.setup.most_range != before.setup.most_range) choose_modes();
    if (before.pinging && !state_.pinging) return pacer_.stop();
    if (!state_.pinging) return;
    const bool waits = state_.setup.trigger != 0;
    if (trigger)
        pacer_.start(now, Time{});
    else if (waits && before.setup.trigger == 0)
        pacer_.pause();
    else if (!waits && (!before.pinging || before.setup.trigger != 0)) {
        if (!before.pinging) search_.restart(0, modes_.size() - 1);
        pacer_.start(now, from_seconds(plan_.period));
    }
}

double Dvl::period_of(double altitude) const {
    const double bits = settings_.baud <= 0 ? 0 : rate() > 0 ? rate() : settings_.baud;
    const double line = bits > 0 ? 10 * static_cast<double>(data_size) / bits : 0;
    return std::max(doppler::teledyne_period(altitude), 1.05 * line);
}

void Dvl::ping_if_due(Time now) {
    if (!state_.pinging || !pacer_.begin(now)) return;
    const bool triggered = state_.setup.trigger != 0;
    if (triggered) pacer_.once();
    // Each trigger has its report, so that none may be lost for a look at nearer depths.
    const doppler::Mode& mode = modes_.at(search_.next(!triggered, now));
    speed_ = static_cast<double>(state_.setup.sound_speed);
    plan_ = doppler::make_plan(mode, speed_, settings_);
    plan_.period = std::max(plan_.window + settings_.processing_time,
                            period_of(altitude_ > 0 ? altitude_ : mode.farthest));
    actions_.ping = Ping{doppler::make_shot(plan_, settings_, ++shots_),
                         now + from_seconds(plan_.window + settings_.processing_time)};
}

Actions Dvl::heard(const Echogram& echogram, Time now) {
    if (echogram.shot.ping != shots_) return take_actions();
    const Time began = pacer_.began().value_or(now);
    const Time interval = state_.setup.trigger != 0 ? Time{} : from_seconds(plan_.period);
    if (!pacer_.end(now, interval)) return take_actions();
    ++counters_.pings;
    if (state_.pinging && echogram.beams() == settings_.azimuths.size()) {
        const auto measured = measurement_.measure(echogram, {speed_, 0, false}, plan_, began);
        const double altitude = measured.altitude;
        search_.found(altitude > 0 ? std::optional(altitude) : std::nullopt, modes_, now);
        if (!search_.lost()) {
            altitude_ = std::max(altitude, 0.0);
            say(wayfinder::Kind::data, report_of(measured, clock(began), began, settings_), rate());
        }
    }
    ping_if_due(now);
    return take_actions();
}

Actions Dvl::woken(Time now) {
    ping_if_due(now);
    return take_actions();
}

Actions Dvl::take_actions() {
    actions_.wake = pacer_.wake();
    return std::exchange(actions_, {});
}

}  // namespace echoloop::dvl_wayfinder
