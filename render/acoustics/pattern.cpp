#include "render/acoustics/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/acoustics/sinc.h"

namespace echoloop {
namespace {

using std::numbers::pi;

/// sin(N x) / (N sin x), the sum over N equal elements.
double dirichlet(double x, int n) {
    const double s = std::sin(x);
    if (std::abs(s) < 1e-9) return std::cos(n * x) / std::cos(x);
    return std::sin(n * x) / (n * s);
}

/// 2 J1(x) / x by Abramowitz & Stegun, Handbook of Mathematical Functions (1964), 9.4.4 and 9.4.6, |error| <
/// 1e-7.
double airy(double x) {
    x = std::abs(x);
    const auto polynomial = [](double y, const double(&c)[7]) {
        double sum = 0;
        for (int i = 6; i >= 0; --i) sum = sum * y + c[i];
        return sum;
    };
    if (x <= 3)
        return 2 * polynomial(x * x / 9, {0.5, -0.56249985, 0.21093573, -0.03954289, 0.00443319, -0.00031761,
                                          0.00001109});
    const double y = 3 / x;
    const double f =
        polynomial(y, {0.79788456, 0.00000156, 0.01659667, 0.00017105, -0.00249511, 0.00113653, -0.00020033});
    const double theta = x + polynomial(y, {-2.35619449, 0.12499612, 0.00005650, -0.00637879, 0.00074348,
                                            0.00079824, -0.00029166});
    return 2 * f * std::cos(theta) / (x * std::sqrt(x));
}

/// The weights 0.54 - 0.46 cos(2 pi n / (N - 1)) are three exponentials, so the array is three shifted sums.
double hamming(double u, int n) {
    const double x = pi * u / n, shift = pi / (n - 1);
    const double wings = dirichlet(x - shift, n) + dirichlet(x + shift, n);
    return (0.54 * dirichlet(x, n) + 0.23 * wings) / (0.54 + 0.46 * dirichlet(shift, n));
}

/// Amplitude at u = (L or D) / lambda sin t.
double shape_at(ApertureShape shape, double u, int elements) {
    switch (shape) {
        case ApertureShape::line:
            return sinc(u);
        case ApertureShape::hamming:
            return hamming(u, elements);
        case ApertureShape::piston:
            return airy(pi * u);
    }
    return 0;
}

/// The first u > 0 where the shape has fallen to `level`, 0 <= level < 1.
double where(ApertureShape shape, double level, int elements) {
    double low = 0, high = 0;
    while (shape_at(shape, high, elements) > level) low = high, high += 0.05;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (shape_at(shape, middle, elements) > level ? low : high) = middle;
    }
    return (low + high) / 2;
}

constexpr int fewest_elements = 32;

int elements_of(double length) { return std::max(fewest_elements, static_cast<int>(std::ceil(2 * length))); }

/// The integral of power over +-90 deg by Simpson's rule, with some 16 steps for each lobe.
double integral_of(const TwoWayPattern& pattern) {
    const int pairs = 128 + static_cast<int>(16 * pattern.aperture().length_in_wavelengths());
    const double step = pi / 4 / pairs;
    double sum = pattern.power(0) + pattern.power(pi / 2);
    for (int i = 1; i < 2 * pairs; ++i) sum += pattern.power(i * step) * (i % 2 == 1 ? 4 : 2);
    return 2 * sum * step / 3;
}

AperturePattern one_way(AxisPattern axis, double width) {
    return AperturePattern::through(axis.shape, width / 2, std::pow(0.5, 0.5 / axis.ways));
}

}  // namespace

AperturePattern AperturePattern::of_length(ApertureShape shape, double length) {
    return {shape, length, elements_of(length)};
}

AperturePattern AperturePattern::through(ApertureShape shape, double angle, double level) {
    // More elements make the main lobe of a shaded array of one length narrower, never wider: so the number
    // that the first estimate asks for is enough.
    const double s = std::sin(angle);
    const int elements = elements_of(where(shape, level, fewest_elements) / s);
    return {shape, where(shape, level, elements) / s, elements};
}

AperturePattern::AperturePattern(ApertureShape shape, double width)
    : AperturePattern(through(shape, width / 2, std::sqrt(0.5))) {}

double AperturePattern::amplitude(double angle) const {
    const double value = at_sine(std::sin(angle));
    return std::cos(angle) < 0 ? back_amplitude * value : value;
}

double AperturePattern::at_sine(double sine) const { return shape_at(shape_, length_ * sine, elements_); }

double AperturePattern::first_null() const {
    const double s = where(shape_, 0, elements_) / length_;
    return s < 1 ? std::asin(s) : pi / 2;
}

TwoWayPattern::TwoWayPattern(AxisPattern axis, double width)
    : ways_(axis.ways), aperture_(one_way(axis, width)), equivalent_(integral_of(*this)) {}

double TwoWayPattern::power(double angle) const {
    const double once = aperture_.amplitude(angle) * aperture_.amplitude(angle);
    return ways_ == 2 ? once * once : once;
}

}  // namespace echoloop
