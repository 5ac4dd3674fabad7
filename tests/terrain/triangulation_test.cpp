// Triangles for samples of a grid: how far off they are, and that holes stay holes. Both are measured here
// anew, sample by sample and cell by cell.
#include "tools/import/terrain/triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tools/import/terrain/delaunay.h"

namespace echoloop::worlds {
namespace {

using Corners = std::array<GridPoint, 3>;

/// Hills, ripples and a step.
Heights bottom(std::int32_t width, std::int32_t height) {
    Heights out{width, height,
                std::vector<float>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
    for (std::int32_t y = 0; y < height; ++y)
        for (std::int32_t x = 0; x < width; ++x)
            out.at({x, y}) = static_cast<float>(-20 + 3 * std::sin(x / 17.0) * std::cos(y / 11.0) +
                                                0.05 * std::sin(x * 1.3) - (x + y > width ? 2 : 0));
    return out;
}

void dig(Heights& heights, GridPoint middle, std::int32_t radius) {
    for (std::int32_t y = std::max(middle.y - radius, 0);
         y <= std::min(middle.y + radius, heights.height - 1); ++y)
        for (std::int32_t x = std::max(middle.x - radius, 0);
             x <= std::min(middle.x + radius, heights.width - 1); ++x)
            if (std::hypot(x - middle.x, y - middle.y) <= radius) heights.at({x, y}) = NAN;
}

Corners corners_of(const Triangulation& mesh, std::size_t i) {
    const auto& t = mesh.triangles[i];
    return {mesh.corners[t[0]], mesh.corners[t[1]], mesh.corners[t[2]]};
}

double twice_area(GridPoint a, GridPoint b, GridPoint c) {
    return double(b.x - a.x) * double(c.y - a.y) - double(b.y - a.y) * double(c.x - a.x);
}

struct Measured {
    double area = 0, error = 0;
    std::size_t missed = 0;  ///< known samples under no triangle
    bool covers_hole = false;
};

Measured measure(const Triangulation& mesh, const Heights& heights) {
    Measured out;
    std::vector<bool> seen(heights.values.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = corners_of(mesh, i);
        const double area = twice_area(a, b, c);
        EXPECT_GT(area, 0) << "clockwise";
        out.area += area / 2;
        for (std::int32_t y = std::min({a.y, b.y, c.y}); y <= std::max({a.y, b.y, c.y}); ++y)
            for (std::int32_t x = std::min({a.x, b.x, c.x}); x <= std::max({a.x, b.x, c.x}); ++x) {
                const GridPoint p{x, y};
                const double u = twice_area(b, c, p) / area, v = twice_area(c, a, p) / area, w = 1 - u - v;
                if (std::min({u, v, w}) < -1e-12) continue;
                out.covers_hole = out.covers_hole || !heights.known(p);
                const double z = u * heights.at(a) + v * heights.at(b) + w * heights.at(c);
                out.error = std::max(out.error, std::abs(z - heights.at(p)));
                seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(heights.width) +
                     static_cast<std::size_t>(x)] = true;
            }
    }
    for (std::size_t i = 0; i < seen.size(); ++i) out.missed += !seen[i] && !std::isnan(heights.values[i]);
    return out;
}

std::size_t solid_cells(const Heights& heights) {
    std::size_t out = 0;
    for (std::int32_t y = 0; y + 1 < heights.height; ++y)
        for (std::int32_t x = 0; x + 1 < heights.width; ++x) out += heights.solid({x, y});
    return out;
}

TEST(Triangulation, NoSampleIsFartherOffThanTheError) {
    for (const double error : {1.0, 0.1, 0.01}) {
        Heights heights = bottom(150, 90);
        const auto mesh = triangulate(heights, {.error = error});
        const Measured measured = measure(mesh, heights);
        EXPECT_LE(measured.error, error);
        EXPECT_LE(measured.error, mesh.error + 1e-6);
        EXPECT_EQ(measured.missed, 0U);
        EXPECT_DOUBLE_EQ(measured.area, 149 * 89) << "overlaps or gaps";
    }
}

TEST(Triangulation, APlaneNeedsTwoTriangles) {
    Heights heights{50, 30, std::vector<float>(1500)};
    for (std::int32_t y = 0; y < 30; ++y)
        for (std::int32_t x = 0; x < 50; ++x) heights.at({x, y}) = static_cast<float>(x - 2 * y);
    EXPECT_EQ(triangulate(heights, {.error = 0.01}).triangles.size(), 2U);
}

TEST(Triangulation, HolesStayHolesToTheSample) {
    Heights heights = bottom(120, 120);
    dig(heights, {40, 40}, 15), dig(heights, {0, 100}, 9), dig(heights, {80, 60}, 0),
        dig(heights, {119, 119}, 5);
    const auto mesh = triangulate(heights, {.error = 0.5});
    const Measured measured = measure(mesh, heights);
    EXPECT_FALSE(measured.covers_hole);
    EXPECT_EQ(measured.missed, 0U);
    EXPECT_DOUBLE_EQ(measured.area, static_cast<double>(solid_cells(heights)));
    EXPECT_LE(measured.error, 0.5);
}

TEST(Triangulation, SpeckledHoles) {
    std::mt19937 random(5);
    Heights heights = bottom(64, 48);
    for (float& z : heights.values)
        if (random() % 4 == 0) z = NAN;
    const std::size_t cells = solid_cells(heights);
    const auto mesh = triangulate(heights, {.error = 0.2});
    const Measured measured = measure(mesh, heights);
    EXPECT_GT(mesh.lone, 0U) << "samples without neighbours make no surface";
    EXPECT_FALSE(measured.covers_hole);
    EXPECT_EQ(measured.missed, 0U) << "lone ones are taken away from the heights";
    EXPECT_DOUBLE_EQ(measured.area, static_cast<double>(cells));
}

TEST(Triangulation, KeepsToItsNumberOfTriangles) {
    Heights heights = bottom(200, 200);
    const auto mesh = triangulate(heights, {.error = 0.001, .most = 1000});
    EXPECT_LE(mesh.triangles.size(), 1000U);
    EXPECT_GE(mesh.triangles.size(), 998U);
    EXPECT_GT(mesh.error, 0.001);
    EXPECT_NEAR(measure(mesh, heights).error, mesh.error, 1e-5) << "it says how far off it is";
}

TEST(Triangulation, EdgesOfHolesMayNeedMoreThanThereAre) {
    Heights heights = bottom(60, 60);
    dig(heights, {30, 30}, 20);
    const auto mesh = triangulate(heights, {.error = 0.1, .most = 50});
    EXPECT_TRUE(mesh.triangles.empty());
    EXPECT_GT(mesh.needed, 50U);
}

TEST(Triangulation, LatticeHasACornerEverySoManySamples) {
    Heights heights = bottom(65, 65);
    for (float& z : heights.values) z = -10;
    const auto mesh = triangulate(heights, {.error = 1, .lattice = 16});
    EXPECT_EQ(mesh.corners.size(), 25U);
    EXPECT_EQ(mesh.triangles.size(), 32U);
}

TEST(Triangulation, NothingToStandOn) {
    Heights heights = bottom(3, 3);
    heights.at({1, 1}) = NAN;
    const auto mesh = triangulate(heights, {});
    EXPECT_TRUE(mesh.triangles.empty());
    EXPECT_EQ(mesh.lone, 8U);
}

/// No other point is within the circle of any triangle, with the largest coordinates that it takes.
TEST(GridDelaunay, IsDelaunay) {
    std::mt19937 random(7);
    const std::int32_t side = GridDelaunay::most_samples;
    GridDelaunay mesh(side, side);
    for (int i = 0; i < 300; ++i) {
        const GridPoint p{static_cast<std::int32_t>(random() % static_cast<unsigned>(side)),
                          static_cast<std::int32_t>(random() % static_cast<unsigned>(side))};
        if (!mesh.insert(p, 0)) continue;
        EXPECT_FALSE(mesh.insert(p, 0)) << "it is there";
    }
    for (std::uint32_t t = 0; t < mesh.size(); ++t) {
        const auto [i, j, k] = mesh.triangle(t);
        const GridPoint a = mesh.points()[i], b = mesh.points()[j], c = mesh.points()[k];
        // The centre from a, in long double: an independent formula.
        const long double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
        const long double d = 2 * (bx * cy - by * cx), bb = bx * bx + by * by, cc = cx * cx + cy * cy;
        const long double x = (cy * bb - by * cc) / d, y = (bx * cc - cx * bb) / d, r = std::hypot(x, y);
        for (const GridPoint p : mesh.points())
            EXPECT_GE(std::hypot(p.x - a.x - x, p.y - a.y - y), r * (1 - 1e-9L));
    }
}

}  // namespace
}  // namespace echoloop::worlds
