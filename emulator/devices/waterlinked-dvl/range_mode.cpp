#include "emulator/devices/waterlinked-dvl/range_mode.h"

#include <algorithm>
#include <array>

namespace echoloop::waterlinked_dvl {
namespace {

constexpr Time between_tries = std::chrono::seconds(10);
constexpr int patience = 3;  // pings without a bottom before it looks elsewhere; own choice
// The maker's table; where it gives a span of rates, the middle of it.
constexpr std::array table{ModeFigures{0.05, 0.6, 15}, ModeFigures{0.3, 3, 10}, ModeFigures{1.5, 14, 5.5},
                           ModeFigures{7.7, 36, 7.5}, ModeFigures{15, 0, 3}};

std::optional<int> digit(char c) {
    return c >= '0' && c < '0' + modes ? std::optional(c - '0') : std::nullopt;
}

}  // namespace

std::optional<RangeMode> read_range_mode(std::string_view text) {
    RangeMode mode;
    mode.text = text;
    if (text == "auto") return mode;
    mode.water = text == "wt";
    if (mode.water) return mode;
    const bool one = text.size() == 2 && text[0] == '=';
    const bool span = text.size() == 4 && text.substr(1, 2) == "<=";
    if (!one && !span) return std::nullopt;
    const auto from = digit(one ? text[1] : text[0]), to = digit(text.back());
    if (!from || !to || *from > *to) return std::nullopt;
    mode.lowest = *from;
    mode.highest = *to;
    return mode;
}

ModeFigures figures_of(int mode, double highest_altitude) {
    ModeFigures figures = table.at(static_cast<std::size_t>(mode));
    figures.farthest = mode == modes - 1 ? highest_altitude : std::min(figures.farthest, highest_altitude);
    return figures;
}

void ModeSearch::restart(const RangeMode& allowed) {
    *this = {};
    allowed_ = allowed;
    mode_ = allowed.lowest;
}

int ModeSearch::next(bool cycling, Time now) {
    trying_ = false;
    if (!locked_ || !cycling || mode_ == allowed_.lowest || now < last_try_ + between_tries) return mode_;
    last_try_ = now;
    trying_ = true;
    tried_ = tried_ > allowed_.lowest && tried_ < mode_ ? tried_ - 1 : mode_ - 1;
    return tried_;
}

void ModeSearch::found(std::optional<double> altitude, double highest_altitude, Time now) {
    lost_ = trying_ && !altitude;
    if (lost_) return;
    if (trying_) mode_ = tried_;
    if (!altitude) {
        if (locked_ && ++misses_ < patience) return;
        locked_ = false;
        mode_ = mode_ < allowed_.highest ? mode_ + 1 : allowed_.lowest;
        return;
    }
    if (!locked_) last_try_ = now;
    locked_ = true;
    misses_ = 0;
    constexpr double margin = 0.1;  // of the limits, before it changes over; own choice
    const ModeFigures now_in = figures_of(mode_, highest_altitude);
    if (*altitude > (1 - margin) * now_in.farthest && mode_ < allowed_.highest)
        ++mode_;
    else if (*altitude < (1 + margin) * now_in.nearest && mode_ > allowed_.lowest)
        --mode_;
}

}  // namespace echoloop::waterlinked_dvl
