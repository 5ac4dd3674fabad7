#include "render/scene/flat_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "render/scene/neighbours.h"
#include "render/scene/outline.h"
#include "render/scene/scratch.h"

namespace echoloop {
namespace {

constexpr double same_plane_cosine = 0.99996192;  ///< of half a degree
constexpr double smooth_cosine = 0.96592583;      ///< of 15 deg
constexpr double off_plane = 0.25e-3;             ///< m, an eighth of a wavelength at 750 kHz
constexpr double smooth_share = 0.4;  ///< of an outline; own choice: strips of a cylinder have half and more
constexpr double smaller_area = 0.125;  ///< of a neighbour that goes on as the same curve; own choice
constexpr double least_area = 1e-4;     ///< m^2
constexpr std::uint32_t none = Neighbours::none;
constexpr std::size_t shares = 4;  ///< of the patches, among threads: each looks at all triangles

/// Triangles in one plane while they are collected.
class PlaneSum {
  public:
    void add(double area, Vec3 normal, Vec3 middle) {
        moment_ = moment_ + area * middle;
        area_normal_ = area_normal_ + area * normal;
        area_ += area;
        normal_ = 1 / norm(area_normal_) * area_normal_;
        middle_ = 1 / area_ * moment_;
    }
    double area() const { return area_; }
    Vec3 normal() const { return normal_; }
    Vec3 middle() const { return middle_; }

  private:
    Vec3 moment_, area_normal_;  ///< sums of area times middle, and times normal
    double area_ = 0;            ///< m^2
    Vec3 normal_, middle_;
};

/// Square of an angle of which the cosine is near 1, in rad^2, within 1e-6 of itself up to 15 deg (the series
/// of arccos).
double squared_angle(double cosine) {
    const double d = 1 - cosine;
    return d * (2 + d * (1.0 / 3 + d * (4.0 / 45 + d / 35)));
}

class SurfaceFinder {
  public:
    SurfaceFinder(std::span<const Vec3> positions, std::span<const std::uint32_t> places,
                  std::span<const std::uint32_t> indices)
        : positions_(positions),
          indices_(indices),
          loops_(indices.size() / 3),
          normals_(indices.size() / 3),
          area_of_(indices.size() / 3) {
        const std::size_t count = indices.size() / 3;
        loops_.each(count, [&](std::size_t t) {
            const Vec3 doubled = doubled_area_of(static_cast<std::uint32_t>(t));
            const double length = norm(doubled);
            normals_[t] = 1 / length * doubled;
            area_of_[t] = length / 2;
        });
        neighbours_.emplace(places, indices, normals_.all(), loops_);
        patch_of_.assign(count, none);
        areas_.reserve(count);
        Scratch<std::uint8_t> alone(count);
        loops_.each(count, [&](std::size_t t) { alone[t] = joins_none(static_cast<std::uint32_t>(t)); });
        for (std::uint32_t t = 0; t < count; ++t)
            if (patch_of_[t] == none) alone[t] ? make_patch(t) : grow_patch(t);
        measure_outlines();
    }

    MeshSurfaces surfaces() {
        MeshSurfaces out;
        out.mesh_slope = mesh_slope();
        std::vector<std::uint32_t> flat;
        const auto is_curved = [this](std::uint32_t patch) { return curved_[patch] != 0; };
        if (std::ranges::find(curved_, 0) == curved_.end()) {
            out.curved.assign(indices_.begin(), indices_.end());
            return out;
        }
        const auto curved_ones = static_cast<std::size_t>(std::ranges::count_if(patch_of_, is_curved));
        out.curved.reserve(3 * curved_ones), out.flat.reserve(indices_.size() - 3 * curved_ones);
        for (std::uint32_t t = 0; t < patch_of_.size(); ++t) {
            const bool curved = is_curved(patch_of_[t]);
            auto& part = curved ? out.curved : out.flat;
            part.insert(part.end(), &indices_[std::size_t{3} * t], &indices_[std::size_t{3} * t] + 3);
            if (!curved) flat.push_back(t);
        }
        std::vector<std::uint32_t> by_patch = flat;
        std::ranges::stable_sort(by_patch, {}, [this](std::uint32_t t) { return patch_of_[t]; });
        std::vector<float> facet(areas_.size());
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

    Vec3 doubled_area_of(std::uint32_t triangle) const {
        return cross(at(triangle, 1) - at(triangle, 0), at(triangle, 2) - at(triangle, 0));
    }

    bool joins(const PlaneSum& plane, std::uint32_t triangle) const {
        if (dot(normals_[triangle], plane.normal()) < same_plane_cosine) return false;
        for (unsigned corner = 0; corner < 3; ++corner)
            if (std::abs(dot(at(triangle, corner) - plane.middle(), plane.normal())) > off_plane)
                return false;
        return true;
    }

    void add_to(PlaneSum& plane, std::uint32_t triangle) const {
        plane.add(area_of_[triangle], normals_[triangle],
                  1.0 / 3 * (at(triangle, 0) + at(triangle, 1) + at(triangle, 2)));
    }

    /// So that most of a curved surface is looked at by all threads.
    bool joins_none(std::uint32_t triangle) const {
        PlaneSum plane;
        add_to(plane, triangle);
        for (unsigned side = 0; side < 3; ++side)
            if (const std::uint32_t other = neighbours_->beyond(triangle, side);
                other != none && joins(plane, other))
                return false;
        return true;
    }

    /// Of one triangle.
    void make_patch(std::uint32_t triangle) {
        patch_of_[triangle] = static_cast<std::uint32_t>(areas_.size());
        areas_.push_back(area_of_[triangle]);
    }

    void grow_patch(std::uint32_t seed) {
        const auto patch = static_cast<std::uint32_t>(areas_.size());
        PlaneSum plane;
        const auto take = [&](std::uint32_t triangle) {
            add_to(plane, triangle);
            patch_of_[triangle] = patch;
            queue_.push_back(triangle);
        };
        queue_.clear();
        take(seed);
        for (std::size_t next = 0; next < queue_.size(); ++next)
            for (unsigned side = 0; side < 3; ++side) {
                const std::uint32_t other = neighbours_->beyond(queue_[next], side);
                if (other != none && patch_of_[other] == none && joins(plane, other)) take(other);
            }
        areas_.push_back(plane.area());
    }

    /// Calls use(length, patch, the other one or none, cosine between them) for all edges of the patches of
    /// one of `shares`, in the order of the triangles.
    template <typename Use>
    void each_edge(std::size_t share, const Use& use) const {
        const Share own(share, shares, areas_.size());
        for (std::uint32_t t = 0; t < patch_of_.size(); ++t) {
            const std::uint32_t patch = patch_of_[t];
            if (!own.has(patch)) continue;
            for (unsigned side = 0; side < 3; ++side) {
                const std::uint32_t other = neighbours_->beyond(t, side);
                if (other != none && patch_of_[other] == patch) continue;
                const double cosine = other == none ? -1 : dot(normals_[t], normals_[other]);
                use(norm(at(t, side + 1) - at(t, side)), patch, other == none ? none : patch_of_[other],
                    cosine);
            }
        }
    }

    /// Over edges between faces that go on as one curve.
    struct SlopeSum {
        double sum = 0, weight = 0;
        void add(double length, double cosine) {
            if (cosine < smooth_cosine) return;
            sum += length * squared_angle(cosine) / 4, weight += length;
        }
    };

    void measure_outlines() {
        struct Outline {
            double all = 0, smooth = 0;  // m
        };
        std::vector<Outline> outlines(areas_.size());
        loops_.parts(shares, [&](std::size_t share) {
            SlopeSum slopes;
            each_edge(share, [&](double length, std::uint32_t patch, std::uint32_t other, double cosine) {
                outlines[patch].all += length;
                if (cosine > smooth_cosine && areas_[other] > smaller_area * areas_[patch])
                    outlines[patch].smooth += length;
                slopes.add(length, cosine);
            });
            slopes_[share] = slopes;
        });
        curved_.reserve(outlines.size());
        for (const Outline& outline : outlines)
            curved_.push_back(outline.smooth > smooth_share * outline.all);
    }

    /// Of the curved ones: where all are, measure_outlines() has found it.
    double mesh_slope() {
        if (std::ranges::find(curved_, 0) != curved_.end())
            loops_.parts(shares, [&](std::size_t share) {
                SlopeSum slopes;
                each_edge(share, [&](double length, std::uint32_t patch, std::uint32_t other, double cosine) {
                    if (other != none && curved_[patch] && curved_[other]) slopes.add(length, cosine);
                });
                slopes_[share] = slopes;
            });
        double sum = 0, weight = 0;
        for (const SlopeSum& of_share : slopes_) sum += of_share.sum, weight += of_share.weight;
        return weight > 0 ? std::sqrt(sum / weight) : 0;
    }

    /// Returns the smaller side.
    float add_face(std::uint32_t number, std::span<const std::uint32_t> triangles,
                   std::vector<OutlinedFace>& faces) const {
        const double area = areas_[number];
        if (area < least_area) return static_cast<float>(std::sqrt(area));
        std::vector<OutlineEdge> edges;
        PlaneSum plane;
        for (const std::uint32_t t : triangles) {
            add_to(plane, t);
            for (unsigned side = 0; side < 3; ++side) {
                const std::uint32_t other = neighbours_->beyond(t, side);
                if (other == none || patch_of_[other] != number)
                    edges.push_back({neighbours_->corner(t, side), neighbours_->corner(t, side + 1),
                                     at(t, side), at(t, side + 1)});
            }
        }
        OutlinedFace out = outlined(plane.middle(), plane.normal(), edges);
        out.face.area = area;
        const double smaller =
            std::min(out.face.high[0] - out.face.low[0], out.face.high[1] - out.face.low[1]);
        faces.push_back(std::move(out));
        return static_cast<float>(smaller);
    }

    std::span<const Vec3> positions_;
    std::span<const std::uint32_t> indices_;
    MeshLoops loops_;
    Scratch<Vec3> normals_;
    Scratch<double> area_of_;                ///< m^2, of each triangle
    std::array<SlopeSum, shares> slopes_{};  ///< of each share of the patches
    std::optional<Neighbours> neighbours_;
    std::vector<std::uint32_t> patch_of_, queue_;
    std::vector<double> areas_;         ///< m^2, of each patch: triangles in one plane
    std::vector<std::uint8_t> curved_;  ///< which of them stand for a curved surface
};

}  // namespace

MeshSurfaces find_surfaces(std::span<const Vec3> positions, std::span<const std::uint32_t> places,
                           std::span<const std::uint32_t> indices) {
    if (indices.empty()) return {};
    return SurfaceFinder(positions, places, indices).surfaces();
}

}  // namespace echoloop
