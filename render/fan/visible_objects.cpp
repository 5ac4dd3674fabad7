#include "render/fan/visible_objects.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>

#include "render/fan/arrays.h"
#include "render/view.h"

namespace echoloop {
namespace {

constexpr double rays_per_width = 4;
constexpr std::size_t least_columns = 24, rays_per_column = 64, most_parts = 2048;
constexpr int most_behind_each_other = 16;  ///< surfaces that a ray is followed through

/// Middles of equal parts of an interval of angles, rad.
struct Parts {
    double begin = 0, width = 0;
    std::size_t count = 0;
    double middle(std::size_t i) const { return begin + (static_cast<double>(i) + 0.5) * width; }
};

Parts parts_of(double begin, double end, double most, double wanted, std::size_t least) {
    begin = std::max(begin, -most), end = std::min(end, most);
    const auto needed = static_cast<std::size_t>(std::ceil((end - begin) / wanted));
    const std::size_t count = std::clamp(needed, least, most_parts);
    return {begin, (end - begin) / static_cast<double>(count), count};
}

/// Those of ascending angles that are within `width` of one.
std::pair<std::size_t, std::size_t> within(const std::vector<double>& angles, double angle, double width) {
    const auto first = std::ranges::lower_bound(angles, angle - width);
    const auto last = std::ranges::upper_bound(angles, angle + width);
    return {static_cast<std::size_t>(first - angles.begin()),
            static_cast<std::size_t>(last - angles.begin())};
}

/// Looks along the rays of one array.
class ArrayLook {
  public:
    ArrayLook(const RayScene& rays, const ArrayShot& array, double end, double turn,
              std::map<std::uint32_t, ObjectInView>& objects, std::vector<std::vector<BeamSight>>& sights)
        : rays_(rays),
          shot_(array.shot),
          first_beam_(array.first_beam),
          end_(end),
          reach_(shot_.beam_width + turn),
          origin_(array.world_from_sonar.position),
          world_from_fan_(array.world_from_sonar.orientation * sonar_from_fan(shot_.pan, shot_.tilt)),
          elevations_(shot_.elevations.empty() ? std::vector<double>{0} : shot_.elevations),
          objects_(objects),
          sights_(sights) {}

    void look() {
        constexpr double all_round = std::numbers::pi, upright = 0.495 * std::numbers::pi;
        const Parts columns = parts_of(shot_.bearings.front() - reach_, shot_.bearings.back() + reach_,
                                       all_round, shot_.beam_width / rays_per_width, least_columns);
        const double height = shot_.fan_height;
        const Parts rows = parts_of(elevations_.front() - height, elevations_.back() + height, upright,
                                    shot_.rows() > 1 ? height / rays_per_width : 2 * height, rays_per_column);
        for (std::size_t i = 0; i < columns.count; ++i) look_along(columns.middle(i), rows, columns.width);
    }

  private:
    void look_along(double bearing, const Parts& rows, double width) {
        const auto beams = within(shot_.bearings, bearing, reach_);
        std::optional<BeamSight> last;  // of the ray below
        for (std::size_t i = 0; i < rows.count; ++i) {
            const double elevation = rows.middle(i), cosine = std::cos(elevation);
            const Vec3 direction{cosine * std::cos(bearing), -cosine * std::sin(bearing),
                                 std::sin(elevation)};
            const auto hit = follow(rotate(world_from_fan_, direction), cosine * width * rows.width);
            if (!hit) {
                last.reset();
                continue;
            }
            BeamSight sight{hit->object, hit->range, hit->range};
            if (last && last->object == sight.object)
                sight.near = std::min(sight.near, last->near), sight.far = std::max(sight.far, last->far);
            add(sight, beams, within(elevations_, elevation, shot_.fan_height));
            last = BeamSight{hit->object, hit->range, hit->range};
        }
    }

    /// Counts what lies along the ray; what it meets first.
    std::optional<RayHit> follow(Vec3 direction, double solid_angle) {
        std::optional<RayHit> first;
        std::uint32_t met[most_behind_each_other];
        std::size_t known = 0;
        double from = 0;
        for (int i = 0; i < most_behind_each_other; ++i) {
            const auto hit = rays_.hit(origin_ + from * direction, direction, end_ - from);
            if (!hit) break;
            from += hit->range;
            if (std::find(met, met + known, hit->object) == met + known) {
                ObjectInView& object = objects_[hit->object];
                object.object = hit->object;
                object.whole += solid_angle;
                if (!first) object.seen += solid_angle;
                met[known++] = hit->object;
            }
            if (!first) first = hit;
        }
        return first;
    }

    void add(const BeamSight& sight, std::pair<std::size_t, std::size_t> beams,
             std::pair<std::size_t, std::size_t> rows) {
        for (std::size_t row = rows.first; row < rows.second; ++row)
            for (std::size_t beam = beams.first; beam < beams.second; ++beam) {
                auto& all = sights_[first_beam_ + row * shot_.bearings.size() + beam];
                if (!all.empty() && all.back().object == sight.object && all.back().near <= sight.far &&
                    sight.near <= all.back().far) {  // goes on
                    all.back().near = std::min(all.back().near, sight.near);
                    all.back().far = std::max(all.back().far, sight.far);
                } else {
                    all.push_back(sight);
                }
            }
    }

    const RayScene& rays_;
    const Shot& shot_;
    std::size_t first_beam_;
    double end_, reach_;
    Vec3 origin_;
    Quat world_from_fan_;
    std::vector<double> elevations_;
    std::map<std::uint32_t, ObjectInView>& objects_;
    std::vector<std::vector<BeamSight>>& sights_;
};

}  // namespace

Look VisibleObjects::look(const Shot& shot, const Pose& world_from_sonar, std::span<const Pose> movers,
                          double end, double turn) {
    rays_.place(movers);
    Look look;
    look.sights.resize(shot.beams());
    std::map<std::uint32_t, ObjectInView> objects;
    for (const ArrayShot& array : arrays_of(shot, world_from_sonar))
        ArrayLook(rays_, array, end, turn, objects, look.sights).look();
    for (const auto& [number, object] : objects) look.objects.push_back(object);
    return look;
}

}  // namespace echoloop
