#include "emulator/devices/tritech-profiler/pass.h"

#include <algorithm>

namespace echoloop::profiler {
namespace {

constexpr int circle = seanet::angle_units;

std::uint16_t wrap(int angle) { return static_cast<std::uint16_t>(((angle % circle) + circle) % circle); }

}  // namespace

Pass::Pass(std::uint16_t left, std::uint16_t right, std::uint8_t step, const PassRules& rules)
    : rules_(rules), left_(wrap(left)), width_(wrap(right - left)), step_(step), clockwise_(rules.clockwise) {
    const bool full = width_ == 0;
    if (full) width_ = circle - 1;
    if (step_ == 0) return;
    const bool rest = width_ % step_ != 0 && !rules_.whole_steps && !full;
    pings_ = std::min<std::size_t>(width_ / step_ + 1U + (rest ? 1U : 0U), most_pings);
}

/// From the limit where the pass begins.
std::uint16_t Pass::offset(std::size_t ping) const {
    return static_cast<std::uint16_t>(std::min<std::size_t>(ping * step_, width_));
}

std::uint16_t Pass::bearing(std::size_t ping) const {
    if (rules_.stare) return left_;
    return clockwise_ ? wrap(left_ + offset(ping)) : wrap(left_ + width_ - offset(ping));
}

std::uint16_t Pass::way_to(std::size_t ping) const {
    if (rules_.stare) return 0;
    if (ping > 0) return static_cast<std::uint16_t>(offset(ping) - offset(ping - 1));
    if (!began_ || rules_.alternate) return 0;
    const std::uint16_t back = offset(pings_ - 1);
    return std::min<std::uint16_t>(back, static_cast<std::uint16_t>(circle - back));
}

void Pass::turn() {
    began_ = true;
    if (rules_.alternate) clockwise_ = !clockwise_;
}

}  // namespace echoloop::profiler
