#include "render/paths/mirrors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace echoloop {
namespace {

constexpr double within = 1e-4;  ///< m inside of an outline

/// Calls use(where) for all crossings of edges with the line along `axis` through the point.
template <typename Use>
void each_crossing(std::span<const FaceEdge> edges, int axis, const double (&at)[2], const Use& use) {
    const auto along = static_cast<std::size_t>(axis), beside = 1 - along;
    const double line = at[beside];
    for (const FaceEdge& edge : edges) {
        const double a = edge.from[beside], b = edge.to[beside];
        if ((a <= line) == (b <= line)) continue;
        use(edge.from[along] + (line - a) / (b - a) * (double{edge.to[along]} - edge.from[along]));
    }
}

}  // namespace

Mirrors::Mirrors(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {
    for (const SceneFace& face : scene_->faces()) {
        double reach = 0;
        for (int u = 0; u < 2; ++u)
            for (int v = 0; v < 2; ++v)
                reach = std::max(reach, std::hypot(u == 0 ? face.low[0] : face.high[0],
                                                   v == 0 ? face.low[1] : face.high[1]));
        faces_.push_back({face.normal, dot(face.normal, face.origin), face.origin, reach});
    }
    planes_.resize(faces_.size());
    for (std::size_t i = 0; i < faces_.size(); ++i) keep_plane(i);
    for (const SceneMover& mover : scene_->movers()) movers_.push_back(mover.rest);
    place(std::vector<Pose>(movers_));
}

void Mirrors::place(std::span<const Pose> movers) {
    std::ranges::copy(movers.first(std::min(movers.size(), movers_.size())), movers_.begin());
    const auto all = scene_->faces();
    for (std::size_t i = all.size(); i-- > 0 && all[i].mover > 0;) {  // they come last
        const Pose& pose = movers_[all[i].mover - 1];
        faces_[i].normal = rotate(pose.orientation, all[i].normal);
        faces_[i].middle = pose * all[i].origin;
        faces_[i].offset = dot(faces_[i].normal, faces_[i].middle);
        keep_plane(i);
    }
}

void Mirrors::keep_plane(std::size_t face) {
    const MirrorFace& plane = faces_[face];
    planes_.set(face, plane.normal, plane.offset, plane.middle, plane.reach);
}

double Mirrors::before(std::size_t face, Vec3 point) const {
    const double distance = dot(faces_[face].normal, point) - faces_[face].offset;
    return material(face).double_sided ? std::abs(distance) : distance;
}

bool Mirrors::holds(const SceneFace& face, const double (&at)[2]) const {
    bool inside = false;
    each_crossing(edges(face), 0, at, [&](double where) { inside = inside != (where > at[0]); });
    return inside;
}

Mirrors::Extent Mirrors::across(const SceneFace& face, int axis, const double (&at)[2]) const {
    Extent out{face.low[axis], face.high[axis]};
    each_crossing(edges(face), axis, at, [&](double where) {
        // A point on an edge has the face on one side of it only, as in holds().
        if (where > at[axis])
            out.high = std::min(out.high, where);
        else
            out.low = std::max(out.low, where);
    });
    return out;
}

Foot Mirrors::foot(std::size_t number, Vec3 point, const MirrorZone& zone) const {
    const SceneFace& face = scene_->faces()[number];
    const Vec3 local = face.mover > 0 ? inverse(movers_[face.mover - 1]) * point : point;
    const double foot[2] = {dot(local - face.origin, face.u), dot(local - face.origin, face.v)};
    double nearest[2] = {foot[0], foot[1]};
    Foot out;
    if (!holds(face, foot)) {
        double best = std::numeric_limits<double>::infinity();
        for (const FaceEdge& edge : edges(face)) {
            const double a[2] = {edge.from[0], edge.from[1]}, b[2] = {edge.to[0], edge.to[1]};
            const double along[2] = {b[0] - a[0], b[1] - a[1]};
            const double length = std::hypot(along[0], along[1]);
            if (!(length > 0)) continue;
            const double share =
                std::clamp(((foot[0] - a[0]) * along[0] + (foot[1] - a[1]) * along[1]) / (length * length),
                           std::min(0.5, within / length), 1 - std::min(0.5, within / length));
            const double u = a[0] + share * along[0], v = a[1] + share * along[1];
            const double off = std::hypot(foot[0] - u, foot[1] - v);
            if (off >= best) continue;
            best = off;  // outlines run with the face on their left
            nearest[0] = u - within * along[1] / length, nearest[1] = v + within * along[0] / length;
        }
        out.outside = best;
    }
    const Vec3 on = face.origin + nearest[0] * face.u + nearest[1] * face.v;
    out.nearest = face.mover > 0 ? movers_[face.mover - 1] * on : on;
    out.share = 1;
    for (int axis = 0; axis < 2; ++axis) {
        const Extent extent = across(face, axis, nearest);
        out.share *= strip_share(zone, extent.low - foot[axis], extent.high - foot[axis]);
    }
    const double most = face.area * zone.per_metre * zone.per_metre / 2;  // A / (lambda R / 2)
    if (const double amount = std::abs(out.share); amount > most) out.share *= most / amount;
    return out;
}

}  // namespace echoloop
