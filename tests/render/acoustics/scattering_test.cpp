#include "render/acoustics/scattering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "render/scene/seabeds.h"

namespace echoloop {
namespace {

constexpr double degree = std::numbers::pi / 180;

Material with_curve(std::vector<BackscatterPoint> points) {
    Material material;
    material.backscatter = std::move(points);
    return material;
}

TEST(Scattering, LambertOfMackenzie) {
    EXPECT_NEAR(backscatter_db(Material{}, 90 * degree), -27, 1e-9);
    EXPECT_NEAR(backscatter_db(Material{}, 30 * degree), -27 - 6.0206, 1e-4);
}

// What V7 needs: sigma / cos(i) is mu cos(i).
TEST(Scattering, TheTableOfLambertIsExact) {
    const StrengthTable table{Material{}};
    const double mu = std::pow(10, -2.7);
    for (float cosine = 0; cosine <= 1; cosine += 0.0137F)
        EXPECT_NEAR(table.at(cosine), mu * static_cast<double>(cosine), 1e-9) << "at " << cosine;
    EXPECT_EQ(table.at(0), 0);
    EXPECT_NEAR(table.at(1), mu, 1e-9);
}

TEST(Scattering, ACurveIsLinearInDecibels) {
    const Material material = with_curve({{10, -40}, {50, -30}, {90, -10}});
    EXPECT_NEAR(backscatter_db(material, 10 * degree), -40, 1e-9);
    EXPECT_NEAR(backscatter_db(material, 20 * degree), -37.5, 1e-9);
    EXPECT_NEAR(backscatter_db(material, 70 * degree), -20, 1e-9);
    EXPECT_NEAR(backscatter_db(material, 90 * degree), -10, 1e-9);
}

TEST(Scattering, ACurveFallsAsLambertBelowItsFirstAngle) {
    const Material material = with_curve({{10, -40}, {60, -30}});
    const double drop = 20 * std::log10(std::sin(2 * degree) / std::sin(10 * degree));
    EXPECT_NEAR(backscatter_db(material, 2 * degree), -40 + drop, 1e-9);
    EXPECT_NEAR(backscatter_db(material, 80 * degree), -30, 1e-9);  // as at its last
}

TEST(Scattering, TheTableFollowsTheCurve) {
    const Material material = with_curve({{0, -50}, {20, -40}, {60, -30}, {90, -15}});
    const StrengthTable table(material);
    for (double g = 1; g <= 90; g += 0.7) {
        const double cosine = std::sin(g * degree);
        const double strength =
            10 * std::log10(static_cast<double>(table.at(static_cast<float>(cosine))) * cosine);
        const double tolerance = g < 87 ? 0.05 : 0.4;  // the last cell is 2.5 deg wide
        EXPECT_NEAR(strength, backscatter_db(material, g * degree), tolerance) << "at " << g << " deg";
    }
    EXPECT_TRUE(std::isfinite(table.at(0)));
}

// Nothing of it beside a measured curve, which holds its own; and none where there is no wave.
TEST(Scattering, OnlyLambertSurfacesHaveALobe) {
    constexpr double wavenumber = 3000;
    Material material;
    EXPECT_EQ(facet_lobe(material, wavenumber, 1), 0) << "sediments have theirs in Lambert's constant";
    material.lobe = true;
    EXPECT_GT(StrengthTable(material, wavenumber).at(1), 50 * StrengthTable(material).at(1));
    EXPECT_NEAR(facet_lobe(material, wavenumber, 1) / 0.2204, 1, 0.01);  // 0.353^2 / (8 pi 0.15^2)
    const Material curve = with_curve({{10, -40}, {90, -10}});
    EXPECT_EQ(StrengthTable(curve, wavenumber).at(1), StrengthTable(curve).at(1));
}

// Linear between its points, the table still follows the narrowest lobe.
TEST(Scattering, TheTableFollowsTheLobe) {
    Material polished;
    polished.lobe = true;
    polished.slope = 0.02, polished.mu_db = -60;
    const StrengthTable table(polished, 3000);
    for (double i = 0; i < 4; i += 0.1) {
        const double cosine = std::cos(i * degree);
        const double expected = facet_lobe(polished, 3000, cosine) + 1e-6 * cosine * cosine;
        EXPECT_NEAR(static_cast<double>(table.at(static_cast<float>(cosine))) * cosine / expected, 1, 0.07)
            << "at " << i << " deg";
    }
}

// A mesh that stands for a curved surface has no coherent echo, so nothing is missing from its lobe.
TEST(Scattering, CurvedMeshesHaveTheWholeLobe) {
    Material smooth;
    smooth.lobe = true;
    smooth.roughness = 0;
    EXPECT_EQ(facet_lobe(smooth, 3000, 1), 0);
    smooth.mesh_slope = 0.05;
    EXPECT_GT(facet_lobe(smooth, 3000, 1), 0.1);
}

TEST(Scattering, AnglesOfACurveAscend) {
    EXPECT_THROW(StrengthTable(with_curve({{10, -40}, {10, -30}})), std::invalid_argument);
    EXPECT_THROW(StrengthTable(with_curve({{20, -40}, {10, -30}})), std::invalid_argument);
}

TEST(Scattering, SeabedsMeasuredAt200Kilohertz) {
    const double sand = backscatter_db(*seabed_by_name("sand-200khz"), 45 * degree);
    const double mud = backscatter_db(*seabed_by_name("mud-200khz"), 45 * degree);
    EXPECT_NEAR(sand, -36.75, 0.75);
    EXPECT_NEAR(mud, -46, 1);
    EXPECT_EQ(seabed_by_name("sand"), nullptr);
    for (const auto& name : known_seabeds()) {
        const auto& curve = seabed_by_name(name)->backscatter;
        for (std::size_t i = 1; i < curve.size(); ++i)
            EXPECT_GT(curve[i].strength_db, curve[i - 1].strength_db) << name;
    }
}

}  // namespace
}  // namespace echoloop
