// Places on the Earth and where they are in a world: metres east and north on the plane that touches the
// ellipsoid WGS 84 at the world's origin, and metres above that origin's height. A height stays a height:
// it does not sink below the plane with the Earth's curvature, for the sea's surface is flat in a world.
// Standard library only.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/pose.h"

namespace echoloop {

struct GeoPlace {
    double latitude = 0, longitude = 0;  ///< deg, WGS 84, north and east
    double height = 0;                   ///< m above the sea level of a map or a fix
    friend bool operator==(const GeoPlace&, const GeoPlace&) = default;
};

namespace geographic {

inline constexpr double equator = 6378137.0, eccentricity2 = 6.69437999014e-3;  // WGS 84: NIMA TR8350.2
inline constexpr double steepest = 89;    ///< deg of latitude of an origin; nearer to a pole there is no east
                                          ///< to speak of
inline constexpr double highest = 12000;  ///< m: mountains and trenches are within it

/// m, from the middle of the Earth to the place's foot on the ellipsoid.
inline Vec3 foot(const GeoPlace& place) {
    const double latitude = deg_to_rad(place.latitude), longitude = deg_to_rad(place.longitude);
    const double s = std::sin(latitude), c = std::cos(latitude);
    const double normal = equator / std::sqrt(1 - eccentricity2 * s * s);
    return {normal * c * std::cos(longitude), normal * c * std::sin(longitude),
            normal * (1 - eccentricity2) * s};
}

struct Radii {
    double meridian = 0;  ///< m, of curvature from north to south
    double circle = 0;    ///< m, of the circle of latitude
};
inline Radii radii_at(double latitude) {
    const double s = std::sin(deg_to_rad(latitude)), root = std::sqrt(1 - eccentricity2 * s * s);
    return {equator * (1 - eccentricity2) / (root * root * root),
            equator / root * std::cos(deg_to_rad(latitude))};
}

}  // namespace geographic

/// m, ENU. Not finite for a place that is none, or that is on the Earth's other half.
inline Vec3 enu_from_place(const GeoPlace& origin, const GeoPlace& place) {
    const double latitude = deg_to_rad(origin.latitude), longitude = deg_to_rad(origin.longitude);
    const Vec3 way = geographic::foot(place) - geographic::foot(origin);
    const Vec3 east{-std::sin(longitude), std::cos(longitude), 0};
    const Vec3 up{std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                  std::sin(latitude)};
    const Vec3 north = cross(up, east);
    const bool is_place = std::abs(place.latitude) <= 90 && std::abs(place.longitude) <= 360;
    if (!is_place || dot(way, up) < -geographic::equator / 2) return {NAN, NAN, NAN};
    return {dot(way, east), dot(way, north), place.height - origin.height};
}

/// The place of which enu_from_place() makes `enu`: to a micrometre within 100 km of the origin, up to 75 deg
/// of latitude.
inline GeoPlace place_from_enu(const GeoPlace& origin, Vec3 enu) {
    GeoPlace place{origin.latitude, origin.longitude, origin.height + enu.z};
    for (int i = 0; i < 8; ++i) {  // each time the rest shrinks by the square of the angle to the origin
        const Vec3 now = enu_from_place(origin, place);
        const auto radii = geographic::radii_at(place.latitude);
        place.latitude =
            std::clamp(place.latitude + rad_to_deg((enu.y - now.y) / radii.meridian), -90.0, 90.0);
        place.longitude += rad_to_deg((enu.x - now.x) / radii.circle);
    }
    place.longitude = std::remainder(place.longitude, 360);
    return place;
}

}  // namespace echoloop
