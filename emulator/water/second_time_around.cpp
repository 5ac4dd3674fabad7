#include "emulator/water/second_time_around.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "emulator/contract/random_key.h"
#include "render/acoustics/receiver_noise.h"
#include "render/fan/arrays.h"
#include "render/view.h"

namespace echoloop {
namespace {

constexpr std::size_t most_beams = 128, most_bins = 512;
constexpr double strongest_target = 20;  ///< dB: a sphere of 20 m
constexpr double silent_margin = 100;    ///< dB below thermal noise, for pings without noise
constexpr double longest_window = 60;    ///< s, what a renderer accepts
constexpr float faint = 0.01F;           ///< of the mean noise: not heard
constexpr int most_spared = 31;          ///< pings in a row
constexpr double most_moved = 0.5, most_turned = deg_to_rad(1);  ///< m and rad, meanwhile

/// dB re 1 uPa of the strongest echo that can come from `range` m.
double loudest_echo(const Shot& shot, const Water& water, const Effects& effects, double range) {
    const double absorption =
        effects.has(Effect::absorption) ? absorption_db_per_km(water, shot.frequency) / 1e3 : 0;
    const double spreading = effects.has(Effect::spreading) ? 40 * std::log10(range) : 0;
    double level = shot.sides.empty() ? shot.source_level : -std::numeric_limits<double>::infinity();
    for (const Side& side : shot.sides) level = std::max(level, side.source_level);
    return level - spreading - 2 * absorption * range + strongest_target;
}

double quietest(const Shot& shot, const Effects& effects) {
    const double noise = 10 * std::log10(received_noise(shot));
    return effects.has(Effect::noise) ? noise : noise - silent_margin;
}

/// Every n-th beam, so that at most `most_beams` are left.
template <typename Value>
std::vector<Value> thinned(const std::vector<Value>& beams) {
    const std::size_t step = (beams.size() + most_beams - 1) / most_beams;
    std::vector<Value> out;
    for (std::size_t i = step / 2; i < beams.size(); i += step) out.push_back(beams[i]);
    return out;
}

/// The beam of `late` that looks where each beam of `bearings` does, or nearest to it.
std::vector<std::size_t> nearest_beams(const std::vector<double>& bearings, const std::vector<double>& late) {
    std::vector<std::size_t> out;
    std::size_t nearest = 0;
    for (const double bearing : bearings) {
        while (nearest + 1 < late.size() &&
               std::abs(late[nearest + 1] - bearing) < std::abs(late[nearest] - bearing))
            ++nearest;
        out.push_back(nearest);
    }
    return out;
}

/// Which bins of a ping hear each of its late bins: [first[i], first[i + 1]) hear the i-th of those from
/// `late` on.
struct BinMap {
    BinMap(const Shot& shot, const Shot& before) {
        for (std::size_t bin = 0; bin < shot.bins; ++bin) {
            const double time = shot.first_bin_time + (static_cast<double>(bin) + 0.5) * shot.bin_interval;
            const double place = (before.interval + time - before.first_bin_time) / before.bin_interval;
            if (!(place >= 0 && place < static_cast<double>(before.bins))) continue;
            const auto heard = static_cast<std::size_t>(place);
            if (first.empty()) late = heard;
            while (late + first.size() <= heard) first.push_back(bin);
            last = bin + 1;
        }
        if (!first.empty()) first.push_back(last);
    }
    std::size_t late = 0, last = 0;
    std::vector<std::size_t> first;
};

/// rad, of the rotation from one to the other.
double turned(const Quat& one, const Quat& other) {
    const Quat by = conjugate(one) * other;
    return 2 * std::atan2(norm({by.x, by.y, by.z}), std::abs(by.w));
}

bool nearly_same(const Pose& one, const Pose& other) {
    return norm(one.position - other.position) <= most_moved &&
           turned(one.orientation, other.orientation) <= most_turned;
}

bool nearly_same(const std::vector<double>& one, const std::vector<double>& other) {
    return std::ranges::equal(one, other, [](double a, double b) { return std::abs(a - b) <= most_turned; });
}

}  // namespace

std::optional<Shot> late_shot(const Shot& shot, const Water& water, const Effects& effects, double farthest) {
    const double window = static_cast<double>(shot.bins) * shot.bin_interval;
    const double begin = shot.interval + shot.first_bin_time;
    if (shot.rows() > 1) return std::nullopt;  // sonars that image at once are too high for far echoes
    if (!effects.has(Effect::second_time_around) || !(shot.interval > 0) || begin + window > longest_window)
        return std::nullopt;
    const double range = sound_speed(water) / 2 * begin;
    if (range > farthest || loudest_echo(shot, water, effects, range) < quietest(shot, effects))
        return std::nullopt;
    Shot late = shot;
    late.bearings = thinned(shot.bearings);
    late.sides = thinned(shot.sides);
    late.first_bin_time = begin;
    late.bins = std::min(shot.bins, most_bins);
    late.bin_interval = window / static_cast<double>(late.bins);
    // The ping that hears it has noise of its own: this one gets next to none, in the same band.
    late.receiver = Receiver{.bandwidth = shot.receiver.bandwidth, .directivity_index = 400};
    late.errors.unit = unit_of(shot);
    late.velocities = false;
    late.random_key = split_mix(shot.random_key);
    return late;
}

bool SecondTimeAround::nearly_same(const View& one, const Shot& late, const Situation& situation) {
    const Shot& before = one.late;
    if (!echoloop::nearly_same(before.bearings, late.bearings)) return false;
    Shot same = before;
    same.ping = late.ping, same.bearings = late.bearings;
    same.pan = late.pan, same.tilt = late.tilt;
    const auto of_fan = [](const Shot& shot, const Situation& seen) {
        return seen.world_from_sonar * Pose{{}, sonar_from_fan(shot.pan, shot.tilt)};
    };
    return same == late && echoloop::nearly_same(of_fan(before, one.situation), of_fan(late, situation)) &&
           std::ranges::equal(one.situation.movers, situation.movers,
                              [](const Pose& a, const Pose& b) { return echoloop::nearly_same(a, b); });
}

bool SecondTimeAround::asks(std::uint64_t sequence, const Shot& late, const Situation& situation) {
    if (silent_ && spared_ < most_spared && nearly_same(*silent_, late, situation)) {
        ++spared_;
        return false;
    }
    asked_.insert_or_assign(sequence, View{late, situation});
    return true;
}

void SecondTimeAround::keep(std::uint64_t sequence, Echogram late) {
    late_.insert_or_assign(sequence, std::move(late));
}

void SecondTimeAround::add_to(std::uint64_t sequence, Echogram& echogram) {
    // Those of the ping itself may be known before it is delivered; they wait for the next.
    late_.erase(late_.begin(), late_.lower_bound(sequence - 1));
    asked_.erase(asked_.begin(), asked_.lower_bound(sequence - 1));
    const auto found = late_.extract(sequence - 1);
    if (found.empty()) return;
    auto view = asked_.extract(sequence - 1);
    const Echogram& late = found.mapped();
    const auto loudest = std::ranges::max_element(late.values);
    silent_.reset(), spared_ = 0;
    if (loudest == late.values.end() || *loudest < faint * static_cast<float>(echogram.noise_power)) {
        if (!view.empty()) silent_ = std::move(view.mapped());
        return;
    }
    const Shot &shot = echogram.shot, &before = late.shot;
    const auto beam_of = nearest_beams(shot.bearings, before.bearings);
    const BinMap bins(shot, before);
    for (std::size_t beam = 0; beam < beam_of.size(); ++beam) {
        const auto from = late.beam(beam_of[beam]);
        float* to = &echogram.values[beam * shot.bins];
        for (std::size_t i = 0; i + 1 < bins.first.size(); ++i)
            for (std::size_t bin = bins.first[i]; bin < bins.first[i + 1]; ++bin)
                to[bin] += from[bins.late + i];
    }
}

}  // namespace echoloop
