#include "render/view.h"

namespace echoloop {

double View::solid_angle(double x2, std::size_t sample) const {
    const double y_middle = y(static_cast<double>(sample) + 0.5);
    const double square = 1 + x2 + y_middle * y_middle;
    return line_width() * sample_height() / (square * std::sqrt(square));
}

std::size_t Picture::pixels() const {
    std::size_t sum = 0;
    for (const View& view : views) sum += view.lines * view.samples;
    return sum;
}

PixelOffset jitter_of(std::uint64_t ping) {
    const auto n = static_cast<double>(ping % (1U << 24U));  // keeps the fraction exact enough
    const auto centred = [](double v) { return v - std::floor(v + 0.5); };
    return {centred(n * 0.7548776662466927), centred(n * 0.5698402909980532)};
}

}  // namespace echoloop
