#include "render/paths/fresnel.h"

#include <array>
#include <cmath>
#include <numbers>

namespace echoloop {
namespace {

constexpr double per_unit = 128;      ///< values of the table
constexpr std::size_t last_unit = 4;  ///< beyond it the waves of both integrals are as good as known

struct Integral {
    double c, s;
};

/// C and S by Simpson's rule from value to value, within 1e-10.
std::array<Integral, last_unit* static_cast<std::size_t>(per_unit) + 2> make_table() {
    std::array<Integral, last_unit* static_cast<std::size_t>(per_unit) + 2> table{};
    const auto at = [](double t) { return std::polar(1.0, std::numbers::pi / 2 * t * t); };
    for (std::size_t i = 0; i + 1 < table.size(); ++i) {
        constexpr int parts = 4;
        constexpr double step = 1 / per_unit / parts;
        std::complex<double> sum;
        for (int part = 0; part < parts; ++part) {
            const double t = static_cast<double>(i) / per_unit + part * step;
            sum += at(t) + 4.0 * at(t + step / 2) + at(t + step);
        }
        table[i + 1] = {table[i].c + step / 6 * sum.real(), table[i].s + step / 6 * sum.imag()};
    }
    return table;
}

Integral integral_to(double x) {
    static const auto table = make_table();
    if (x < static_cast<double>(last_unit)) {
        const double place = x * per_unit;
        const auto cell = static_cast<std::size_t>(place);
        const double share = place - static_cast<double>(cell);
        const Integral &low = table[cell], &high = table[cell + 1];
        return {low.c + share * (high.c - low.c), low.s + share * (high.s - low.s)};
    }
    const double square = std::numbers::pi * x * x, small = 1 / (square * square);
    const double f = (1 - 3 * small) / (std::numbers::pi * x),
                 g = (1 - 15 * small) / (square * std::numbers::pi * x);
    const double cosine = std::cos(square / 2), sine = std::sin(square / 2);
    return {0.5 + f * sine - g * cosine, 0.5 - f * cosine - g * sine};
}

/// Of the integral from minus infinity to x, over 1 + i: the step of geometrical optics, and the edge's wave.
std::complex<double> up_to(const MirrorZone& zone, double x) {
    const double step = std::copysign(0.5, x);
    const double in_time = zone.resolution > 0 ? 1 - zone.delay * x * x / zone.resolution : 1;
    if (!(in_time > 0)) return step;
    const Integral found = integral_to(std::abs(zone.per_metre * x));
    const std::complex<double> whole{(found.s + found.c) / 2, (found.s - found.c) / 2};
    return step + in_time * (std::copysign(1.0, x) * whole - step);
}

}  // namespace

std::complex<double> fresnel_integral(double u) {
    const Integral found = integral_to(std::abs(u));
    return std::copysign(1.0, u) * std::complex(found.c, found.s);
}

MirrorZone mirror_zone(double wavenumber, double before, double after, double resolution) {
    const double curvature = (before + after) / (before * after);
    return {std::sqrt(curvature * wavenumber / std::numbers::pi), curvature / 4, resolution};
}

std::complex<double> strip_share(const MirrorZone& zone, double low, double high) {
    return up_to(zone, high) - up_to(zone, low);
}

}  // namespace echoloop
