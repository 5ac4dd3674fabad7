// V5: apertures against their theory, and a head turned past a point target.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/acoustics/pattern.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

using std::numbers::pi;

/// One-way amplitude at u = (L or D) / lambda sin t, from the textbook and not from the renderer.
double theory(ApertureShape shape, double u) {
    const double x = pi * std::abs(u);
    if (x < 1e-9) return 1;
    if (shape == ApertureShape::line) return std::sin(x) / x;
    if (shape == ApertureShape::piston) return 2 * std::cyl_bessel_j(1, x) / x;
    constexpr int elements = 32;
    double sum = 0, weights = 0;
    for (int n = 0; n < elements; ++n) {
        const double weight = 0.54 - 0.46 * std::cos(2 * pi * n / (elements - 1));
        sum += weight * std::cos(2 * x * (n - (elements - 1) / 2.0) / elements);
        weights += weight;
    }
    return sum / weights;
}

double amplitude_db(double amplitude) { return 20 * std::log10(std::abs(amplitude)); }

/// Where the theory's two-way power has fallen to a half, as u.
double half_power_two_way(ApertureShape shape) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (std::pow(theory(shape, middle), 4) > 0.5 ? low : high) = middle;
    }
    return low;
}

struct Lobes {
    double width = 0, null = 0, side_lobe = 0;  ///< lambda / L, lambda / L, dB; one way
};

/// Of an aperture 16 wavelengths long, so that a Hamming array has the 32 elements of the published value.
Lobes lobes_of(ApertureShape shape) {
    constexpr double length = 16;
    const auto pattern = AperturePattern::of_length(shape, length);
    const auto at = [&](double u) { return std::abs(pattern.amplitude(std::asin(u / length))); };
    Lobes lobes;
    double u = 0;
    while (at(u) > std::sqrt(0.5)) u += 1e-4;
    lobes.width = 2 * u;
    while (at(u + 1e-4) < at(u)) u += 1e-4;
    lobes.null = u;
    double side_lobe = 0;
    for (; u < 8; u += 1e-3) side_lobe = std::max(side_lobe, at(u));
    lobes.side_lobe = amplitude_db(side_lobe);
    return lobes;
}

constexpr double beam_width_deg = 3, target_range = 20;

Shot head(ApertureShape shape) {
    Shot shot = fan(beam_width_deg, 25, 1, 80, 1);
    if (shape == ApertureShape::piston) shot.fan_height = shot.beam_width;
    shot.first_bin_time = 2 * 19.5 / 1500;
    shot.pulse_length = 4 * shot.bin_interval;
    shot.horizontal = shot.vertical = {shape, 2};
    if (shape == ApertureShape::hamming) shot.vertical.shape = ApertureShape::line;
    return shot;
}

Renderer pattern_renderer() {
    return {scene_of({}, {{"target", {target_range, 0, 0}, -10}}), water_of(1500),
            with(only({Effect::spreading, Effect::beam_pattern, Effect::side_lobes, Effect::pulse}))};
}

/// dB re the axis over degrees, from 0 to `end_deg`.
Curve turned(Renderer& renderer, Shot shot, double end_deg) {
    Curve curve{"measured", {}, true};
    double axis = 0;
    for (double angle = 0; angle <= end_deg; angle += 0.05) {
        shot.pan = -deg_to_rad(angle);
        const double level = db(peak(renderer.render(shot, {}).values));
        if (curve.points.empty()) axis = level;
        curve.points.emplace_back(angle, level - axis);
    }
    return curve;
}

/// Every fourth point, so that a line behind them can be seen.
Curve thinned(Curve curve) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < curve.points.size(); i += 4) curve.points[kept++] = curve.points[i];
    curve.points.resize(kept);
    return curve;
}

struct Turn {
    Curve measured, expected{"theory", {}, false};
    double deviation = 0;  ///< dB, the largest where the theory is above -25 dB one way
    double side_lobe = 0;  ///< dB, two ways
};

Turn turn_past_target(Renderer& renderer, ApertureShape shape) {
    Turn turn{turned(renderer, head(shape), 12), {"theory", {}, false}, 0, -300};
    const double length = half_power_two_way(shape) / std::sin(deg_to_rad(beam_width_deg) / 2);
    bool main_lobe = true;
    double before = 1;
    for (const auto& [angle, level] : turn.measured.points) {
        const double u = length * std::sin(deg_to_rad(angle));
        const double expected = 2 * amplitude_db(theory(shape, u));
        turn.expected.points.emplace_back(angle, expected);
        if (expected > -50) turn.deviation = std::max(turn.deviation, std::abs(level - expected));
        if (level > before) main_lobe = false;
        before = level;
        if (!main_lobe) turn.side_lobe = std::max(turn.side_lobe, level);
    }
    return turn;
}

/// The same target in a fan of 41 beams, half a beam apart, that transmits widely and receives in beams.
double fan_deviation(Renderer& renderer) {
    Shot shot = head(ApertureShape::line);
    shot.horizontal = {ApertureShape::line, 1};
    shot.bearings.clear();
    for (int i = -20; i <= 20; ++i) shot.bearings.push_back(i * shot.beam_width / 2);
    const Echogram e = renderer.render(shot, {});
    const double axis = db(peak(e.beam(20))), length = 0.4429 / std::sin(shot.beam_width / 2);
    double deviation = 0;
    for (std::size_t i = 0; i < e.beams(); ++i) {
        const double expected =
            amplitude_db(theory(ApertureShape::line, length * std::sin(shot.bearings[i])));
        if (expected > -25) deviation = std::max(deviation, std::abs(db(peak(e.beam(i))) - axis - expected));
    }
    return deviation;
}

}  // namespace

void check_beam_pattern(Findings& find) {
    find.source("Urick 1983, chapter 3; Harris 1978 for the shading");
    const Lobes line = lobes_of(ApertureShape::line), shaded = lobes_of(ApertureShape::hamming),
                piston = lobes_of(ApertureShape::piston);
    find.within("line: -3 dB full width", "lambda/L", 0.886, 0.002, line.width);
    find.within("line: first null", "lambda/L", 1, 0.002, line.null);
    find.within("line: side lobe", "dB", -13.26, 0.05, line.side_lobe);
    find.within("Hamming, N = 32: -3 dB full width", "lambda/L", 1.33, 0.02, shaded.width);
    find.within("Hamming, N = 32: side lobe", "dB", -41.8, 0.3, shaded.side_lobe);
    find.within("piston: -3 dB full width", "lambda/D", 1.029, 0.002, piston.width);
    find.within("piston: first null", "lambda/D", 1.22, 0.002, piston.null);
    find.within("piston: side lobe", "dB", -17.57, 0.05, piston.side_lobe);

    Renderer renderer = pattern_renderer();
    const Turn turn = turn_past_target(renderer, ApertureShape::line);
    find.source("sinc(L sin t / lambda), two ways, down to -25 dB one way");
    find.within("line: head turned past a point target, largest deviation", "dB", 0, 0.5, turn.deviation);
    find.source("twice -13.26 dB");
    find.within("line: side lobe of the turned head, two ways", "dB", -26.52, 0.5, turn.side_lobe);
    find.source("32 elements with Hamming shading, two ways");
    find.within("Hamming: head turned past a point target, largest deviation", "dB", 0, 0.5,
                turn_past_target(renderer, ApertureShape::hamming).deviation);
    find.source("2 J1(x) / x, two ways");
    find.within("piston: head turned past a point target, largest deviation", "dB", 0, 0.5,
                turn_past_target(renderer, ApertureShape::piston).deviation);
    find.source("sinc(L sin t / lambda), one way");
    find.within("line: 41 receive beams around a point target, largest deviation", "dB", 0, 0.5,
                fan_deviation(renderer));
    find.plot("beam-pattern", {"A head turned past a point target, two ways",
                               "degrees off the axis",
                               "dB re the axis",
                               {turn.expected, thinned(turn.measured)},
                               -70,
                               0});
}

}  // namespace echoloop::validation
