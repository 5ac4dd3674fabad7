// V30: speckle moves with the sonar, and is a function of its pose.
#include <cmath>

#include "render/acoustics/pattern.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/statistics.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr std::size_t moving_bins = 1500, moving_beams = 11;
constexpr double moving_hz = 750e3, moving_c = 1500;

/// Beams two widths apart, within 10 deg of the x axis, in bins of one look as long as the pulse.
Shot seen_ahead(AxisPattern pattern) {
    Shot shot = fan(22, 20, moving_beams, moving_bins, 600);
    shot.frequency = moving_hz;
    shot.beam_width = deg_to_rad(1);
    shot.horizontal = pattern;
    shot.receiver.bins = BinRule::sample;
    return shot;
}

std::vector<double> speckle(const Shot& shot, const Pose& pose) {
    std::vector<float> values(shot.bearings.size() * shot.bins, 1.0F);
    AcousticChain(only({Effect::pulse, Effect::speckle})).apply(shot, pose, moving_c, {}, values);
    return {values.begin(), values.end()};
}

/// Correlation after a way in the sonar's frame, the mean over begins and headings.
double left_after(const Shot& shot, Vec3 way) {
    constexpr int begins = 24;
    double sum = 0;
    for (int i = 0; i < begins; ++i) {
        const Vec3 begin{3.1 * i, -2.3 * i, 0.7 * i};
        const Quat heading = from_rpy(0, 0, 0.9 * i);
        sum += correlation(speckle(shot, {begin, heading}),
                           speckle(shot, {begin + rotate(heading, way), heading})) /
               begins;
    }
    return sum;
}

struct MovingCase {
    const char* name;
    AxisPattern pattern;
    double tenth, quarter;  ///< correlation after so much of the aperture
};

constexpr MovingCase moving_cases[] = {{"wide transmit, plain line", {ApertureShape::line, 1}, 0.643, 0.251},
                                       {"both ways, plain line", {ApertureShape::line, 2}, 0.895, 0.517},
                                       {"wide transmit, Hamming", {ApertureShape::hamming, 1}, 0.643, 0.055}};

void check_across(Findings& find) {
    find.source("transform of the squared two-way pattern at 2 x / lambda");
    double least = 1;
    for (const MovingCase& c : moving_cases) {
        const Shot shot = seen_ahead(c.pattern);
        const double aperture = TwoWayPattern(c.pattern, shot.beam_width).aperture().length_in_wavelengths() *
                                moving_c / moving_hz;
        const std::string of = std::string(", ") + c.name;
        find.within("after L / 10 across" + of, "", c.tenth, 0.05, left_after(shot, {0, aperture / 10, 0}));
        find.within("after L / 4 across" + of, "", c.quarter, 0.05, left_after(shot, {0, aperture / 4, 0}));
        for (const Vec3 way : {Vec3{1e-4, 0, 0}, Vec3{0, 1e-4, 0}, Vec3{0, 0, 1e-4}})
            least = std::min(least, left_after(shot, way));
    }
    find.source("continuous");
    find.at_least("least of what steps of 0.1 mm leave", "", 0.97, least);
}

void check_along(Findings& find) {
    constexpr double step = moving_c / moving_hz / 4;
    Shot shot = fan(1, 20, 1, 60'000, 60'000 * step);
    shot.frequency = moving_hz;
    shot.pulse_length = 25e-6;
    shot.receiver.bins = BinRule::sample;
    const auto before = speckle(shot, {{7, 0, 0}, {}}), moved = speckle(shot, {{7 + step, 0, 0}, {}});
    const std::span<const double> all(before), next(moved);
    find.source("(1 - x / d)^2, x lambda / 4 at 750 kHz, pulse of 25 us");
    find.within("after lambda / 4 along the line of sight", "", 0.947, 0.05,
                correlation(all.first(50'000), next.first(50'000)));
    find.source("the envelope moves by x and stays");
    find.at_least("that shifted back by x", "", 0.95,
                  correlation(all.subspan(101, 50'000), next.subspan(100, 50'000)));
}

}  // namespace

void check_moving_speckle(Findings& find) {
    check_across(find);
    check_along(find);
}

}  // namespace echoloop::validation
