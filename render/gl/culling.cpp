#include "render/gl/culling.h"

#include <algorithm>
#include <array>
#include <utility>

namespace echoloop::gl {
namespace {

double at(const std::array<float, 3>& v, std::size_t axis) { return static_cast<double>(v[axis]); }

/// m^2; roots are for the few boxes that are seen.
double square_distance_to(const Bounds& box, Vec3 p) {
    const double coordinates[3] = {p.x, p.y, p.z};
    double squares = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double outside =
            std::max({at(box.min, axis) - coordinates[axis], coordinates[axis] - at(box.max, axis), 0.0});
        squares += outside * outside;
    }
    return squares;
}

double farthest_in(const Bounds& box, Vec3 p) {
    const double coordinates[3] = {p.x, p.y, p.z};
    double squares = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double off =
            std::max(coordinates[axis] - at(box.min, axis), at(box.max, axis) - coordinates[axis]);
        squares += off * off;
    }
    return std::sqrt(squares);
}

/// True when the box lies wholly more than `shift` m times the normal's length on the negative side of the
/// plane through `eye`.
bool behind(const Bounds& box, Vec3 eye, Vec3 normal, double shift) {
    const Vec3 farthest{normal.x > 0 ? at(box.max, 0) : at(box.min, 0),
                        normal.y > 0 ? at(box.max, 1) : at(box.min, 1),
                        normal.z > 0 ? at(box.max, 2) : at(box.min, 2)};
    return dot(farthest - eye, normal) + shift < 0;
}

/// Whether a box may be seen between those planes. What rays lift is asked only where it can count.
bool within(const Bounds& box, const SidePlanes& planes, Vec3 eye, Vec3 up, const RayTable* rays) {
    double range = -1;
    return std::none_of(planes.begin(), planes.end(), [&](Vec3 normal) {
        if (!behind(box, eye, normal, 0)) return false;
        if (rays == nullptr) return true;
        const double upwards = dot(normal, up);
        if (std::abs(upwards) < 1e-9) return true;
        if (range < 0) range = farthest_in(box, eye);
        return behind(box, eye, normal, range * std::abs(upwards) * rays->lift(range, upwards < 0));
    });
}

/// Inward normals of the four sides of the view's pyramid.
SidePlanes side_planes(const View& view, const Pose& world_from_fan, double margin) {
    const Quat q = world_from_fan.orientation * view.fan_from_view();
    const Vec3 forward = rotate(q, {1, 0, 0}), starboard = rotate(q, {0, -1, 0}), up = rotate(q, {0, 0, 1});
    return {starboard - (view.left - margin) * forward, (view.right + margin) * forward - starboard,
            up - (view.bottom - margin) * forward, (view.top + margin) * forward - up};
}

/// `square`: m^2, of the distance.
double tolerance_at(const ViewLimits& limits, double square) {
    constexpr double least = 0.1;
    const double full = limits.full_tolerance_range * limits.full_tolerance_range;
    return square >= full ? limits.tolerance : limits.tolerance * std::max(square / full, least);
}

/// Whether a stand-in that is off by `error`, in m, will do.
bool will_do(float error, double tolerance, double square) {
    const auto off = static_cast<double>(error);
    return off * off <= tolerance * tolerance * square;  // also chunks
}

}  // namespace

bool find_visible(const Scene& scene, NodeRange range, const View& view, const Pose& frame_from_fan,
                  const ViewLimits& limits, std::vector<std::uint32_t>& nodes, Vec3 up) {
    const auto planes = side_planes(view, frame_from_fan, limits.margin);
    const Vec3 eye = frame_from_fan.position;
    static thread_local std::vector<std::pair<float, std::uint32_t>> found;
    found.clear();
    const double end2 = limits.end_range * limits.end_range;
    bool wanted = false;
    for (std::uint32_t i = range.first; i < range.last;) {
        const SceneNode& node = scene.nodes()[i];
        const double square = square_distance_to(node.bounds, eye);
        const bool seen = square <= end2 && within(node.bounds, planes, eye, up, limits.rays);
        const bool hides =
            seen && limits.begin_range > 0 && farthest_in(node.bounds, eye) < limits.begin_range;
        const double tolerance = hides ? limits.hiding_tolerance : tolerance_at(limits, square);
        const bool good = will_do(node.error, tolerance, square);
        if (seen && good) found.emplace_back(static_cast<float>(std::sqrt(square)), i);
        wanted |= seen && good && !hides;
        i = seen && !good ? i + 1 : node.next;
    }
    std::sort(found.begin(), found.end());  // nearest first, so that depth tests save shading
    nodes.clear();
    for (const auto& [distance, node] : found) nodes.push_back(node);
    return wanted;
}

std::vector<std::uint32_t> find_around(const Scene& scene, NodeRange range, Vec3 eye, double radius,
                                       const ViewLimits& limits) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = range.first; i < range.last;) {
        const SceneNode& node = scene.nodes()[i];
        const double distance = std::max(0.0, std::sqrt(square_distance_to(node.bounds, eye)) - radius),
                     square = distance * distance;
        const bool near = distance <= limits.end_range;
        const bool good = will_do(node.error, tolerance_at(limits, square), square);
        if (near && good) found.push_back(i);
        i = near && !good ? i + 1 : node.next;
    }
    return found;
}

SeenBoxes::SeenBoxes(const View& view, const Pose& frame_from_fan, const ViewLimits& limits, Vec3 up)
    : planes_(side_planes(view, frame_from_fan, limits.margin)),
      eye_(frame_from_fan.position),
      up_(up),
      end_range_(limits.end_range),
      rays_(limits.rays) {}

bool SeenBoxes::has(const Bounds& box) const {
    return square_distance_to(box, eye_) <= end_range_ * end_range_ && within(box, planes_, eye_, up_, rays_);
}

}  // namespace echoloop::gl
