#include "tools/draw/palette.h"

#include <array>

namespace echoloop::draw {

Color palette(double level) {
    static constexpr std::array<Color, 11> steps{{{11, 6, 4},
                                                  {48, 13, 0},
                                                  {81, 25, 0},
                                                  {113, 42, 0},
                                                  {142, 65, 0},
                                                  {167, 92, 0},
                                                  {188, 122, 2},
                                                  {205, 154, 68},
                                                  {220, 185, 120},
                                                  {233, 216, 176},
                                                  {248, 245, 236}}};
    if (!(level > 0)) return steps.front();
    const double place = std::min(level, 1.0) * (steps.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), steps.size() - 2);
    return mix(steps[below], steps[below + 1], place - static_cast<double>(below));
}

}  // namespace echoloop::draw
