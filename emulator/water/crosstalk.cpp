#include "emulator/water/crosstalk.h"

#include <algorithm>
#include <cmath>

#include "emulator/contract/random_key.h"
#include "render/fan/arrays.h"
#include "render/view.h"

namespace echoloop {
namespace {

constexpr Time farthest = std::chrono::seconds(1);  ///< as travel time: 1.5 km
constexpr Time memory = std::chrono::seconds(62);   ///< the longest window and the way

double band_of(const Shot& shot) {
    if (shot.bandwidth > 0) return shot.bandwidth;
    return shot.pulse_length > 0 ? 1 / shot.pulse_length : 1;
}

/// Of one array towards another head, in the frame of its fan.
Vec3 towards(const Shot& shot, const Pose& from, Vec3 to) {
    const Quat world_from_fan = from.orientation * sonar_from_fan(shot.pan, shot.tilt);
    const Vec3 way = to - from.position;
    const double length = norm(way);
    return length < 1e-3 ? Vec3{0, 0, 1} : rotate(conjugate(world_from_fan), 1 / length * way);
}

/// Amplitude 0..1 with which a transmitter reaches a direction.
double transmitted_amplitude(const Shot& shot, const FanPattern& pattern, Vec3 direction) {
    const FanDirection seen = pattern.at(direction);
    const double width = pattern.half_width();
    const bool in_sector =
        seen.bearing > shot.bearings.front() - width && seen.bearing < shot.bearings.back() + width;
    const double amplitude = shot.bearings.size() == 1 || in_sector ? std::abs(seen.transmit) : 0;
    return std::max(amplitude, db_to_amplitude(CrossTalk::side_level));
}

/// Power 0..1 by which an axis of beams hears an angle off each of them.
double heard(const std::optional<TwoWayPattern>& pattern, double angle, double box) {
    if (!pattern) return std::abs(angle) <= box / 2 ? 1 : 0;
    const double amplitude = pattern->amplitude(angle);
    return amplitude * amplitude;
}

/// The same for rows of beams.
std::vector<double> received_by_rows(const Shot& shot, const FanPattern& pattern, Vec3 direction) {
    const FanDirection seen = pattern.at(direction);
    std::vector<double> out;
    out.reserve(shot.beams());
    for (const double elevation : shot.elevations) {
        const double row = heard(pattern.upwards(), seen.elevation - elevation, shot.fan_height);
        for (const double axis : shot.bearings)
            out.push_back(row * heard(pattern.across(), (seen.bearing - axis) * std::cos(seen.elevation),
                                      shot.beam_width));
    }
    return out;
}

/// Power 0..1 with which each beam receives from a direction.
std::vector<double> received_powers(const Shot& shot, const FanPattern& pattern, Vec3 direction) {
    if (shot.rows() > 1) return received_by_rows(shot, pattern, direction);
    const FanDirection seen = pattern.at(direction);
    std::vector<double> out(shot.bearings.size(), seen.receive * seen.receive);
    if (out.size() == 1) return out;
    if (!pattern.across()) {
        for (std::size_t i = 0; i < out.size(); ++i)
            if (std::abs(seen.bearing - shot.bearings[i]) > shot.beam_width / 2) out[i] = 0;
        return out;
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double amplitude = pattern.across()->amplitude(seen.bearing - shot.bearings[i]);
        out[i] *= amplitude * amplitude;
    }
    return out;
}

/// Exponential with mean 1, of a counter.
double exponential(std::uint64_t key) {
    const double uniform = (static_cast<double>(split_mix(key) >> 11) + 0.5) * 0x1p-53;
    return -std::log(uniform);
}

}  // namespace

double band_overlap(const Shot& pulse, const Shot& receiver) {
    const double width = band_of(pulse);
    const double listens = receiver.receiver.bandwidth > 0 ? receiver.receiver.bandwidth : band_of(receiver);
    const double low = std::max(pulse.frequency - width / 2, receiver.frequency - listens / 2);
    const double high = std::min(pulse.frequency + width / 2, receiver.frequency + listens / 2);
    return std::clamp((high - low) / width, 0.0, 1.0);
}

void CrossTalk::transmitted(const Transmission& transmission) {
    while (!recent_.empty() && recent_.front().time < transmission.time - memory) recent_.pop_front();
    for (ArrayShot& array : arrays_of(transmission.shot, transmission.world_from_sonar)) {
        auto& bearings = array.shot.bearings;
        if (bearings.size() > 2) bearings = {bearings.front(), bearings.back()};
        auto& elevations = array.shot.elevations;
        if (elevations.size() > 2) elevations = {elevations.front(), elevations.back()};
        Transmission one = transmission;
        one.shot = std::move(array.shot), one.world_from_sonar = array.world_from_sonar;
        const auto later = std::ranges::upper_bound(recent_, one.time, {}, &Transmission::time);
        recent_.insert(later, std::move(one));
    }
}

const FanPattern& CrossTalk::pattern_of(const Shot& shot) {
    return patterns_.get([&](const FanPattern& known) { return known.fits(shot); },
                         [&] { return std::pair(FanPattern(shot, effects_), std::size_t{1}); });
}

std::vector<ForeignPulse> CrossTalk::pulses_in(const Echogram& echogram, const Transmission& own) {
    std::vector<ForeignPulse> pulses;
    if (!effects_.has(Effect::cross_talk)) return pulses;
    const Shot& shot = echogram.shot;
    const Time begin = own.time + from_seconds(shot.first_bin_time);
    const Time end = begin + from_seconds(static_cast<double>(shot.bins) * shot.bin_interval);
    const auto first = std::ranges::lower_bound(recent_, begin - farthest, {}, &Transmission::time);
    for (auto other = first; other != recent_.end() && other->time < end; ++other)
        if (other->device != own.device && band_overlap(other->shot, shot) > 0)
            if (auto pulse = pulse_in(echogram, own, *other)) pulses.push_back(*std::move(pulse));
    return pulses;
}

std::optional<ForeignPulse> CrossTalk::pulse_in(const Echogram& echogram, const Transmission& own,
                                                const Transmission& other) {
    const Shot& shot = echogram.shot;
    const Vec3 from = other.world_from_sonar.position, to = own.world_from_sonar.position;
    const double range = norm(to - from), spread = std::max(range, 1.0);
    const double arrival =
        to_seconds(other.time - own.time) + range / echogram.sound_speed - shot.first_bin_time;
    const double first = arrival / shot.bin_interval;
    const double last = first + std::max(other.shot.pulse_length, 1e-9) / shot.bin_interval;
    if (!(last > 0 && first < static_cast<double>(shot.bins))) return std::nullopt;

    const double absorption =
        effects_.has(Effect::absorption) ? absorption_db_per_km(water_, other.shot.frequency) / 1e3 : 0;
    const double spreading = effects_.has(Effect::spreading) ? 20 * std::log10(spread) : 0;
    const double amplitude = transmitted_amplitude(other.shot, pattern_of(other.shot),
                                                   towards(other.shot, other.world_from_sonar, to));
    const double power = db_to_power(other.shot.source_level - spreading - absorption * range) * amplitude *
                         amplitude * band_overlap(other.shot, shot);
    std::vector<double> receive;
    for (const ArrayShot& array : arrays_of(shot, own.world_from_sonar)) {
        const auto heard = received_powers(array.shot, pattern_of(array.shot),
                                           towards(array.shot, array.world_from_sonar, from));
        receive.insert(receive.end(), heard.begin(), heard.end());
    }
    return ForeignPulse{
        first, last, power, std::move(receive),
        split_mix(split_mix(shot.random_key ^ other.shot.random_key) ^ shot.ping) ^ other.shot.ping};
}

void CrossTalk::add(std::span<const ForeignPulse> pulses, Echogram& echogram) const {
    const Shot& shot = echogram.shot;
    const double clip = effects_.has(Effect::saturation) ? db_to_power(shot.receiver.saturation_level)
                                                         : std::numeric_limits<double>::infinity();
    for (const ForeignPulse& pulse : pulses) {
        const auto begin = static_cast<std::size_t>(std::max(0.0, pulse.first));
        const auto end = std::min(shot.bins, static_cast<std::size_t>(std::ceil(pulse.last)));
        for (std::size_t beam = 0; beam < pulse.receive.size(); ++beam)
            for (std::size_t bin = begin; bin < end; ++bin) {
                const double at = static_cast<double>(bin);
                const double share = std::min(pulse.last, at + 1) - std::max(pulse.first, at);
                const double fades =
                    effects_.has(Effect::speckle) ? exponential(split_mix(pulse.key + beam) + bin) : 1;
                float& value = echogram.values[beam * shot.bins + bin];
                value = static_cast<float>(
                    std::min(value + pulse.power * pulse.receive[beam] * share * fades, clip));
            }
    }
}

}  // namespace echoloop
