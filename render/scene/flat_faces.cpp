#include "render/scene/flat_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "render/scene/numbering.h"
#include "render/scene/outline.h"

namespace echoloop {
namespace {

constexpr double same_plane_cosine = 0.99996192;  ///< of half a degree
constexpr double smooth_cosine = 0.96592583;      ///< of 15 deg
constexpr double same_place = 1e-6;               ///< m, poles of a sphere are one place
constexpr double off_plane = 0.25e-3;             ///< m, an eighth of a wavelength at 750 kHz
constexpr double smooth_share = 0.4;  ///< of an outline; own choice: strips of a cylinder have half and more
constexpr double smaller_area = 0.125;  ///< of a neighbour that goes on as the same curve; own choice
constexpr double least_area = 1e-4;     ///< m^2
constexpr std::uint32_t none = ~0U;
constexpr std::uint32_t most_at_a_place = 64;  ///< triangles; beyond, a fan has no neighbours

struct Place {
    std::int64_t x = 0, y = 0, z = 0;
    bool operator==(const Place&) const = default;
    std::size_t hash() const {
        return mix(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y),
                   static_cast<std::uint64_t>(z));
    }
};

/// Triangles by their corners' places, whatever vertices the file repeats.
class Neighbours {
  public:
    Neighbours(std::span<const Vec3> positions, std::span<const std::uint32_t> indices) {
        Numbering<Place> number(positions.size());
        std::vector<std::uint32_t> place_of(positions.size(), none);
        corners_.reserve(indices.size());
        for (const std::uint32_t vertex : indices) {
            std::uint32_t& place = place_of[vertex];
            const Vec3 p = positions[vertex];
            if (place == none)
                place = number({std::llround(p.x / same_place), std::llround(p.y / same_place),
                                std::llround(p.z / same_place)});
            corners_.push_back(place);
        }
        first_at_.assign(number.keys().size() + 1, 0);
        for (const std::uint32_t place : corners_) ++first_at_[place + 1];
        std::partial_sum(first_at_.begin(), first_at_.end(), first_at_.begin());
        at_place_.resize(corners_.size());
        std::vector<std::uint32_t> next(first_at_.begin(), first_at_.end() - 1);
        for (std::uint32_t i = 0; i < corners_.size(); ++i) at_place_[next[corners_[i]]++] = i / 3;
    }

    std::uint32_t corner(std::uint32_t triangle, unsigned side) const {
        return corners_[3 * std::size_t{triangle} + side % 3];
    }
    /// Beyond the edge from corner `side` to the next: of those wound the same way the one that bends least.
    std::uint32_t beyond(std::uint32_t triangle, unsigned side, std::span<const Vec3> normals) const {
        const std::uint32_t a = corner(triangle, side), b = corner(triangle, side + 1);
        const std::uint32_t place = count_at(a) < count_at(b) ? a : b;
        if (count_at(place) > most_at_a_place) return none;
        std::uint32_t best = none;
        double straightest = -2;
        for (std::uint32_t i = first_at_[place]; i < first_at_[place + 1]; ++i) {
            const std::uint32_t other = at_place_[i];
            if (other == triangle || !has_edge(other, b, a)) continue;
            const double cosine = dot(normals[triangle], normals[other]);
            if (cosine > straightest) straightest = cosine, best = other;
        }
        return best;
    }

  private:
    std::uint32_t count_at(std::uint32_t place) const { return first_at_[place + 1] - first_at_[place]; }
    bool has_edge(std::uint32_t triangle, std::uint32_t from, std::uint32_t to) const {
        for (unsigned side = 0; side < 3; ++side)
            if (corner(triangle, side) == from && corner(triangle, side + 1) == to) return true;
        return false;
    }

    std::vector<std::uint32_t> corners_, first_at_, at_place_;
};

/// Triangles in one plane while they are collected.
struct Patch {
    Vec3 moment;                     ///< sum of area times middle
    Vec3 area_normal;                ///< sum of area times normal
    double area = 0;                 ///< m^2
    double outline = 0, smooth = 0;  ///< m
    bool curved = false;

    Vec3 normal() const { return 1 / norm(area_normal) * area_normal; }
    Vec3 middle() const { return 1 / area * moment; }
};

class SurfaceFinder {
  public:
    SurfaceFinder(std::span<const Vec3> positions, std::span<const std::uint32_t> indices)
        : positions_(positions), indices_(indices), neighbours_(positions, indices) {
        const std::size_t count = indices.size() / 3;
        normals_.reserve(count), areas_.reserve(count);
        for (std::uint32_t t = 0; t < count; ++t) {
            const Vec3 doubled = cross(at(t, 1) - at(t, 0), at(t, 2) - at(t, 0));
            const double length = norm(doubled);
            normals_.push_back(1 / length * doubled);
            areas_.push_back(length / 2);
        }
        patch_of_.assign(count, none);
        for (std::uint32_t t = 0; t < count; ++t)
            if (patch_of_[t] == none) grow_patch(t);
        measure_outlines();
    }

    MeshSurfaces surfaces() {
        MeshSurfaces out;
        out.mesh_slope = mesh_slope();
        std::vector<std::uint32_t> flat;
        for (std::uint32_t t = 0; t < patch_of_.size(); ++t) {
            const bool curved = patches_[patch_of_[t]].curved;
            auto& part = curved ? out.curved : out.flat;
            part.insert(part.end(), &indices_[std::size_t{3} * t], &indices_[std::size_t{3} * t] + 3);
            if (!curved) flat.push_back(t);
        }
        std::vector<std::uint32_t> by_patch = flat;
        std::ranges::stable_sort(by_patch, {}, [this](std::uint32_t t) { return patch_of_[t]; });
        std::vector<float> facet(patches_.size());
        for (std::size_t first = 0, last = 0; first < by_patch.size(); first = last) {
            const std::uint32_t patch = patch_of_[by_patch[first]];
            while (last < by_patch.size() && patch_of_[by_patch[last]] == patch) ++last;
            facet[patch] = add_face(patch, std::span(by_patch).subspan(first, last - first), out.faces);
        }
        for (const std::uint32_t t : flat) out.facet.push_back(facet[patch_of_[t]]);
        return out;
    }

  private:
    Vec3 at(std::uint32_t triangle, unsigned corner) const {
        return positions_[indices_[std::size_t{3} * triangle + corner % 3]];
    }

    bool joins(const Patch& patch, std::uint32_t triangle) const {
        const Vec3 normal = patch.normal(), middle = patch.middle();
        if (dot(normals_[triangle], normal) < same_plane_cosine) return false;
        for (unsigned corner = 0; corner < 3; ++corner)
            if (std::abs(dot(at(triangle, corner) - middle, normal)) > off_plane) return false;
        return true;
    }

    void take(std::uint32_t triangle) {
        Patch& patch = patches_.back();
        const double area = areas_[triangle];
        patch.moment = patch.moment + area / 3 * (at(triangle, 0) + at(triangle, 1) + at(triangle, 2));
        patch.area_normal = patch.area_normal + area * normals_[triangle];
        patch.area += area;
        patch_of_[triangle] = static_cast<std::uint32_t>(patches_.size() - 1);
        queue_.push_back(triangle);
    }

    void grow_patch(std::uint32_t seed) {
        patches_.emplace_back();
        queue_.clear();
        take(seed);
        for (std::size_t next = 0; next < queue_.size(); ++next)
            for (unsigned side = 0; side < 3; ++side) {
                const std::uint32_t other = neighbours_.beyond(queue_[next], side, normals_);
                if (other != none && patch_of_[other] == none && joins(patches_.back(), other)) take(other);
            }
    }

    /// Calls use(length, patch, the other one or none, cosine between them) for all edges of patches.
    template <typename Use>
    void each_edge(const Use& use) const {
        for (std::uint32_t t = 0; t < patch_of_.size(); ++t)
            for (unsigned side = 0; side < 3; ++side) {
                const std::uint32_t other = neighbours_.beyond(t, side, normals_);
                if (other != none && patch_of_[other] == patch_of_[t]) continue;
                const double cosine = other == none ? -1 : dot(normals_[t], normals_[other]);
                use(norm(at(t, side + 1) - at(t, side)), patch_of_[t],
                    other == none ? none : patch_of_[other], cosine);
            }
    }

    void measure_outlines() {
        each_edge([this](double length, std::uint32_t patch, std::uint32_t other, double cosine) {
            patches_[patch].outline += length;
            if (cosine > smooth_cosine && patches_[other].area > smaller_area * patches_[patch].area)
                patches_[patch].smooth += length;
        });
        for (Patch& patch : patches_) patch.curved = patch.smooth > smooth_share * patch.outline;
    }

    double mesh_slope() const {
        double sum = 0, weight = 0;
        each_edge([&](double length, std::uint32_t patch, std::uint32_t other, double cosine) {
            if (cosine < smooth_cosine || !patches_[patch].curved || !patches_[other].curved) return;
            const double half = std::acos(std::min(cosine, 1.0)) / 2;
            sum += length * half * half, weight += length;
        });
        return weight > 0 ? std::sqrt(sum / weight) : 0;
    }

    /// Returns the smaller side.
    float add_face(std::uint32_t number, std::span<const std::uint32_t> triangles,
                   std::vector<OutlinedFace>& faces) const {
        const Patch& patch = patches_[number];
        if (patch.area < least_area) return static_cast<float>(std::sqrt(patch.area));
        std::vector<OutlineEdge> edges;
        for (const std::uint32_t t : triangles)
            for (unsigned side = 0; side < 3; ++side) {
                const std::uint32_t other = neighbours_.beyond(t, side, normals_);
                if (other == none || patch_of_[other] != number)
                    edges.push_back({neighbours_.corner(t, side), neighbours_.corner(t, side + 1),
                                     at(t, side), at(t, side + 1)});
            }
        OutlinedFace out = outlined(patch.middle(), patch.normal(), edges);
        out.face.area = patch.area;
        const double smaller =
            std::min(out.face.high[0] - out.face.low[0], out.face.high[1] - out.face.low[1]);
        faces.push_back(std::move(out));
        return static_cast<float>(smaller);
    }

    std::span<const Vec3> positions_;
    std::span<const std::uint32_t> indices_;
    Neighbours neighbours_;
    std::vector<Vec3> normals_;
    std::vector<double> areas_;
    std::vector<std::uint32_t> patch_of_, queue_;
    std::vector<Patch> patches_;
};

}  // namespace

MeshSurfaces find_surfaces(std::span<const Vec3> positions, std::span<const std::uint32_t> indices) {
    if (indices.empty()) return {};
    return SurfaceFinder(positions, indices).surfaces();
}

}  // namespace echoloop
