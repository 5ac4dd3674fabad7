// V34 to V36: rays in layered water, and what a sonar sees by them.
#include <algorithm>
#include <array>
#include <cmath>

#include "render/ray_table.h"
#include "render/refraction.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

using SoundProfile = std::vector<SoundSpeedPoint>;

/// The time, s, at which a ray has come so far that `there` holds.
template <typename There>
double time_until(const SoundProfile& profile, RayPoint start, double most, There there) {
    double low = 0, high = most;
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2;
        (there(ray_after(profile, start, middle)) ? high : low) = middle;
    }
    return high;
}

RendererOptions bending() { return with(only({Effect::spreading, Effect::refraction})); }

/// m, where a table's shadow begins at the sonar's depth.
double shadow_edge(const SoundProfile& profile, double range) {
    const RayTable table(profile, 5, range, true);
    double x = 1;
    while (x < range && table.at(x, 0).clearance >= 0) x += 0.05;
    return x;
}

}  // namespace

void check_constant_gradient(Findings& find) {
    const SoundProfile down{{0, 1550}, {100, 1500}, {400, 1350}};  // q = -0.5 /s
    find.source(
        "Snell's law, circular arcs (Jensen et al. 2011, chapter 3): c 1500 m/s at the sonar, q -0.5 /s");
    const auto at = [&](double elevation_deg, double distance) {
        const RayPoint start{0, 100, deg_to_rad(elevation_deg)};
        const double time =
            time_until(down, start, 1, [&](const RayPoint& ray) { return ray.distance >= distance; });
        return std::pair(ray_after(down, start, time), time);
    };
    find.within("drop of a level ray at 60 m", "m", 0.6001, 1e-3, at(0, 60).first.depth - 100);
    find.within("drop of a level ray at 300 m", "m", 15.038, 1e-3, at(0, 300).first.depth - 100);
    find.within("its time", "ms", 200.671, 1e-3, 1e3 * at(0, 300).second);
    find.within("its elevation on arrival", "deg", -5.739, 1e-3, rad_to_deg(at(0, 300).first.elevation));
    find.within("drop of a ray 10 deg down at 60 m", "m", 11.2005, 1e-3, at(-10, 60).first.depth - 100);
    find.within("drop of a ray 10 deg down at 300 m", "m", 68.684, 1e-3, at(-10, 300).first.depth - 100);
    find.source("the ray that touches the surface: c 1500 m/s there, source and target 5 m deep");
    find.within("edge of the shadow, q -0.5 /s", "m", 346.27, 1, shadow_edge({{0, 1500}, {100, 1450}}, 500));
    find.within("edge of the shadow, q -3 /s", "m", 141.07, 1, shadow_edge({{0, 1500}, {50, 1350}}, 250));
}

void check_thermocline(Findings& find) {
    const SoundProfile profile{{0, 1515}, {10, 1515}, {20, 1485}};
    Water water;
    water.profile = profile;
    Renderer renderer(scene_of({floor_at(-100, 500)}), water, bending());
    Shot shot = fan(1, 3, 1, 4000, 270);
    shot.bearings.clear();
    shot.tilt = deg_to_rad(-90);
    const std::array<std::array<double, 4>, 5> rows{{{0, 0, 65.820, 0},
                                                     {30, 55.30, 75.574, 29.35},
                                                     {45, 94.73, 91.540, 43.88},
                                                     {60, 159.00, 125.438, 58.09},
                                                     {65, 192.29, 144.944, 62.67}}};
    for (const auto& row : rows) shot.bearings.push_back(deg_to_rad(row[0]));
    const Echogram picture = renderer.render(shot, Pose{{0, 0, -2}, {}});
    find.source(
        "Snell's law layer by layer: sonar 2 m deep, bottom 100 m deep, c 1515 m/s to 10 m, 1485 from 20 m");
    const RayTable table(profile, 2, 300, true);
    double worst = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& [launch, x, ms, arrival] = rows[i];
        const std::string at = " at " + std::to_string(static_cast<int>(launch)) + " deg";
        const RayPoint start{0, 2, deg_to_rad(launch - 90)};
        const double time =
            time_until(profile, start, 1, [&](const RayPoint& ray) { return ray.depth >= 100; });
        const RayPoint end = ray_after(profile, start, time);
        find.within("distance" + at, "m", x, 0.02, end.distance);
        find.within("one-way time" + at, "ms", ms, 0.002, 1e3 * time);
        find.within("arrival" + at, "deg", arrival, 0.02, 90 + rad_to_deg(end.elevation));
        find.within("range of the drawn bottom" + at, "m", ms / 1e3 * 1515, 2 * 270.0 / 4000,
                    static_cast<double>(picture.truth[i].axis_range));
        // A host that traces with the true profile, for the time that the picture has.
        const RayPoint sounding =
            ray_after(profile, start, static_cast<double>(picture.truth[i].axis_range) / 1515);
        worst = std::max(worst, std::abs(sounding.depth - 100) / std::hypot(98.0, sounding.distance));
    }
    find.at_most("error of a host's soundings, share of their range", "%", 0.2, 100 * worst);
    for (const auto& [launch, ms, spreading] : {std::array{45.0, 91.540, -42.48}, {60.0, 125.438, -45.11}}) {
        const double length = ms / 1e3 * 1515;
        const double focus = static_cast<double>(
            table.focus(-static_cast<float>(std::cos(deg_to_rad(launch))), static_cast<float>(length)));
        find.within("one-way spreading at " + std::to_string(static_cast<int>(launch)) + " deg", "dB",
                    spreading, 0.05, 10 * std::log10(focus / (length * length)));
    }
}

void check_ducts(Findings& find) {
    const SoundProfile duct{{0, 1500}, {20, 1490}, {60, 1510}};
    find.source("arcs: c 1490 m/s at 20 m, rising 0.5 /s both ways, sonar and target at 20 m, 300 m apart");
    for (const auto& [launch, ms] : {std::pair(2.882, 201.257), {1.442, 201.321}}) {
        const RayPoint start{0, 20, deg_to_rad(launch)};
        const double time =
            time_until(duct, start, 0.3, [](const RayPoint& ray) { return ray.distance >= 300; });
        find.within("time of the ray launched at " + std::to_string(launch).substr(0, 5) + " deg", "ms", ms,
                    1e-3, 1e3 * time);
    }
    find.within("first echo in the table of rays", "ms", 201.257, 0.1,
                300 * (1 + RayTable(duct, 20, 400, true).at(300, 0).stretch) / 1490 * 1e3);
    SoundProfile munk;
    for (int z = 0; z <= 5000; z += 6) {
        const double e = 2 * (z - 1300) / 1300.0;
        munk.push_back({static_cast<double>(z), 1500 * (1 + 0.00737 * (e - 1 + std::exp(-e)))});
    }
    find.source("Munk, JASA 55 (1974) 220: rays from the axis, and from 5 m down to 4000 m");
    for (const auto& [launch, above, below, cycle] :
         {std::array{5.0, 733.9, 2095.8, 49.67}, {10.0, 304.6, 3279.6, 56.17}}) {
        double least = 1e9, most = 0;
        RayPoint ray{0, 1300, deg_to_rad(launch)}, last = ray;
        bool came_up = false;
        while (!(came_up && ray.depth <= 1300) && ray.distance < 1e5) {
            last = ray, ray = ray_after(munk, ray, 0.01);
            least = std::min(least, ray.depth), most = std::max(most, ray.depth);
            came_up |= last.elevation < 0 && ray.elevation >= 0;
        }
        const std::string at = " of a ray at " + std::to_string(static_cast<int>(launch)) + " deg";
        find.within("upper turning depth" + at, "m", above, 0.5, least);
        find.within("lower turning depth" + at, "m", below, 0.5, most);
        find.within("cycle" + at, "km", cycle, 0.02, ray.distance / 1e3);
    }
    for (const auto& [launch, x, seconds] :
         {std::array{30.0, 2239.92, 3.02521}, {45.0, 3826.02, 3.65361}, {60.0, 6371.85, 4.96716}}) {
        const RayPoint start{0, 5, deg_to_rad(launch - 90)};
        const double time =
            time_until(munk, start, 20, [](const RayPoint& ray) { return ray.depth >= 4000; });
        const std::string at = " to 4000 m at " + std::to_string(static_cast<int>(launch)) + " deg";
        find.within("distance" + at, "m", x, 0.1, ray_after(munk, start, time).distance);
        find.within("time" + at, "ms", 1e3 * seconds, 0.1, 1e3 * time);
    }
}

}  // namespace echoloop::validation
