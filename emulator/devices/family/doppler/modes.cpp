#include "emulator/devices/family/doppler/modes.h"

#include <algorithm>

namespace echoloop::doppler {
namespace {

constexpr Time between_tries = std::chrono::seconds(10);
constexpr int patience = 3;  // pings without a bottom before it looks elsewhere; own choice

}  // namespace

Modes usual_modes(double lowest, double highest) {
    constexpr double often = 1000;  // Hz
    const double end = std::max(highest, 2 * lowest);
    Modes modes{{lowest, 1.5, often}, {0.7, 7, often}, {3, 30, often}, {12, end, often}};
    while (modes.size() > 1 && modes.back().nearest >= 0.8 * end) modes.pop_back();
    for (Mode& mode : modes) mode.farthest = std::min(mode.farthest, end);
    modes.back().farthest = end;
    return modes;
}

void ModeSearch::restart(std::size_t lowest, std::size_t highest) {
    *this = {};
    lowest_ = mode_ = lowest;
    highest_ = highest;
}

std::size_t ModeSearch::next(bool cycling, Time now) {
    trying_ = false;
    if (!locked_ || !cycling || mode_ == lowest_ || now < last_try_ + between_tries) return mode_;
    last_try_ = now;
    trying_ = true;
    tried_ = tried_ > lowest_ && tried_ < mode_ ? tried_ - 1 : mode_ - 1;
    return tried_;
}

void ModeSearch::found(std::optional<double> altitude, const Modes& modes, Time now) {
    lost_ = trying_ && !altitude;
    if (lost_) return;
    if (trying_) mode_ = tried_;
    if (!altitude) {
        if (locked_ && ++misses_ < patience) return;
        locked_ = false;
        mode_ = mode_ < highest_ ? mode_ + 1 : lowest_;
        return;
    }
    if (!locked_) last_try_ = now;
    locked_ = true;
    misses_ = 0;
    constexpr double margin = 0.1;  // of the limits, before it changes over; own choice
    const Mode now_in = modes.at(mode_);
    if (*altitude > (1 - margin) * now_in.farthest && mode_ < highest_)
        ++mode_;
    else if (*altitude < (1 + margin) * now_in.nearest && mode_ > lowest_)
        --mode_;
}

}  // namespace echoloop::doppler
