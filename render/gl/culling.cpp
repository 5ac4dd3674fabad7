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

/// Inward normals of the four sides of the view's pyramid.
std::array<Vec3, 4> side_planes(const View& view, const Pose& world_from_fan, double margin) {
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
    const SeenBoxes boxes(view, frame_from_fan, limits, up);
    const Vec3 eye = frame_from_fan.position;
    static thread_local std::vector<std::pair<float, std::uint32_t>> found;
    found.clear();
    const double end2 = limits.end_range * limits.end_range;
    bool wanted = false;
    for (std::uint32_t i = range.first; i < range.last;) {
        const SceneNode& node = scene.nodes()[i];
        const double square = square_distance_to(node.bounds, eye);
        const bool seen = square <= end2 && boxes.between_sides(node.bounds);
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
    : upwards_{},
      most_lift_{},
      eye_(frame_from_fan.position),
      end_range_(limits.end_range),
      rays_(limits.rays) {
    const auto planes = side_planes(view, frame_from_fan, limits.margin);
    for (int side = 0; side < 4; ++side) {
        const Vec3 normal = planes[static_cast<std::size_t>(side)];
        x_[side] = static_cast<float>(normal.x), y_[side] = static_cast<float>(normal.y);
        z_[side] = static_cast<float>(normal.z);
        const double upwards = dot(normal, up);
        if (rays_ == nullptr || std::abs(upwards) < 1e-9) continue;
        upwards_[side] = static_cast<float>(upwards);
        most_lift_[side] =
            static_cast<float>(std::abs(upwards) * end_range_ * rays_->lift(end_range_, upwards < 0));
    }
}

bool SeenBoxes::between_sides(const Bounds& box) const {
    const auto off = [](float coordinate, double eye) {
        return static_cast<float>(static_cast<double>(coordinate) - eye);
    };
    const float low_x = off(box.min[0], eye_.x), low_y = off(box.min[1], eye_.y),
                low_z = off(box.min[2], eye_.z), high_x = off(box.max[0], eye_.x),
                high_y = off(box.max[1], eye_.y), high_z = off(box.max[2], eye_.z);
    const auto greater = [](Four a, Four b) { return a > b ? a : b; };
    const Four inside =
        greater(x_ * low_x, x_ * high_x) + greater(y_ * low_y, y_ * high_y) +
        greater(z_ * low_z, z_ * high_z);  // times the normals' lengths, of the corner farthest in
    const auto any_below_0 = [](Four v) { return std::min(std::min(v[0], v[1]), std::min(v[2], v[3])) < 0; };
    if (!any_below_0(inside)) return true;
    if (rays_ == nullptr) return false;
    if (any_below_0(inside + most_lift_)) return false;
    // What rays lift is asked only where it can count.
    const double range = farthest_in(box, eye_);
    for (int side = 0; side < 4; ++side) {
        if (inside[side] >= 0) continue;
        const auto upwards = static_cast<double>(upwards_[side]);
        if (upwards == 0 ||
            static_cast<double>(inside[side]) + range * std::abs(upwards) * rays_->lift(range, upwards < 0) <
                0)
            return false;
    }
    return true;
}

bool SeenBoxes::has(const Bounds& box) const {
    return square_distance_to(box, eye_) <= end_range_ * end_range_ && between_sides(box);
}

}  // namespace echoloop::gl
