#include "emulator/water/second_time_around.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "emulator/contract/random_key.h"
#include "render/acoustics/chain.h"
#include "render/fan/arrays.h"

namespace echoloop {
namespace {

constexpr std::size_t most_beams = 128, most_bins = 512;
constexpr double strongest_target = 20;  ///< dB: a sphere of 20 m
constexpr double silent_margin = 100;    ///< dB below thermal noise, for pings without noise
constexpr double longest_window = 60;    ///< s, what a renderer accepts

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
    const double noise = thermal_noise_level(shot.frequency) + 10 * std::log10(noise_bandwidth(shot)) -
                         shot.receiver.directivity_index;
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

/// Which late bin each of the bins `first`, `first` + 1, ... of a ping hears; the others hear none.
struct BinMap {
    BinMap(const Shot& shot, const Shot& before) {
        for (std::size_t bin = 0; bin < shot.bins; ++bin) {
            const double time = shot.first_bin_time + (static_cast<double>(bin) + 0.5) * shot.bin_interval;
            const double place = (before.interval + time - before.first_bin_time) / before.bin_interval;
            if (!(place >= 0 && place < static_cast<double>(before.bins))) continue;
            if (late_bin.empty()) first = bin;
            late_bin.push_back(static_cast<std::uint32_t>(place));
        }
    }
    std::size_t first = 0;
    std::vector<std::uint32_t> late_bin;
};

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

void SecondTimeAround::keep(std::uint64_t sequence, Echogram late) {
    late_.insert_or_assign(sequence, std::move(late));
}

void SecondTimeAround::add_to(std::uint64_t sequence, Echogram& echogram) {
    // Those of the ping itself may be known before it is delivered; they wait for the next.
    late_.erase(late_.begin(), late_.lower_bound(sequence - 1));
    const auto found = late_.extract(sequence - 1);
    if (found.empty()) return;
    const Echogram& late = found.mapped();
    const Shot &shot = echogram.shot, &before = late.shot;
    const auto beam_of = nearest_beams(shot.bearings, before.bearings);
    const BinMap bins(shot, before);
    for (std::size_t beam = 0; beam < beam_of.size(); ++beam) {
        const auto from = late.beam(beam_of[beam]);
        float* to = &echogram.values[beam * shot.bins];
        for (std::size_t i = 0; i < bins.late_bin.size(); ++i) to[bins.first + i] += from[bins.late_bin[i]];
    }
}

}  // namespace echoloop
