#include "emulator/devices/sonar-3d-15/view.h"

#include <algorithm>
#include <cmath>

namespace echoloop::sonar_3d_15 {
namespace {

/// `count` angles with equal steps, half of them on either side of 0.
std::vector<double> ladder(std::size_t count, double step) {
    std::vector<double> rungs(count);
    for (std::size_t i = 0; i < count; ++i)
        rungs[i] = (static_cast<double>(i) - static_cast<double>(count - 1) / 2) * step;
    return rungs;
}

std::size_t nearest(const std::vector<double>& rungs, double angle) {
    const double at = (angle - rungs.front()) / (rungs[1] - rungs[0]);
    return static_cast<std::size_t>(std::clamp(std::lround(at), 0L, static_cast<long>(rungs.size()) - 1));
}

/// A direction as a fan sees it: the fan's tilt, and the bearing within its plane.
struct InFan {
    double tilt, bearing;
};

InFan in_fan(double yaw, double pitch) {
    return {std::atan2(std::sin(pitch), std::cos(pitch) * std::cos(yaw)),
            std::asin(std::cos(pitch) * std::sin(yaw))};
}

}  // namespace

View make_view(const ModeFigures& mode, bool first_row_up) {
    const double column = mode.fov_horizontal / (width - 1), row = mode.fov_vertical / (height - 1);
    const double yaw = mode.fov_horizontal / 2, pitch = mode.fov_vertical / 2;
    // In the corners bearings are squeezed and tilts spread.
    const double squeeze = std::cos(pitch) * std::cos(yaw) / std::cos(in_fan(yaw, pitch).bearing);
    const double steepest = in_fan(yaw, pitch).tilt;
    View view;
    view.tilts = ladder(2 * static_cast<std::size_t>(std::ceil(steepest / row)), row);
    view.bearings =
        ladder(2 * static_cast<std::size_t>(std::ceil(yaw / (column * squeeze))), column * squeeze);
    view.pixels.resize(view.tilts.size());
    for (std::size_t pixel = 0; pixel < width * height; ++pixel) {
        const double rows_up = static_cast<double>(pixel / width) * row - pitch;
        const InFan at =
            in_fan(static_cast<double>(pixel % width) * column - yaw, first_row_up ? -rows_up : rows_up);
        view.pixels[nearest(view.tilts, at.tilt)].push_back({pixel, nearest(view.bearings, at.bearing)});
    }
    return view;
}

}  // namespace echoloop::sonar_3d_15
