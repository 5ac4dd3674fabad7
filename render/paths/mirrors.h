// The flat faces of a scene as mirrors, where they are at a ping: the foot of a perpendicular or of a path on
// each, and the share of its zones that is there. Knows no sonar.
#pragma once

#include <complex>
#include <memory>
#include <span>
#include <vector>

#include "render/paths/fresnel.h"
#include "render/paths/plane_kernels.h"
#include "render/scene/scene.h"

namespace echoloop {

/// A face's plane; what lies about it is within `reach` of its middle.
struct MirrorFace {
    Vec3 normal;
    double offset = 0;  ///< m: dot(normal, p) of a point in the plane
    Vec3 middle;
    double reach = 0;  ///< m
};

/// A point on a face's plane, as its outline sees it.
struct Foot {
    Vec3 nearest;                ///< point of the face, a tenth of a millimetre within its outline at least
    double outside = 0;          ///< m, from the point to the face; 0: on it
    std::complex<double> share;  ///< of the amplitude of a full plane
};

class Mirrors {
  public:
    explicit Mirrors(std::shared_ptr<const Scene> scene);

    /// world_from_object of all movers.
    void place(std::span<const Pose> movers);

    std::span<const MirrorFace> faces() const { return faces_; }
    const Material& material(std::size_t face) const {
        return scene_->materials()[scene_->faces()[face].material];
    }
    /// m in front of a face; negative behind one that is there from one side only.
    double before(std::size_t face, Vec3 point) const;
    /// As mark_near() has it, of all faces: valid until the next call.
    std::span<const std::uint8_t> near(Vec3 point, double end, double resolution) const {
        marks_.resize(planes_.size());
        mark_near(planes_, point, end, resolution, marks_.data());
        return marks_;
    }
    /// Whether a point of the face's plane can be on the face: quick, and true for many that are not.
    bool is_near(std::size_t face, Vec3 point) const {
        const Vec3 off = point - faces_[face].middle;
        return dot(off, off) <= 1.0001 * faces_[face].reach * faces_[face].reach;
    }
    /// `point` in the plane of the face. The share is the product of those of two strips, as wide as the face
    /// is at the nearest point; exact for rectangles. No face leaves more than its area does.
    Foot foot(std::size_t face, Vec3 point, const MirrorZone& zone) const;

  private:
    struct Extent {
        double low, high;
    };
    void keep_plane(std::size_t face);
    /// Along an axis through the point (u, v) of a face.
    Extent across(const SceneFace& face, int axis, const double (&at)[2]) const;
    bool holds(const SceneFace& face, const double (&at)[2]) const;
    std::span<const FaceEdge> edges(const SceneFace& face) const {
        return scene_->face_edges().subspan(face.first_edge, face.edges);
    }

    std::shared_ptr<const Scene> scene_;
    std::vector<MirrorFace> faces_;
    PlaneArrays planes_;  ///< of the same
    mutable std::vector<std::uint8_t> marks_;
    std::vector<Pose> movers_;
};

}  // namespace echoloop
