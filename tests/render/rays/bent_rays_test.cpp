// What the ray sampler sees in layered water, against rays of their own: time, incidence, what a pixel
// covers.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

#include "render/rays/ray_sampler.h"
#include "render/refraction.h"
#include "tests/render/meshes.h"

namespace echoloop {
namespace {

using Profile = std::vector<SoundSpeedPoint>;

constexpr double bottom = 45, wall = 70, screen = 25;  // m: the floor's depth, and how far ahead

/// A floor, a wall behind it, and a screen that hangs down from 4 to 12 m, seen from both sides.
std::shared_ptr<const Scene> basin() {
    Mesh hanging = test::wall_at(screen, 400, -12, -4);
    hanging.material.double_sided = true;
    return test::scene_of({test::floor_at(-bottom, 900), test::wall_at(wall, 900, -bottom, 0), hanging});
}

/// What a ray meets: its length (m of c t) and elevation there, and the number of basin()'s mesh.
struct Met {
    double length, elevation;
    int surface;
};

class OwnRays {
  public:
    OwnRays(const Profile& profile, double depth, double range)
        : profile_(profile), depth_(depth), range_(range), speed_(sound_speed_at(profile, depth)) {}

    std::optional<Met> meet(double elevation, double bearing) const {
        const double step = 1 / speed_, ahead = std::cos(bearing);
        RayPoint last{0, depth_, elevation};
        for (double time = 0; time * speed_ < range_; time += step) {
            const RayPoint next = ray_after(profile_, last, step);
            if (next.depth < 0) return {};
            const std::array behind{next.depth - bottom, next.distance * ahead - wall,
                                    next.distance * ahead - screen},
                before{last.depth - bottom, last.distance * ahead - wall, last.distance * ahead - screen};
            for (int surface : {0, 1, 2}) {
                const auto s = static_cast<std::size_t>(surface);
                if (before[s] >= 0 || behind[s] < 0) continue;
                const double part = within(last, step, [&](const RayPoint& p) {
                    return surface == 0 ? p.depth - bottom
                                        : p.distance * ahead - (surface == 1 ? wall : screen);
                });
                const RayPoint there = ray_after(profile_, last, part);
                if (surface == 2 && (there.depth < 4 || there.depth > 12)) continue;
                return Met{(time + part) * speed_, there.elevation, surface};
            }
            last = next;
        }
        return {};
    }

  private:
    template <typename Over>
    double within(const RayPoint& from, double step, const Over& over) const {
        double low = 0, high = step;
        for (int i = 0; i < 40; ++i) {
            const double middle = (low + high) / 2;
            (over(ray_after(profile_, from, middle)) < 0 ? low : high) = middle;
        }
        return high;
    }

    const Profile& profile_;
    double depth_, range_, speed_;
};

View view_ahead(double elevation_deg, bool surround) {
    View view{.elevation = deg_to_rad(elevation_deg),
              .left = -0.5,
              .right = 0.5,
              .bottom = -0.7,
              .top = 0.7,
              .lines = 20,
              .samples = 140};
    view.surround = surround;
    return view;
}

const Profile thermocline{{0, 1515}, {10, 1515}, {20, 1485}};
const Profile waters[] = {thermocline,
                          {{0, 1500}, {400, 1300}},
                          {{0, 1450}, {100, 1500}},
                          {{0, 1480}, {30, 1500}, {60, 1490}, {300, 1494}},
                          {{0, 1500}, {20, 1490}, {60, 1510}},
                          {{0, 1540}, {5, 1538}, {12, 1500}, {40, 1490}, {80, 1489}}};

struct Compared {
    int all = 0, other = 0, late = 0, turned = 0, wide = 0, widths = 0;
    double worst_time = 0, worst_angle_deg = 0;
};

void compare(const Profile& profile, double depth, const View& view,
             const std::shared_ptr<const Scene>& scene, Compared& sum) {
    constexpr double range = 100;
    const auto table = std::make_shared<const RayTable>(profile, depth, 1.02 * range, true);
    const Picture picture{{view}, view.lines, view.samples};
    const gl::Outlook outlook{.world_from_fan = {{0, 0, -depth}, {}},
                              .end_range = range,
                              .rays = table,
                              .rays_nearby = table,
                              .sag = 0.025};
    std::vector<Pixel> pixels;
    rays::RaySampler(scene, 1).sample(picture, outlook, pixels);
    const OwnRays own(profile, depth, range);
    const Quat q = view.fan_from_view();
    const auto meet = [&](double line, double sample) {
        const Vec3 to = rotate(q, {1, -view.x(line), view.y(sample)});
        return own.meet(std::atan2(to.z, std::hypot(to.x, to.y)), std::atan2(to.y, to.x));
    };
    for (std::size_t line = 0; line < view.lines; line += 6)
        for (std::size_t sample = 0; sample < view.samples; ++sample) {
            const Pixel& pixel = pixels[line * view.samples + sample];
            const double l = static_cast<double>(line) + 0.5, s = static_cast<double>(sample) + 0.5;
            const auto expected = meet(l, s);
            if (expected && expected->length > 0.99 * range) continue;
            ++sum.all;
            if (!expected || pixel.surface != static_cast<float>(1 + expected->surface)) {
                sum.other += expected.has_value() || (pixel.surface != 0 && pixel.range < 0.99F * range);
                continue;
            }
            const double error = static_cast<double>(pixel.range) / expected->length - 1;
            sum.late += std::abs(error) > 1e-3;
            sum.worst_time = std::max(sum.worst_time, std::abs(error));
            const Vec3 to = rotate(q, {1, -view.x(l), view.y(s)});
            const double bearing = std::atan2(to.y, to.x), e = expected->elevation;
            const bool floor = expected->surface == 0;
            const double cosine = floor ? -std::sin(e) : std::cos(e) * std::cos(bearing),
                         slope = floor ? std::cos(e) : std::abs(std::sin(e) * std::cos(bearing));
            const double angle = std::max(0.0, std::abs(static_cast<double>(pixel.cosine) - cosine) - 2e-5) /
                                 std::max(slope, 0.05);
            sum.turned += rad_to_deg(angle) > 0.1;
            sum.worst_angle_deg = std::max(sum.worst_angle_deg, rad_to_deg(angle));
            if (sample % 4 != 0) continue;
            constexpr double apart = 0.1;  // of a pixel
            const auto a = meet(l - apart, s), b = meet(l + apart, s), c = meet(l, s - apart),
                       d = meet(l, s + apart);
            if (!a || !b || !c || !d) continue;
            if (a->surface != b->surface || c->surface != d->surface) continue;
            const double width = std::min(
                0.5 * expected->length,
                std::max(std::abs(b->length - a->length), std::abs(d->length - c->length)) / (2 * apart));
            ++sum.widths;
            sum.wide +=
                std::abs(std::abs(static_cast<double>(pixel.footprint)) - width) > 0.03 * width + 5e-3;
        }
}

TEST(BentRays, MeetWhatRaysOfTheirOwnMeet) {
    const auto scene = basin();
    for (const bool surround : {false, true})
        for (const Profile& profile : waters)
            for (const double depth : {0.5, 9.0, 12.0, 20.0, 30.0}) {
                Compared sum;
                for (const double elevation : {0.0, -60.0})
                    compare(profile, depth, view_ahead(elevation, surround), scene, sum);
                const auto where = testing::Message()
                                   << "profile from " << profile.front().speed << ", " << depth << " m, "
                                   << (surround ? "surround" : "level") << ": " << sum.all << " rays, worst "
                                   << 100 * sum.worst_time << " % and " << sum.worst_angle_deg << " deg";
                EXPECT_GT(sum.all, 700) << where;
                EXPECT_LE(sum.other, sum.all / 60) << where << "; outlines are off by a quarter of a pixel";
                EXPECT_EQ(sum.late, 0) << where;
                EXPECT_EQ(sum.turned, 0) << where;
                EXPECT_LE(sum.wide, sum.widths / 20) << where;
            }
}

}  // namespace
}  // namespace echoloop
