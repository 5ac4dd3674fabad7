// Stand-ins keep the shape of what they stand for, with few triangles.
#include "render/scene/contraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <map>
#include <numbers>
#include <optional>

#include "render/scene/corner_normal.h"
#include "tests/render/meshes.h"

namespace echoloop {
namespace {

struct Contracted {
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

std::vector<std::uint32_t> with_area(const Mesh& mesh) {
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        if (norm(face_normal(mesh, &mesh.indices[i])) > 0.5)
            indices.insert(indices.end(), &mesh.indices[i], &mesh.indices[i] + 3);
    return indices;
}

Contracted contracted(const Mesh& mesh, double limit) {
    const auto indices = with_area(mesh);
    const Clusters finest(mesh, test::places_of(mesh), indices, 0x1p-12);
    Contraction contraction(finest);
    contraction.until(limit);
    const auto into = contraction.into();
    Contracted out;
    for (const std::uint32_t place : into) out.positions.push_back(contraction.position(place));
    for (std::size_t t = 0; t < finest.triangles().size(); ++t)
        if (contraction.is_left(t)) out.triangles.push_back(contraction.corners(t));
    return out;
}

double distance_from(const Vec3& centre, const Contracted& c, const std::array<std::uint32_t, 3>& corners) {
    Vec3 sum{};
    double most = 0;
    for (const std::uint32_t i : corners) {
        most = std::max(most, std::abs(norm(c.positions[i] - centre) - 2));
        sum = sum + (1.0 / 3) * c.positions[i];
    }
    return std::max(most, std::abs(norm(sum - centre) - 2));
}

// A sphere that may be off by e needs a number of triangles that goes as 1 / e.
TEST(Contraction, KeepsASphereWithinItsLimit) {
    const Vec3 centre{0.3, 0.1, 0.2};
    for (const double limit : {0.01, 0.05, 0.2}) {
        const Contracted c = contracted(test::sphere(centre, 2, 64), limit);
        for (const auto& corners : c.triangles)
            EXPECT_LT(distance_from(centre, c, corners), 1.4 * limit) << "limit " << limit;
        EXPECT_LT(static_cast<double>(c.triangles.size()), 15 / limit);
        EXPECT_GT(static_cast<double>(c.triangles.size()), 5 / limit);
    }
}

/// Height over x and y, if one of the triangles is there.
std::optional<double> height(const Contracted& c, const std::vector<std::size_t>& triangles, double x,
                             double y) {
    for (const std::size_t t : triangles) {
        const auto& [i, j, k] = c.triangles[t];
        const Vec3 a = c.positions[i], b = c.positions[j] - a, d = c.positions[k] - a;
        const double area = b.x * d.y - d.x * b.y;
        const double u = ((x - a.x) * d.y - d.x * (y - a.y)) / area,
                     v = (b.x * (y - a.y) - (x - a.x) * b.y) / area;
        if (u >= -1e-6 && v >= -1e-6 && u + v <= 1 + 1e-6) return a.z + u * b.z + v * d.z;
    }
    return std::nullopt;
}

/// The triangles that may be over each square metre.
using ByPlace = std::map<std::pair<int, int>, std::vector<std::size_t>>;

ByPlace by_place(const Contracted& c) {
    ByPlace out;
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
        int low[2] = {1000, 1000}, high[2] = {-1000, -1000};
        for (const std::uint32_t i : c.triangles[t]) {
            const double at[2] = {c.positions[i].x, c.positions[i].y};
            for (std::size_t k = 0; k < 2; ++k) {
                low[k] = std::min(low[k], static_cast<int>(std::floor(at[k])));
                high[k] = std::max(high[k], static_cast<int>(std::floor(at[k])));
            }
        }
        for (int x = low[0]; x <= high[0]; ++x)
            for (int y = low[1]; y <= high[1]; ++y) out[{x, y}].push_back(t);
    }
    return out;
}

TEST(Contraction, KeepsASeabedWithinItsLimitAndWithoutAHole) {
    const Mesh mesh = test::seabed(200);
    for (const double limit : {0.05, 0.2}) {
        const Contracted c = contracted(mesh, limit);
        const ByPlace triangles = by_place(c);
        double squares = 0;
        std::size_t inside = 0, missing = 0;
        for (const Vec3& p : mesh.positions) {
            if (std::max(std::abs(p.x), std::abs(p.y)) > 59) continue;
            ++inside;
            const auto found =
                triangles.find({static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))});
            const auto z = found == triangles.end() ? std::nullopt : height(c, found->second, p.x, p.y);
            missing += !z;
            const double off = z ? *z - p.z : 0;
            EXPECT_LT(std::abs(off), 1.4 * limit);
            squares += off * off;
        }
        EXPECT_EQ(missing, 0U);
        for (const auto& [i, j, k] : c.triangles)  // none is turned over
            EXPECT_GT(cross(c.positions[j] - c.positions[i], c.positions[k] - c.positions[i]).z, 0);
        EXPECT_LT(std::sqrt(squares / static_cast<double>(inside)), limit / 3);
        EXPECT_LT(c.triangles.size(), mesh.indices.size() / (limit > 0.1 ? 15 : 3));
    }
}

// A plane becomes a few triangles, and none of its border is lost.
TEST(Contraction, LeavesLittleOfAPlaneButItsBorder) {
    const Contracted c = contracted(test::floor_at(-5, 10, 64), 1e-3);
    EXPECT_LT(c.triangles.size(), 12U);
    double area = 0;
    for (const auto& [i, j, k] : c.triangles)
        area += norm(cross(c.positions[j] - c.positions[i], c.positions[k] - c.positions[i])) / 2;
    EXPECT_NEAR(area, 400, 0.1);
    for (const Vec3& p : c.positions) EXPECT_NEAR(p.z, -5, 1e-9);
}

// Neither a limit that is smaller than a thing makes it vanish, nor does it stay for ever.
TEST(Contraction, ThingsVanishWhenTheyAreAsSmallAsTheLimit) {
    const Mesh small = test::sphere({0, 0, 0}, 0.1, 12);
    EXPECT_GT(contracted(small, 0.01).triangles.size(), 20U);
    EXPECT_GE(contracted(small, 0.04).triangles.size(), 4U);
    EXPECT_EQ(contracted(small, 1).triangles.size(), 0U);
}

// A star of all a mesh's triangles about one place, with rays of very different lengths. Each merger at that
// place would look at all of them: minutes instead of a second.
TEST(Contraction, IsNotHeldUpByAPlaceWhereAllTrianglesMeet) {
    constexpr std::uint32_t rays = 250'000;
    Mesh star;
    star.positions.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i < rays; ++i) {
        const double angle = 2 * std::numbers::pi * i / rays, length = 1 + i * 7919 % 1000 / 50.0;
        star.positions.push_back(
            {length * std::cos(angle), length * std::sin(angle), 1e-5 * (i * 104729 % 1000)});
        star.indices.insert(star.indices.end(), {0, 1 + i, 1 + (i + 1) % rays});
    }
    const std::clock_t begin = std::clock();
    const auto scene = test::scene_of({star});
    EXPECT_LT(std::clock() - begin, 8 * CLOCKS_PER_SEC) << "of processor time";
    EXPECT_EQ(scene->triangles(), rays);
}

}  // namespace
}  // namespace echoloop
