#include "render/scene/neighbours.h"

#include <numeric>
#include <vector>

namespace echoloop {
namespace {

constexpr std::uint32_t most_at_a_place = 64;  ///< triangles; beyond, a fan has no neighbours

/// Corners by their places.
struct CornersAt {
    std::vector<std::uint32_t> first;  ///< first[place] up to first[place + 1] of the corners
    Scratch<std::uint32_t> corners;

    CornersAt(std::span<const std::uint32_t> places, std::size_t count)
        : first(count + 1), corners(places.size()) {
        for (const std::uint32_t place : places) ++first[place];
        std::partial_sum(first.begin(), first.end(), first.begin());
        for (std::size_t i = places.size(); i-- > 0;)
            corners[--first[places[i]]] = static_cast<std::uint32_t>(i);
    }
    std::span<const std::uint32_t> at(std::uint32_t place) const {
        return corners.all().subspan(first[place], first[place + 1] - first[place]);
    }
};

}  // namespace

Neighbours::Neighbours(std::span<const std::uint32_t> places, std::span<const std::uint32_t> indices,
                       std::span<const Vec3> normals, MeshLoops& loops)
    : corners_(indices.size()), beyond_(indices.size()) {
    loops.each(indices.size(), [&](std::size_t i) { corners_[i] = places[indices[i]]; });
    const CornersAt corners(corners_.all(), places.size());
    loops.each(indices.size() / 3, [&](std::size_t t) {
        const auto triangle = static_cast<std::uint32_t>(t);
        for (unsigned side = 0; side < 3; ++side) {
            const std::uint32_t a = corner(triangle, side), b = corner(triangle, side + 1);
            const auto at_a = corners.at(a), at_b = corners.at(b);
            const bool by_a = at_a.size() < at_b.size();
            std::uint32_t& best = beyond_[3 * t + side] = none;
            if ((by_a ? at_a : at_b).size() > most_at_a_place) continue;
            double straightest = -2;
            for (const std::uint32_t i : by_a ? at_a : at_b) {
                const std::uint32_t other = i / 3;
                if (other == triangle) continue;
                if (by_a ? corner(other, i % 3 + 2) != b : corner(other, i % 3 + 1) != a) continue;
                const double cosine = dot(normals[t], normals[other]);
                if (cosine > straightest) straightest = cosine, best = other;
            }
        }
    });
}

}  // namespace echoloop
