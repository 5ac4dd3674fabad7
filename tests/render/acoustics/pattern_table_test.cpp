#include "render/acoustics/pattern_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace echoloop {
namespace {

// 0.02 dB both ways is 0.01 dB of the amplitude.
TEST(PatternTable, IsThePatternBetweenItsValues) {
    for (const ApertureShape shape : {ApertureShape::line, ApertureShape::hamming, ApertureShape::piston})
        for (const double length : {0.4, 1.3, 20.0, 150.0}) {
            const auto aperture = AperturePattern::of_length(shape, length);
            const PatternTable table(aperture);
            for (double angle = 0; angle < std::numbers::pi / 2; angle += 1e-4) {
                const double exact = aperture.amplitude(angle), sine = std::sin(angle);
                ASSERT_NEAR(table.at(sine), exact, 2e-4) << length << " at " << angle;
                ASSERT_EQ(table.at(-sine), table.at(sine));
                if (angle < aperture.first_null() && exact > 0.1) {
                    ASSERT_NEAR(20 * std::log10(table.at(sine) / exact), 0, 0.011)
                        << length << " at " << angle;
                }
            }
            EXPECT_NEAR(table.at(1), aperture.amplitude(std::numbers::pi / 2), 1e-6);
        }
}

}  // namespace
}  // namespace echoloop
