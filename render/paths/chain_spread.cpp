#include "render/paths/chain_spread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace echoloop {
namespace {

constexpr std::uint64_t samples = 64;
constexpr double main_lobe = 0.1;  ///< amplitude of its edge
constexpr double widest = 1.2;     ///< rad off the axis
constexpr double singular = 1e-3;  ///< determinant re that of independent directions

/// Value k of the sequence in 0..1 along an axis: the fraction of k / g^(axis + 1), g = 1.13472413840.
double r5(std::uint64_t k, int axis) {
    constexpr std::uint64_t step[] = {0xE19B01AA9D42C633, 0xC6D1D6C8ED0C9631, 0xAF36D01EF7518DBB,
                                      0x9A69443F36F710E6, 0x881403B9339BD42D};
    return static_cast<double>((k * step[axis]) >> 11) * 0x1p-53;
}

/// A direction off the beam's axis, rad, and one over its density, rad^2.
struct Draw {
    double bearing, elevation, share;
};
Draw draw(const Shot& shot, double radius, double angle) {
    const double wide = shot.beam_width / 2, high = shot.fan_height / 2;
    const double r2 = radius / (1 - radius), r = std::sqrt(r2), turn = 2 * std::numbers::pi * angle;
    return {wide * r * std::cos(turn), high * r * std::sin(turn),
            std::numbers::pi * (1 + r2) * (1 + r2) * wide * high};
}

/// How the slopes of a chain turn the path, along one axis: variances and covariance of where it leaves and
/// where it arrives.
struct Turns {
    double aa = 0, ab = 0, bb = 0;

    explicit Turns(std::span<const ChainMirror> mirrors) {
        for (const ChainMirror& mirror : mirrors) {
            const double s = 4 * mirror.slope * mirror.slope, a = mirror.at - 1, b = mirror.at;
            aa += s * a * a, ab += s * a * b, bb += s * b * b;
        }
    }
    double determinant() const { return aa * bb - ab * ab; }
    double exponent(double leaves, double arrives) const {
        return (bb * leaves * leaves - 2 * ab * leaves * arrives + aa * arrives * arrives) /
               (2 * determinant());
    }
};

/// Mean of what the mirrors between the first and the last lengthen the path by, m for a path of 1 m: each as
/// far off the straight line as its own slope and those of its neighbours let it be.
double detours_of(std::span<const ChainMirror> mirrors) {
    const auto precision = [](double slope) { return slope > 0 ? 1 / (4 * slope * slope) : 1e12; };
    double sum = 0;
    for (std::size_t i = 1; i + 1 < mirrors.size(); ++i) {
        const double before = 1 / (mirrors[i].at - mirrors[i - 1].at);
        const double after = 1 / (mirrors[i + 1].at - mirrors[i].at), both = before + after;
        sum += both / (precision(mirrors[i].slope) * both * both +
                       precision(mirrors[i - 1].slope) * before * before +
                       precision(mirrors[i + 1].slope) * after * after);
    }
    return sum;  // 1/2 for each of two axes
}

}  // namespace

bool add_through_pattern(const PathPing& ping, const RoughChain& chain, std::uint64_t number,
                         std::vector<PathEcho>& out) {
    const Turns turns(chain.mirrors);
    if (!ping.pattern.upwards()) return false;
    if (!(turns.determinant() > singular * turns.aa * turns.bb)) return false;
    if (std::abs(chain.leaves.transmit) < main_lobe || std::abs(chain.arrives.receive) < main_lobe)
        return false;
    const double axis = ping.shot.bearings.front();
    const double first = chain.mirrors.front().at, last = 1 - chain.mirrors.back().at;
    const double middle = 1 - first - last, detours = detours_of(chain.mirrors);
    const double density =
        1 / (4 * std::numbers::pi * std::numbers::pi * turns.determinant() * static_cast<double>(samples));
    for (std::uint64_t i = 0; i < samples; ++i) {
        const std::uint64_t k = (ping.shot.ping + (number << 40)) * samples + i;
        const Draw there = draw(ping.shot, r5(k, 0), r5(k, 1)), back = draw(ping.shot, r5(k, 2), r5(k, 3));
        if (std::max({std::abs(there.bearing), std::abs(there.elevation), std::abs(back.bearing),
                      std::abs(back.elevation)}) > widest)
            continue;
        const auto seen = [&](const Draw& d) {
            return ping.pattern.at(fan_direction(axis + d.bearing, d.elevation));
        };
        const FanDirection leaves = seen(there), arrives = ping.received(seen(back), chain.range);
        // Sound that arrives from one side runs towards the other.
        const std::array<double, 2> out_by{axis + there.bearing - chain.leaves.bearing,
                                           there.elevation - chain.leaves.elevation},
            in_by{chain.arrives.bearing - axis - back.bearing, chain.arrives.elevation - back.elevation};
        double exponent = 0, longer = -std::log1p(-r5(k, 4)) * detours;
        for (std::size_t n = 0; n < 2; ++n) {
            const double across = in_by[n] * last + out_by[n] * first;
            exponent += turns.exponent(out_by[n], in_by[n]);
            longer +=
                (out_by[n] * out_by[n] * first + in_by[n] * in_by[n] * last + across * across / middle) / 2;
        }
        const double patterns = leaves.transmit * arrives.receive;
        PathEcho echo;
        echo.near_range = static_cast<float>(chain.range * (1 + longer));
        echo.far_range = static_cast<float>(chain.range * (1 + longer) + ping.resolution);
        echo.bearing = static_cast<float>(arrives.bearing);
        echo.elevation = static_cast<float>(arrives.elevation);
        echo.turned = static_cast<float>(arrives.turned);
        echo.power = static_cast<float>(chain.power * patterns * patterns * density * there.share *
                                        back.share * std::exp(-exponent));
        if (std::isnormal(echo.power)) out.push_back(echo);
    }
    return true;
}

}  // namespace echoloop
