#include "emulator/devices/s500/depth.h"

#include <algorithm>
#include <cmath>

#include "emulator/devices/family/sounder/bottom.h"

namespace echoloop::s500 {
namespace {

constexpr double no_confidence = 10, full_confidence = 25;  // dB above the noise
constexpr std::size_t pings = 20;

}  // namespace

Depth find_depth(const Echogram& echogram, const State& state, const Settings& settings) {
    const double speed = 1e-3 * state.speed_of_sound;
    echosounder::BottomRule rule;
    rule.blanking = 2 * settings.acoustics.nearest_range / speed;
    rule.margin = no_confidence;
    rule.absorption = settings.acoustics.absorption * speed;
    const auto bottom = echosounder::find_bottom(echogram, rule);
    if (!bottom) return {};
    const double time = echosounder::bin_time(echogram.shot, static_cast<double>(bottom->bin) + 0.5);
    const double share = (bottom->above_noise - no_confidence) / (full_confidence - no_confidence);
    return {time * speed / 2, std::round(100 * std::clamp(share, 0.0, 1.0))};
}

void SmoothDepth::add(const Depth& depth) {
    last_.push_back(depth);
    if (last_.size() > pings) last_.pop_front();
}

Depth SmoothDepth::mean() const {
    double metres = 0, confidence = 0, heard = 0;
    for (const Depth& depth : last_) {
        confidence += depth.confidence;
        if (depth.metres <= 0) continue;
        metres += depth.metres;
        ++heard;
    }
    if (heard == 0) return {};
    return {metres / heard, std::round(confidence / static_cast<double>(last_.size()))};
}

}  // namespace echoloop::s500
