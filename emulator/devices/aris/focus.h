// The focus of an ARIS: where its lens belongs for a range, and the motor that moves it. Pure functions of
// time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "emulator/contract/device.h"

namespace echoloop::aris_device {

inline constexpr std::uint32_t last_focus_position = 1000;  ///< the first is 0, its home

enum class Lens { aris_1200_1800, aris_3000, telephoto };

/// Points of the maker's focus map (aris-integration-sdk, FocusMapData) at 15 degC: ranges in m, and
/// positions for fresh, brackish and salt water.
struct FocusCurve {
    std::array<double, 5> ranges;
    std::array<std::array<double, 5>, 3> positions;
};

inline const FocusCurve& focus_curve(Lens lens) {
    static constexpr FocusCurve wide{
        {0.8, 1, 2, 5, 30}, {{{0, 210, 590, 796, 913}, {0, 175, 570, 781, 900}, {0, 125, 540, 763, 887}}}};
    static constexpr FocusCurve close{
        {0.6, 0.8, 2, 5, 16},
        {{{1000, 843, 424, 252, 171}, {1000, 878, 449, 272, 189}, {1000, 926, 482, 299, 213}}}};
    static constexpr FocusCurve far{
        {2.5, 3, 5, 10, 36}, {{{0, 179, 537, 781, 945}, {0, 130, 503, 755, 926}, {0, 60, 454, 719, 898}}}};
    return lens == Lens::telephoto ? far : lens == Lens::aris_3000 ? close : wide;
}

/// For `range` m, in water of `salinity` ppt. Between points the position is linear in 1 / range, as of a
/// lens.
inline std::uint32_t focus_position(double range, Lens lens, std::uint32_t salinity) {
    const FocusCurve& curve = focus_curve(lens);
    const auto& positions = curve.positions[salinity >= 35 ? 2 : salinity >= 15 ? 1 : 0];
    const double r = std::clamp(range, curve.ranges.front(), curve.ranges.back());
    std::size_t i = 0;
    while (r > curve.ranges[i + 1]) ++i;
    const double near = 1 / curve.ranges[i], far = 1 / curve.ranges[i + 1];
    const double share = (near - 1 / r) / (near - far);
    return static_cast<std::uint32_t>(std::lround(std::lerp(positions[i], positions[i + 1], share)));
}

class FocusMotor {
  public:
    void go(std::uint32_t target, Time now) {
        from_ = position(now);
        started_ = now;
        target_ = std::min(target, last_focus_position);
    }
    std::uint32_t target() const { return target_; }
    std::uint32_t position(Time now) const {
        const double way = static_cast<double>(target_) - from_;
        const double gone = std::min(std::abs(way), speed * to_seconds(now - started_));
        return static_cast<std::uint32_t>(std::lround(from_ + std::copysign(gone, way)));
    }

  private:
    static constexpr double speed = 1000;  // positions/s: own choice; the maker's test waits 2 s for a move

    std::uint32_t from_ = 0, target_ = 0;
    Time started_{};
};

}  // namespace echoloop::aris_device
