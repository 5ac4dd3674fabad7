#include "render/fan/closing_speeds.h"

#include <algorithm>
#include <cmath>

#include "render/paths/lobe_cells.h"

namespace echoloop {

std::vector<ClosingSpeed> closing_speeds(Summing& summing, BinningInput in) {
    std::vector<float> power, first, second, fresh;
    in.paths = {}, in.water = nullptr;
    summing.sum(in, power, fresh);
    in.moment = 1, summing.sum(in, first, fresh);
    in.moment = 2, summing.sum(in, second, fresh);
    std::vector<ClosingSpeed> speeds(power.size());
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        if (!(power[i] > 0)) continue;
        const double mean = double{first[i]} / power[i], square = double{second[i]} / power[i];
        speeds[i] = {static_cast<float>(mean - in.motion->fastest),
                     static_cast<float>(std::sqrt(std::max(0.0, square - mean * mean)))};
    }
    return speeds;
}

void shift_paths(const PingMotion& motion, PathEchoes& paths) {
    // No one of a path's ends tells which surface it met, so these count as at rest.
    const Vec3 own = motion.own;
    const auto closing = [&](double bearing, double elevation, double turned) {
        return dot(own, fan_direction(bearing - turned, elevation));
    };
    for (TargetEcho& echo : paths.targets)
        echo.range = motion.apparent(echo.range, closing(echo.bearing, echo.elevation, echo.turned));
    for (PathEcho& echo : paths.diffuse) {
        const double speed = closing(echo.bearing, echo.elevation, echo.turned);
        echo.near_range = static_cast<float>(motion.apparent(echo.near_range, speed));
        echo.far_range = static_cast<float>(motion.apparent(echo.far_range, speed));
    }
}

}  // namespace echoloop
