// Places on the Earth in a world. Expected values: PROJ 9.1, +proj=ortho +ellps=WGS84 about the origin.
#include "render/geographic.h"

#include <gtest/gtest.h>

namespace echoloop {
namespace {

constexpr GeoPlace oslofjord{59.4, 10.5, 0};

TEST(Geographic, PlacesAreWhereProjHasThem) {
    const Vec3 near = enu_from_place(oslofjord, {59.39, 10.51, -20});
    EXPECT_NEAR(near.x, 568.2401466947096, 1e-6);
    EXPECT_NEAR(near.y, -1113.9767534640234, 1e-6);
    EXPECT_EQ(near.z, -20) << "a height is not bent with the Earth";
    const Vec3 far = enu_from_place(oslofjord, {59.9, 11.2, 0});
    EXPECT_NEAR(far.x, 39176.845856635286, 1e-6);
    EXPECT_NEAR(far.y, 55908.443922642706, 1e-6);
}

TEST(Geographic, BackToThePlace) {
    for (const double latitude : {-75.0, -33.0, 0.0, 59.4, 75.0})
        for (const double longitude : {-179.9999, 10.5}) {
            const GeoPlace origin{latitude, longitude, 12};
            for (const double r : {0.0, 1.0, 1e3, 1e5}) {
                const Vec3 there{0.6 * r, -0.7 * r, -30};
                const GeoPlace place = place_from_enu(origin, there);
                EXPECT_LE(std::abs(place.longitude), 180);
                EXPECT_LT(norm(enu_from_place(origin, place) - there), 1e-5) << latitude << ' ' << r;
            }
        }
}

TEST(Geographic, HeightsCountFromTheOrigins) {
    EXPECT_EQ(enu_from_place({59.4, 10.5, 350}, {59.4, 10.5, 340}), (Vec3{0, 0, -10}));
    EXPECT_EQ(place_from_enu({59.4, 10.5, 350}, {0, 0, -10}).height, 340);
}

TEST(Geographic, NowhereIsNoNumber) {
    EXPECT_TRUE(std::isnan(enu_from_place(oslofjord, {91, 0, 0}).x));
    EXPECT_TRUE(std::isnan(enu_from_place(oslofjord, {NAN, 0, 0}).x));
    EXPECT_TRUE(std::isnan(enu_from_place(oslofjord, {-59.4, -169.5, 0}).x)) << "the other side";
}

}  // namespace
}  // namespace echoloop
