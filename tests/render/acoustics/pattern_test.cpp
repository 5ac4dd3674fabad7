#include "render/acoustics/pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace echoloop {
namespace {

using std::numbers::pi;

double db(double amplitude) { return 20 * std::log10(std::abs(amplitude)); }

/// rad, full width between the -3 dB points.
double width_of(const AperturePattern& pattern) {
    double low = 0, high = pi / 2;
    while (high - low > 1e-12) {
        const double middle = (low + high) / 2;
        (pattern.amplitude(middle) > std::sqrt(0.5) ? low : high) = middle;
    }
    return 2 * low;
}

/// dB, of the strongest side lobe up to 85 deg.
double side_lobe_of(const AperturePattern& pattern) {
    double highest = 0;
    for (double t = pattern.first_null(); t < 85 * pi / 180; t += 1e-5)
        highest = std::max(highest, std::abs(pattern.amplitude(t)));
    return db(highest);
}

TEST(AperturePattern, UnshadedLine) {
    const auto line = AperturePattern::of_length(ApertureShape::line, 100);
    EXPECT_NEAR(width_of(line) * 100, 0.886, 0.001);
    EXPECT_NEAR(line.first_null() * 100, 1.0, 0.001);
    EXPECT_NEAR(line.amplitude(line.first_null()), 0, 1e-9);
    EXPECT_NEAR(side_lobe_of(line), -13.26, 0.01);
    EXPECT_LT(line.amplitude(1.43 / 100), 0);  // the first side lobe is out of phase
}

TEST(AperturePattern, HammingOf32Elements) {
    const auto shaded = AperturePattern::of_length(ApertureShape::hamming, 16);  // lambda / 2 apart
    EXPECT_NEAR(2 * std::sin(width_of(shaded) / 2) * 16, 1.33, 0.005);
    EXPECT_NEAR(side_lobe_of(shaded), -41.8, 0.1);
}

TEST(AperturePattern, HammingOfALongLineHasNoGratingLobes) {
    const auto shaded = AperturePattern::of_length(ApertureShape::hamming, 100);
    EXPECT_NEAR(width_of(shaded) * 100, 1.31, 0.01);
    EXPECT_NEAR(side_lobe_of(shaded), -42.6, 0.2);
}

TEST(AperturePattern, CircularPiston) {
    const auto piston = AperturePattern::of_length(ApertureShape::piston, 100);
    EXPECT_NEAR(width_of(piston) * 100, 1.029, 0.001);
    EXPECT_NEAR(piston.first_null() * 100, 1.22, 0.001);
    EXPECT_NEAR(side_lobe_of(piston), -17.57, 0.01);
}

TEST(AperturePattern, PistonIsTheBesselFunction) {
    const auto piston = AperturePattern::of_length(ApertureShape::piston, 20);
    for (double t = 0.001; t < 1.5; t += 0.0037) {
        const double x = 20 * pi * std::sin(t);
        ASSERT_NEAR(piston.amplitude(t), 2 * std::cyl_bessel_j(1.0, x) / x, 2e-7) << "at " << t << " rad";
    }
}

TEST(AperturePattern, IsMadeFromItsWidth) {
    for (const auto shape : {ApertureShape::line, ApertureShape::hamming, ApertureShape::piston})
        for (const double width : {0.001, 0.02, 0.5, 2.0, 3.0}) {
            const AperturePattern pattern(shape, width);
            EXPECT_NEAR(pattern.amplitude(width / 2), std::sqrt(0.5), 1e-6) << "of width " << width;
            EXPECT_NEAR(pattern.amplitude(0), 1, 1e-9);
            EXPECT_DOUBLE_EQ(pattern.amplitude(-width), pattern.amplitude(width));
        }
}

TEST(AperturePattern, TheBaffleIsBehind) {
    const AperturePattern pattern(ApertureShape::line, 1);
    EXPECT_NEAR(db(pattern.amplitude(pi)), -40, 1e-9);
    EXPECT_NEAR(pattern.amplitude(pi - 0.3), 0.01 * pattern.amplitude(0.3), 1e-12);
}

TEST(TwoWayPattern, HalfThePowerAtHalfTheWidth) {
    for (const auto shape : {ApertureShape::line, ApertureShape::hamming, ApertureShape::piston})
        for (const int ways : {1, 2})
            for (const double width : {0.0002, 0.02, 0.6, 2.09}) {
                const TwoWayPattern pattern({shape, ways}, width);
                EXPECT_NEAR(pattern.power(width / 2), 0.5, 1e-6) << ways << " ways, width " << width;
                EXPECT_NEAR(pattern.power(0), 1, 1e-9);
            }
}

TEST(TwoWayPattern, BothWaysAddInDecibels) {
    const TwoWayPattern pattern({ApertureShape::line, 2}, 0.02);
    const auto& aperture = pattern.aperture();
    for (const double angle : {0.005, 0.013, 0.03, 0.2})
        EXPECT_NEAR(10 * std::log10(pattern.power(angle)), 2 * db(aperture.amplitude(angle)), 1e-9);
    const double highest = 1.4303 / aperture.length_in_wavelengths();
    EXPECT_NEAR(10 * std::log10(pattern.power(highest)), -26.52, 0.02);
}

// The integrals of sinc^2 and sinc^4 over u are 1 and 2/3, so the box of a narrow beam is that times lambda /
// L.
TEST(TwoWayPattern, EquivalentWidthOfALine) {
    for (const double width : {0.0002, 0.01, 0.1}) {
        const TwoWayPattern one({ApertureShape::line, 1}, width), two({ApertureShape::line, 2}, width);
        EXPECT_NEAR(one.equivalent_width() * one.aperture().length_in_wavelengths(), 1, 0.01);
        EXPECT_NEAR(two.equivalent_width() * two.aperture().length_in_wavelengths(), 2.0 / 3, 0.001);
    }
}

}  // namespace
}  // namespace echoloop
