#include "render/fan/view.h"

namespace echoloop {

double View::solid_angle(std::size_t line, std::size_t sample) const {
    const double x2 = std::pow(x(static_cast<double>(line) + 0.5), 2);
    const double y2 = std::pow(y(static_cast<double>(sample) + 0.5), 2);
    return line_width() * sample_height() / std::pow(1 + x2 + y2, 1.5);
}

PixelOffset jitter_of(std::uint64_t ping) {
    const auto n = static_cast<double>(ping % (1U << 24U));  // keeps the fraction exact enough
    const auto centred = [](double v) { return v - std::floor(v + 0.5); };
    return {centred(n * 0.7548776662466927), centred(n * 0.5698402909980532)};
}

}  // namespace echoloop
