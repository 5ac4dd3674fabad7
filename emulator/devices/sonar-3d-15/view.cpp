#include "emulator/devices/sonar-3d-15/view.h"

namespace echoloop::sonar_3d_15 {
namespace {

/// `count` angles in equal steps from -span / 2 to span / 2.
std::vector<double> ladder(std::size_t count, double span) {
    std::vector<double> rungs(count);
    for (std::size_t i = 0; i < count; ++i)
        rungs[i] = (static_cast<double>(i) / static_cast<double>(count - 1) - 0.5) * span;
    return rungs;
}

}  // namespace

View make_view(const ModeFigures& mode, bool first_row_up) {
    return {ladder(width, mode.fov_horizontal), ladder(height, mode.fov_vertical), first_row_up};
}

}  // namespace echoloop::sonar_3d_15
