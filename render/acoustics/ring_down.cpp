#include "render/acoustics/ring_down.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/acoustics/line_noise.h"
#include "render/acoustics/vector_math.h"
#include "render/simd.h"

namespace echoloop {
namespace {

constexpr std::size_t correlated = 4;  // bins from one number of the scatter to the next
constexpr double beams_alike = 2;      // beam widths; images of an Oculus: .9 from beam to beam, .1 over four
constexpr std::size_t at_once = 64;    // bins, whole steps of `correlated`
constexpr std::uint64_t unit = 0x554E4954;  // in place of a ping's number

using Bins = std::array<float, at_once>;

/// The two of `count` places round the circle, the first astern, that a bearing lies between.
struct Neighbours {
    Neighbours(double bearing, double count) {
        const double turns = bearing / (2 * std::numbers::pi) + 0.5;
        const double place = (turns - std::floor(turns)) * count, whole = std::floor(place);
        const auto places = static_cast<std::uint32_t>(std::ceil(count));
        first = static_cast<std::uint32_t>(whole) % places;
        second = (first + 1) % places;
        share = static_cast<float>(place - whole);
    }
    /// Of numbers of variance 1, one of variance 1.
    float mixed(float a, float b) const {
        const float rest = 1 - share;
        return (rest * a + share * b) / std::sqrt(rest * rest + share * share);
    }

    std::uint32_t first = 0, second = 0;
    float share = 0;
};

/// The curve at a time, or nothing outside it.
bool at_time(const std::vector<RingDown::Point>& points, double time, RingDown::Point& out) {
    if (points.empty() || time < points.front().time || time > points.back().time) return false;
    const auto after = std::ranges::upper_bound(points, time, {}, &RingDown::Point::time);
    if (after == points.end()) {
        out = points.back();
        return true;
    }
    const RingDown::Point &a = *std::prev(after), &b = *after;
    const double part = (time - a.time) / (b.time - a.time);
    out = {time, std::lerp(a.level, b.level, part), std::lerp(a.scatter, b.scatter, part),
           std::lerp(a.lasting, b.lasting, part)};
    return true;
}

/// Unit variance at every bin, correlated over some: numbers `correlated` bins apart, blended between.
template <class Number>
void blend(std::size_t first, Number number, Bins& out) {
    for (std::size_t i = 0; i < at_once; i += correlated) {
        const auto index = static_cast<std::uint32_t>((first + i) / correlated);
        const float a = number(index), b = number(index + 1);
        for (std::size_t k = 0; k < correlated; ++k) {
            const float share = static_cast<float>(k) / correlated, rest = 1 - share;
            out[i + k] = (rest * a + share * b) / std::sqrt(rest * rest + share * share);
        }
    }
}

ECHOLOOP_SIMD void add_decibels(const float* level, const float* scatter, const float* lasting,
                                const float* of_line, const float* of_bearing, float source_level,
                                std::size_t count, float* power) {
    constexpr float per_db = 0.23025851F;  // ln 10 / 10
    for (std::size_t i = 0; i < count; ++i) {
        const float db = source_level + level[i] + scatter[i] * of_line[i] + lasting[i] * of_bearing[i];
        power[i] += vector_math::exp(per_db * db);
    }
}

}  // namespace

RingDownPlan::RingDownPlan(const Shot& shot, Effects effects) {
    const RingDown* ring = shot.receiver.ring_down.get();
    if (ring == nullptr || !effects.has(Effect::ring_down)) return;
    const double late = ring->pulse > 0 ? std::max(0.0, shot.pulse_length - ring->pulse) : 0;
    for (std::size_t bin = 0; bin < shot.bins; ++bin) {
        const double time = shot.first_bin_time + (static_cast<double>(bin) + 0.5) * shot.bin_interval;
        RingDown::Point point;
        // What comes later with a longer pulse lasts until then as it began.
        const double begun = ring->points.empty() ? 0 : ring->points.front().time;
        if (!at_time(ring->points, time < begun ? time : std::max(begun, time - late), point)) {
            if (level_.empty()) continue;
            break;
        }
        if (level_.empty()) first_ = bin;
        level_.push_back(static_cast<float>(point.level));
        scatter_.push_back(static_cast<float>(point.scatter));
        lasting_.push_back(static_cast<float>(point.lasting));
    }
    bearings_ = ring->bearings;
    cell_ = std::max(beams_alike * shot.beam_width, 1e-3);
}

void RingDownPlan::add(const LineKey& line, double source_level, std::span<float> values) const {
    constexpr double nothing = -100;  // dB: a sonar that does not send
    if (level_.empty() || source_level < nothing) return;
    const Neighbours near(line.bearing, 2 * std::numbers::pi / cell_);
    const auto numbers_of = [&](std::uint64_t place, std::size_t first, Bins& out) {
        const std::uint64_t a = line_hash(line.key, place, near.first, LineNoise::ring_down),
                            b = line_hash(line.key, place, near.second, LineNoise::ring_down);
        blend(
            first, [&](std::uint32_t k) { return near.mixed(normal_of(mix(a, k)), normal_of(mix(b, k))); },
            out);
    };
    Bins of_ping, of_unit;
    if (!bearings_.empty()) {
        const Neighbours listed(line.bearing, static_cast<double>(bearings_.size()));
        of_unit.fill(static_cast<float>(
            std::lerp(bearings_[listed.first], bearings_[listed.second], double{listed.share})));
    }
    for (std::size_t i = 0; i < level_.size(); i += at_once) {
        numbers_of(line.ping, i, of_ping);
        if (bearings_.empty()) numbers_of(unit, i, of_unit);
        add_decibels(&level_[i], &scatter_[i], &lasting_[i], of_ping.data(), of_unit.data(),
                     static_cast<float>(source_level), std::min(at_once, level_.size() - i),
                     values.data() + first_ + i);
    }
}

}  // namespace echoloop
