#include "emulator/devices/teledyne-dvl/dvl.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "emulator/devices/family/doppler/moment.h"
#include "emulator/devices/family/doppler/teledyne_period.h"

namespace echoloop::teledyne_dvl {
namespace {

constexpr std::size_t longest_command = 128;  // B

}  // namespace

Dvl::Dvl(const Settings& settings)
    : settings_(settings),
      setup_(settings.start),
      pacer_(settings.sensors, jitter::processor),
      measurement_(settings) {}

std::vector<Port> Dvl::ports() const { return {{"line", Port::Kind::stream, {}, false}}; }

Actions Dvl::started(Time now) {
    if (settings_.pings_at_start)
        start_pinging(now);
    else
        say(banner(settings_));
    ping_if_due(now);
    return take_actions();
}

void Dvl::reconnected(std::size_t) {
    line_.clear();
    breaks_ = 0;
    last_ = 0;
}

std::int64_t Dvl::clock(Time now) const { return doppler::unix_us(settings_.unix_start, now) + clock_error_; }

void Dvl::say(const std::string& text) { actions_.send.push_back({0, {text.begin(), text.end()}, {}, {}}); }

void Dvl::start_pinging(Time now) {
    pinging_ = true;
    waits_for_end_ = !setup_.pings_by_itself;
    const doppler::Acoustics& a = settings_.acoustics;
    modes_ = doppler::usual_modes(a.lowest_altitude, std::min(0.1 * setup_.most_depth, a.highest_altitude));
    search_.restart(0, modes_.size() - 1);
    altitude_ = 0;
    if (waits_for_end_)
        say("<");
    else
        pacer_.start(now, from_seconds(plan_.period));
}

void Dvl::stop_pinging() {
    pinging_ = false;
    pacer_.stop();
    say(banner(settings_));
}

Actions Dvl::received(const Received& data, Time now) {
    for (const std::uint8_t byte : data.bytes) hear_byte(static_cast<char>(byte), now);
    ping_if_due(now);
    return take_actions();
}

void Dvl::hear_byte(char c, Time now) {
    const bool ends = c == '\r' || c == '\n', second = c == '\n' && last_ == '\r';
    breaks_ = (c == '+' || c == '=') && (breaks_ == 0 || c == last_) ? breaks_ + 1 : 0;
    last_ = c;
    if (second) return;
    if (breaks_ == 3) {
        breaks_ = 0;
        line_.clear();
        stop_pinging();
        return;
    }
    if (pinging_ && waits_for_end_) {
        if (ends) pacer_.start(now, from_seconds(plan_.period));
        return;
    }
    if (pinging_) {
        if (!settings_.input_is_break || c == '+' || c == '=') return;
        line_.clear();
        stop_pinging();
    }
    if (ends) return end_line(now);
    if (c < ' ' || c > '~') {
        ++counters_.skipped_bytes;
        return;
    }
    say(std::string(1, c));
    if (line_.size() < longest_command) line_ += c;
}

void Dvl::end_line(Time now) {
    const Reply reply = obey(line_, setup_, settings_, clock(now));
    line_.clear();
    ++(reply.good ? counters_.messages : counters_.rejected);
    if (reply.clock) clock_error_ += *reply.clock - clock(now);
    if (!reply.text.empty()) say(reply.text);
    if (reply.wake) say(banner(settings_));
    if (reply.start) {
        say("\r\n");
        start_pinging(now);
    }
}

double Dvl::period_of(double altitude) const {
    const double line = settings_.baud > 0 ? 10 * static_cast<double>(last_size_) / settings_.baud : 0;
    return std::max({doppler::teledyne_period(altitude), 1.05 * line, 0.01 * setup_.interval});
}

const doppler::Mode& Dvl::mode_to(double depth) const {
    std::size_t mode = 0;
    while (mode + 1 < modes_.size() && modes_[mode].farthest < depth) ++mode;
    return modes_[mode];
}

double Dvl::time_to(double depth) const {
    constexpr double margin = 1.01;  // for whole bins
    return margin * 2 * depth / std::cos(settings_.acoustics.tilt) / setup_.sound_speed;
}

void Dvl::ping_if_due(Time now) {
    if (!pinging_ || !pacer_.begin(now)) return;
    if (waits_for_end_) pacer_.once();
    const double layer = 0.1 * setup_.layer_far;  // m
    const bool water = setup_.bottom_pings > 0 && setup_.water_mode > 0;
    const doppler::Mode& mode = setup_.water_mode == 3 ? mode_to(layer) : modes_.at(search_.next(true, now));
    plan_ = doppler::make_plan(mode, setup_.sound_speed, settings_);
    if (water) plan_.window = std::max(plan_.window, time_to(layer));
    plan_.period = std::max(plan_.window + settings_.processing_time,
                            period_of(altitude_ > 0 ? altitude_ : mode.farthest));
    actions_.ping = Ping{doppler::make_shot(plan_, settings_, ++shots_),
                         now + from_seconds(plan_.window + settings_.processing_time)};
}

/// Water track, if one is wanted. The same ping does both; in mode 3 the bottom is not told.
void Dvl::hear_layer(Report& report, const WaterPing& ping) const {
    const bool lost = !report.measured.valid;
    const bool wanted =
        setup_.bottom_pings > 0 && (setup_.water_mode & 1 || (setup_.water_mode == 2 && lost));
    if (!wanted) return;
    double nearest = 0;
    for (const doppler::BeamReport& beam : report.measured.beams) {
        const double range = vertical_range(beam, settings_);
        if (range > 0) nearest = nearest > 0 ? std::min(nearest, range) : range;
    }
    report.water = layer_of(ping, nearest, setup_, settings_);
    if (setup_.water_mode == 3)
        report.measured = doppler::Measurement::nothing(settings_, report.measured.speed_of_sound);
}

Report Dvl::report_of(const Echogram& echogram, Time began) {
    Report out;
    const double alignment = deg_to_rad(0.01 * setup_.alignment);
    const doppler::Assumed assumed{static_cast<double>(setup_.sound_speed), alignment, false};
    out.measured = measurement_.measure(echogram, assumed, plan_, began);
    const doppler::Attitude truth = doppler::attitude_of(measurement_.attitude());
    const Sensors& s = settings_.sensors;
    const double heading = rad_to_deg(truth.heading);
    out.attitude.heading =
        deg_to_rad(s.read_bearing("heading", heading < 0 ? heading + 360 : heading, stray::compass, began));
    out.attitude.pitch = deg_to_rad(s.read("pitch", rad_to_deg(truth.pitch), stray::tilt, began));
    out.attitude.roll = deg_to_rad(s.read("roll", rad_to_deg(truth.roll), stray::tilt, began));
    out.temperature = s.read("water", settings_.temperature, stray::water_temperature, began);
    out.period = plan_.period;
    out.pulse = plan_.pulse * setup_.sound_speed / 2;
    const WaterPing ping{echogram, doppler::turned(measurement_.motion(), alignment), began};
    if (setup_.profile_pings > 0) out.profile = profile_of(ping, out.attitude, out.pulse, setup_, settings_);
    hear_layer(out, ping);
    return out;
}

void Dvl::follow_water(Report& report, const Setup& in_earth, double seconds, Time began) {
    if (!report.water) return;
    const Velocities own = water_velocities(report, in_earth);
    for (std::size_t i = 0; i < 3; ++i) way_in_water_[i] -= own[i].value_or(0) * seconds;
    report.way_in_water = way_in_water_;
    if (own[0]) last_good_water_ = began;
    report.since_in_water = to_seconds(began - last_good_water_.value_or(Time{}));
}

Actions Dvl::heard(const Echogram& echogram, Time now) {
    const Time began = pacer_.began().value_or(now);
    if (!pacer_.end(now, from_seconds(plan_.period))) return take_actions();
    ++counters_.pings;
    if (pinging_ && echogram.beams() == settings_.azimuths.size()) {
        Report report = report_of(echogram, began);
        const double altitude = report.measured.altitude;
        search_.found(altitude > 0 ? std::optional(altitude) : std::nullopt, modes_, now);
        if (!search_.lost()) {
            altitude_ = std::max(altitude, 0.0);
            report.number = ++ensembles_;
            report.unix_us = clock(began);
            const double seconds = followed_ ? to_seconds(began - *followed_) : 0;
            followed_ = began;
            Setup in_earth = setup_;
            in_earth.frame = Frame::earth;
            const Velocities own = bottom_velocities(report, in_earth);
            for (std::size_t i = 0; i < 3; ++i) way_[i] -= own[i].value_or(0) * seconds;
            report.way = way_;
            if (own[0]) last_good_ = began;
            report.since = to_seconds(began - last_good_.value_or(Time{}));
            follow_water(report, in_earth, seconds, began);
            Bytes bytes = report_bytes(report, setup_, settings_);
            last_size_ = bytes.size();
            actions_.send.push_back({0, std::move(bytes), {}, {}});
            if (waits_for_end_) say("<");
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

}  // namespace echoloop::teledyne_dvl
