// Positions, rotations and rigid poses in SI units. Standard library only; knows no GL and no file format.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace echoloop {

inline constexpr double deg_to_rad(double degrees) { return degrees * std::numbers::pi / 180.0; }
inline constexpr double rad_to_deg(double radians) { return radians * 180.0 / std::numbers::pi; }

struct Vec3 {
    double x = 0, y = 0, z = 0;
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }

/// Unit quaternion, Hamilton convention, order w x y z.
struct Quat {
    double w = 1, x = 0, y = 0, z = 0;
    friend constexpr bool operator==(const Quat&, const Quat&) = default;
};

constexpr Quat operator*(Quat a, Quat b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
constexpr Quat conjugate(Quat q) { return {q.w, -q.x, -q.y, -q.z}; }

constexpr Vec3 rotate(Quat q, Vec3 v) {
    const Vec3 u{q.x, q.y, q.z};
    const Vec3 t = 2.0 * cross(u, v);
    return v + q.w * t + cross(u, t);
}

/// Rotation by `angle` rad about the unit vector `axis`, right-handed.
inline Quat axis_angle(Vec3 axis, double angle) {
    const double s = std::sin(angle / 2);
    return {std::cos(angle / 2), s * axis.x, s * axis.y, s * axis.z};
}

/// Roll about x, pitch about y, yaw about z (rad), applied in that order about fixed axes (R = Rz Ry Rx).
/// In an FLU body, positive pitch lowers the nose and positive yaw turns to port.
inline Quat from_rpy(double roll, double pitch, double yaw) {
    return axis_angle({0, 0, 1}, yaw) * axis_angle({0, 1, 0}, pitch) * axis_angle({1, 0, 0}, roll);
}

/// A rigid pose; `world_from_sonar` maps sonar coordinates to world coordinates.
struct Pose {
    Vec3 position;
    Quat orientation;
    friend constexpr bool operator==(const Pose&, const Pose&) = default;
};

constexpr Vec3 operator*(const Pose& a_from_b, Vec3 p_b) {
    return a_from_b.position + rotate(a_from_b.orientation, p_b);
}
constexpr Pose operator*(const Pose& a_from_b, const Pose& b_from_c) {
    return {a_from_b * b_from_c.position, a_from_b.orientation * b_from_c.orientation};
}
constexpr Pose inverse(const Pose& a_from_b) {
    const Quat q = conjugate(a_from_b.orientation);
    return {rotate(q, -1.0 * a_from_b.position), q};
}

}  // namespace echoloop
