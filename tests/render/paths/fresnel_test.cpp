#include "render/paths/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace echoloop {
namespace {

// Abramowitz & Stegun, Handbook of Mathematical Functions (1964), table 7.7.
TEST(FresnelIntegral, IsThatOfTheTables) {
    constexpr struct {
        double u, c, s;
    } known[] = {{0, 0, 0},
                 {0.5, 0.4923442, 0.0647324},
                 {1, 0.7798934, 0.4382591},
                 {1.5, 0.4452612, 0.6975050},
                 {2, 0.4882534, 0.3434157},
                 {3, 0.6057208, 0.4963130},
                 {4, 0.4984260, 0.4205158},
                 {5, 0.5636312, 0.4991914}};
    for (const auto& [u, c, s] : known)
        for (const double sign : {1.0, -1.0}) {
            const auto found = fresnel_integral(sign * u);
            EXPECT_NEAR(found.real(), sign * c, 1e-4) << u;
            EXPECT_NEAR(found.imag(), sign * s, 1e-4) << u;
        }
}

// d/du of it is exp(i pi u^2 / 2), between the values of the table and where it ends.
TEST(FresnelIntegral, HasItsDerivativeEverywhere) {
    constexpr double step = 0.05;
    for (double u = 0.013; u < 6; u += step) {
        std::complex<double> sum;
        constexpr int parts = 200;
        for (int i = 0; i < parts; ++i) {
            const double t = u + step * (i + 0.5) / parts;
            sum += std::polar(step / parts, 1.5707963267948966 * t * t);
        }
        EXPECT_NEAR(std::abs(fresnel_integral(u + step) - fresnel_integral(u) - sum), 0, 2e-4) << u;
    }
}

TEST(StripShare, AnEdgeThatIsHeardLateHasNoPart) {
    const MirrorZone zone = mirror_zone(3000, 10, 10, 0.05);
    EXPECT_EQ(strip_share(zone, -3, 3), std::complex<double>(1));
    EXPECT_EQ(strip_share(zone, 2, 3), std::complex<double>(0));
    EXPECT_NEAR(std::abs(strip_share(zone, 0, 3)), 0.5, 1e-9);
    EXPECT_NE(strip_share(zone, -0.3, 3), std::complex<double>(1));
    // By Pythagoras, half of the detour by a point 1.00125 m off is the resolution.
    EXPECT_NEAR(std::hypot(10, 1.00125) - 10, 0.05, 1e-6);
    EXPECT_GT(std::abs(strip_share(zone, 0.97, 3)), 1e-5);
    EXPECT_EQ(strip_share(zone, 1.01, 3), std::complex<double>(0));
}

}  // namespace
}  // namespace echoloop
