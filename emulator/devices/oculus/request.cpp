#include "emulator/devices/oculus/request.h"

#include <algorithm>
#include <cmath>

#include "emulator/devices/family/survey/sound_speed.h"
#include "protocols/oculus/codec.h"

namespace echoloop::oculus_device {
namespace {

namespace flag = oculus::flag;

constexpr std::size_t overhead = 2048;  // bytes of a message that are no image

bool makes_sense(const oculus::Fire& f) {
    const bool finite = std::isfinite(f.range) && std::isfinite(f.gain) && std::isfinite(f.sound_speed) &&
                        std::isfinite(f.salinity);
    return finite && (f.mode == oculus::Mode::low_frequency || f.mode == oculus::Mode::high_frequency);
}

double rate_of(oculus::Rate rate) {
    switch (rate) {
        case oculus::Rate::hz15:
            return 15;
        case oculus::Rate::hz40:
            return 40;
        case oculus::Rate::hz5:
            return 5;
        case oculus::Rate::hz2:
            return 2;
        default:  // of others nothing is known
            return 10;
    }
}

bool wants_32_bit(const Request& r) { return r.v2 && (r.wish.ext_flags & flag::data_32_bit) != 0; }

oculus::DataSize data_size_of(const Request& r, const Settings& s) {
    if (wants_32_bit(r)) return oculus::DataSize::bits32;
    return r.has(flag::data_16_bit) == s.data_16_bit_set ? oculus::DataSize::bits16 : oculus::DataSize::bits8;
}

double range_of(const Request& r, const Settings& s) {
    const double longest = figures_of(r, s.acoustics).range;
    const bool percent = !r.has(flag::range_in_metres) || (s.percent_in_32_bit && wants_32_bit(r));
    const double wanted = percent ? r.fire().range / 100 * longest : r.fire().range;
    return std::clamp(wanted, s.acoustics.shortest_range, longest);
}

double sound_speed_of(const Request& r, const Settings& s, Time now) {
    constexpr double slowest = 1300, fastest = 1700;  // m/s
    const double wanted = r.fire().sound_speed;
    const double salinity = std::clamp(r.fire().salinity, 0.0, 45.0);
    return std::clamp(wanted != 0 ? wanted : sound_speed(water_temperature(s, now), salinity), slowest,
                      fastest);
}

double gain_of(const Request& r, const Settings& s) {
    const double gain = std::clamp(r.fire().gain, 0.0, 100.0);
    return r.high() && s.scaled_gain_echo ? 40 + 0.6 * gain : gain;
}

/// Mbit/s.
double network_speed(const Request& r, const Settings& s) {
    const int limit = r.fire().network_speed;
    return limit == 0 || limit == 0xFF ? s.link_speed : std::min<double>(limit, s.link_speed);
}

/// `hertz` as a whole fraction of a clock.
double divided(double clock, double hertz) { return clock / std::max(1.0, std::round(clock / hertz)); }

/// Rows as fine as the samples, or of as many samples as keep their number in bounds.
void plan_rows(Plan& plan, const ModeFigures& mode, std::size_t most) {
    constexpr double clock = 75e6;  // Hz; three real pings have rows of 286 of its cycles
    const double rate = divided(clock, mode.sample_rate);
    const double finest = plan.sound_speed / 2 / rate;
    const double samples =
        std::max(1.0, std::ceil(std::floor(plan.range / finest) / static_cast<double>(most)));
    plan.row_time = samples / rate;
    plan.rows = std::max<std::size_t>(1, static_cast<std::size_t>(plan.range / (finest * samples)));
}

}  // namespace

std::optional<Request> read_request(const oculus::Fire& fire) {
    if (!makes_sense(fire)) return std::nullopt;
    return Request{false, {fire, 0, {}}};
}

std::optional<Request> read_request(const oculus::FireV2& fire) {
    if (!makes_sense(fire.fire)) return std::nullopt;
    return Request{true, fire};
}

const ModeFigures& figures_of(const Request& request, const Acoustics& acoustics) {
    return request.high() ? acoustics.high : acoustics.low;
}

/// The converter's steps are an own choice; the three pings of a recording have one sound speed.
double water_temperature(const Settings& s, Time now) {
    Stray sensor = stray::water_temperature;
    sensor.step = 0.0625;
    return s.sensors.read("water", s.temperature, sensor, now);
}

Plan make_plan(const Request& r, const Settings& s, Time now) {
    const ModeFigures& mode = figures_of(r, s.acoustics);
    Plan plan;
    plan.sound_speed = sound_speed_of(r, s, now);
    plan.range = range_of(r, s);
    plan_rows(plan, mode, s.acoustics.rows);
    plan.beams = r.has(flag::beams_512) ? s.acoustics.beams : 256;
    plan.data_size = data_size_of(r, s);
    plan.gain = gain_of(r, s);
    plan.due = 2 * plan.range / plan.sound_speed + s.processing_time;
    const std::size_t row_bytes = plan.beams * plan.sample_bytes() + (r.has(flag::gain_words) ? 4 : 0);
    const auto bytes = static_cast<double>(overhead + plan.rows * row_bytes);
    plan.transfer = 8e-6 * bytes / network_speed(r, s);
    plan.period = std::max({1 / rate_of(r.fire().rate), 1 / mode.rate, plan.due, plan.transfer});
    return plan;
}

Shot make_shot(const Request& r, const Plan& plan, const Settings& s, std::uint32_t ping) {
    const Acoustics& a = s.acoustics;
    const ModeFigures& mode = figures_of(r, a);
    Shot shot;
    shot.ping = ping;
    shot.bearings = oculus::bearings(plan.beams, mode.aperture);
    shot.beam_width = mode.beam_width;
    shot.fan_height = mode.fan_height;
    shot.bins = plan.rows;
    shot.bin_interval = plan.row_time;
    constexpr double clock = 281.25e6;  // Hz; three real pings have its 134th part
    shot.frequency = divided(clock, mode.frequency);
    shot.pulse_length = a.pulse_length;
    shot.bandwidth = mode.bandwidth;
    shot.source_level = mode.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    shot.errors = a.errors;
    shot.receiver.directivity_index = mode.directivity_index;
    shot.receiver.self_noise = mode.self_noise;
    shot.interval = plan.period;
    return shot;
}

double sound_speed(double t, double salinity) { return survey::sound_speed(t, salinity, 0); }

oculus::Ipv4 to_ipv4(std::uint32_t ip) {
    const auto byte = [ip](int shift) { return static_cast<std::uint8_t>(ip >> shift & 0xFF); };
    return {byte(24), byte(16), byte(8), byte(0)};
}

}  // namespace echoloop::oculus_device
