#include <algorithm>
#include <array>
#include <initializer_list>

#include "render/paths/corners.h"
#include "render/paths/lobe_cells.h"
#include "render/paths/searches.h"

namespace echoloop {
namespace {

constexpr double weakest_reflection = 1e-2;  ///< amplitude; what is weaker is not followed
constexpr int most_copies = 16;              ///< of an echo, over the beams that its cell is wide
constexpr double weakest_pattern = 1e-3;     ///< the same of the two patterns together

struct Lengths {
    double ray, other;  ///< m, the way of a cell's ray and the other one
};

/// What the ray of a cell meets, if it is straight.
struct Seen {
    Vec3 direction;
    std::optional<Encounter> first, mirrored;  ///< and behind that as its mirror
    Vec3 onward;                               ///< from the first, where that mirrors
    /// Of the last of both; where rays bend, in which direction and how far off it is seen.
    Sight sight{};
    double lift = 0;       ///< rad, elevation of `direction` over that of the cell's ray
    bool settled = false;  ///< need not be aimed again
};

/// The direction so much higher, rad.
Vec3 lifted(Vec3 direction, double angle) {
    if (angle == 0) return direction;
    const double across = std::max(std::sqrt(direction.x * direction.x + direction.y * direction.y), 1e-12);
    const double sine = std::sin(angle), cosine = std::cos(angle);
    return (cosine - direction.z * sine / across) * Vec3{direction.x, direction.y, 0} +
           (direction.z * cosine + across * sine) * Vec3{0, 0, 1};
}

/// At the lower and the upper edge of a cell: between them lies what the cell's echo covers.
using Stretch = std::array<Lengths, 2>;

/// What a cell's rays see if its surfaces went on as planes, for the stretch of range that the cell's echo
/// covers.
class Tangent {
  public:
    Tangent(const PathPing& ping, const Encounter& scatterer, Vec3 mirror_point, Vec3 mirror_normal,
            bool reflected)
        : sonar_(ping.sonar),
          mirror_point_(mirror_point),
          mirror_normal_(mirror_normal),
          reflected_(reflected),
          on_(scatterer.point),
          normal_(scatterer.normal) {
        if (!reflected_) return;
        on_ = mirrored(on_, mirror_point_, mirror_normal_);
        normal_ = normal_ - 2 * dot(normal_, mirror_normal_) * mirror_normal_;
    }

    /// Of a ray near one of the length `near`, which bounds what is taken from a plane that it grazes.
    Lengths at(Vec3 direction, double near) const {
        const double slope = dot(direction, normal_);
        const double length = slope < 0 ? dot(on_ - sonar_, normal_) / slope : 2 * near;
        const double ray = std::clamp(length, near / 2, 2 * near);
        return {ray, norm(mirrored(sonar_ + ray * direction, mirror_point_, mirror_normal_) - sonar_)};
    }

  private:
    Vec3 sonar_, mirror_point_, mirror_normal_;
    bool reflected_;
    Vec3 on_, normal_;
};

class DiffuseSearch {
  public:
    DiffuseSearch(const PathPing& ping, const LobeCells& cells, std::vector<PathEcho>& out,
                  std::vector<Corner>& corners)
        : ping_(ping), cells_(cells), rows_(ping.shot.rows() > 1), out_(out), corners_(ping, corners) {
        const auto& bearings = ping.shot.bearings;
        if (bearings.size() > 1)
            spacing_ = (bearings.back() - bearings.front()) / static_cast<double>(bearings.size() - 1);
    }

    void run() {
        const auto& cells = cells_.cells();
        look();
        for (own_ = 0; own_ < cells.size(); ++own_) {
            const Seen& seen = seen_[own_];
            if (!seen.first) continue;
            if (seen.mirrored) follow_mirror(cells[own_], seen);
            if (seen.first->mu > 0) return_by_surface(cells[own_], seen, *seen.first);
        }
    }

  private:
    /// Fills seen_. Where rays bend, a straight one by way of a mirror is aimed to where the cell's is by
    /// then.
    void look() {
        std::vector<std::size_t> asked;
        asked.reserve(cells_.cells().size()), seen_.reserve(cells_.cells().size());
        for (const LobeCell& cell : cells_.cells()) {
            asked.push_back(seen_.size());
            seen_.push_back(
                {rotate(ping_.world_from_fan, fan_direction(cell.bearing, cell.elevation)), {}, {}, {}});
        }
        look_along(asked);
        if (ping_.rays == nullptr) return;
        std::vector<Vec3> wanted;
        for (const Seen& seen : seen_) wanted.push_back(seen.direction);
        for (int round = 0; round < 2; ++round) {
            std::erase_if(asked, [&](std::size_t i) { return !aim_again(wanted[i], seen_[i]); });
            look_along(asked);
            std::erase_if(asked, [&](std::size_t i) { return seen_[i].settled; });
        }
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            const auto sight = seen_[i].first ? sight_of(seen_[i]) : std::nullopt;
            if (sight)
                seen_[i].sight = *sight;
            else
                seen_[i] = {wanted[i], {}, {}, {}};
        }
    }

    /// Turns what is looked along to where the ray of a cell will be; false where that needs no mirror.
    bool aim_again(Vec3 wanted, Seen& seen) const {
        if (!seen.first) return false;
        const bool by_surface = seen.first->material == nullptr, met = seen.mirrored.has_value();
        if (!by_surface && !met) return false;
        const double lift = ping_.lift(wanted, met ? seen.sight.length : ping_.end_range, by_surface);
        seen = {lifted(wanted, lift), {}, {}, {}};
        seen.lift = lift, seen.settled = met;
        return true;
    }

    std::optional<Sight> sight_of(const Seen& seen) const {
        if (!seen.mirrored) return ping_.sight(seen.first->point);
        const Encounter& mirror = *seen.first;
        return ping_.sight_by(seen.mirrored->point, mirror.point, mirror.normal, mirror.point);
    }

    /// Fills in what the rays of these cells meet.
    void look_along(std::span<const std::size_t> cells) {
        rays_.clear(), rays_.reserve(cells.size());
        for (const std::size_t i : cells)
            rays_.push_back({ping_.sonar, seen_[i].direction, 2 * ping_.end_range});
        met_.resize(rays_.size());
        ping_.space.meet(rays_, met_);
        std::vector<std::size_t> onward;
        onward.reserve(cells.size());
        rays_.clear();
        for (std::size_t k = 0; k < cells.size(); ++k) {
            Seen& seen = seen_[cells[k]];
            seen.first = met_[k];
            if (!seen.first) continue;
            const Encounter& mirror = *seen.first;
            seen.sight = {seen.direction, mirror.range};
            if (!(std::abs(mirror.reflection * mirror.flatness) > weakest_reflection)) continue;
            seen.onward = seen.direction - 2 * dot(seen.direction, mirror.normal) * mirror.normal;
            onward.push_back(cells[k]);
            rays_.push_back({mirror.point, seen.onward, 2 * ping_.end_range - mirror.range});
        }
        met_.resize(rays_.size());
        ping_.space.meet(rays_, met_);
        for (std::size_t k = 0; k < onward.size(); ++k) {
            Seen& seen = seen_[onward[k]];
            seen.mirrored = met_[k];
            if (seen.mirrored) seen.sight.length += seen.mirrored->range;
        }
    }

    /// Mirror first, scatterer second.
    void follow_mirror(const LobeCell& cell, const Seen& seen) {
        const Encounter &mirror = *seen.first, &met = *seen.mirrored;
        corners_.note(mirror, met, seen.onward);
        if (met.mu == 0) return;
        const double line = mirror.range + met.range, length = seen.sight.length;
        const Way way{ping_.seen(seen.sight.direction), length, mirror.reflection * mirror.flatness,
                      -dot(seen.onward, met.normal), 1};
        const auto stretch = stretch_of(cell, Tangent(ping_, met, mirror.point, mirror.normal, true),
                                        {line, norm(met.point - ping_.sonar)}, length / line,
                                        [&](const Seen& beside) { return behind_same(mirror, met, beside); });
        add_same(cell, way, way, met, stretch);
        const auto other = facing(direct_way(ping_, met.point), met, ping_.sonar);
        if (other) add_pair(cell, way, *other, met, stretch);
    }

    static bool same_plane(const Encounter& a, const Encounter& b) {
        constexpr double even = 0.999, near = 0.02;  // cosine, of 2.6 deg; m
        return dot(a.normal, b.normal) > even && std::abs(dot(a.point - b.point, a.normal)) < near;
    }

    /// What a ray beside it by way of the same mirror meets on another plane, which ends the own one.
    std::optional<Lengths> behind_same(const Encounter& mirror, const Encounter& met,
                                       const Seen& beside) const {
        if (!beside.mirrored || !same_plane(mirror, *beside.first) || same_plane(met, *beside.mirrored))
            return {};
        return Lengths{beside.first->range + beside.mirrored->range,
                       norm(beside.mirrored->point - ping_.sonar)};
    }

    /// Scatterer first, and the way by the surface leaves outside the cells, so that no ray finds it.
    void return_by_surface(const LobeCell& cell, const Seen& seen, const Encounter& met) {
        const auto surface = ping_.space.surface_above(ping_.sonar);
        if (!surface || met.range >= ping_.end_range) return;
        const Vec3 on{0, 0, surface->height}, down{0, 0, -1};
        const Vec3 image = mirrored(ping_.sonar, on, down);
        const Vec3 leaving = mirrored(met.point, on, down) - ping_.sonar;
        const Vec3 in_fan = rotate(conjugate(ping_.world_from_fan), 1 / norm(leaving) * leaving);
        const auto sight =
            ping_.rays != nullptr && seen.mirrored
                ? ping_.sight(met.point)
                : std::optional(Sight{seen.sight.direction, seen.mirrored ? met.range : seen.sight.length});
        if (!sight) return;
        const FanWeights up = ping_.pattern.weights(in_fan), own = ping_.heard(sight->direction);
        const double weight = std::abs(up.transmit * own.receive) + std::abs(up.receive * own.transmit);
        if (weight < weakest_pattern || cells_.contains(in_fan)) return;
        const auto other = facing(surface_way(ping_, met.point), met, image);
        if (!other) return;
        const Way way{ping_.seen(sight->direction), sight->length, 1, -dot(seen.direction, met.normal), 0};
        const auto stretch =
            stretch_of(cell, Tangent(ping_, met, on, down, false), {met.range, norm(met.point - image)},
                       sight->length / met.range, [&](const Seen& beside) -> std::optional<Lengths> {
                           if (!beside.first || beside.first->mu == 0 || same_plane(met, *beside.first))
                               return {};
                           return Lengths{beside.first->range, norm(beside.first->point - image)};
                       });
        add_pair(cell, way, *other, met, stretch);
        add_same(cell, way, *other, met, stretch);
    }

    /// With the cosine of incidence from `from`; empty where that is behind the surface.
    static std::optional<Way> facing(std::optional<Way> way, const Encounter& met, Vec3 from) {
        if (!way) return way;
        way->cosine = dot(from - met.point, met.normal) / norm(from - met.point);
        return way->cosine > 0 ? way : std::nullopt;
    }

    /// There and back by `used`; the cell's ray went by `way` and so measures the area.
    void add_same(const LobeCell& cell, const Way& way, const Way& used, const Encounter& met,
                  const Stretch& stretch) {
        const double strength = met.mu * used.cosine * used.cosine * area(cell, way);
        const bool own = &used == &way;
        ping_.echo(used, [&](const PairEcho& echo) {
            add(cell, stretch, echo, strength, [own](Lengths l) { return own ? l.ray : l.other; });
        });
    }

    void add_pair(const LobeCell& cell, const Way& way, const Way& other, const Encounter& met,
                  const Stretch& stretch) {
        const double strength = met.mu * way.cosine * other.cosine * area(cell, way);
        ping_.echo(way, other, [&](const PairEcho& echo) {
            add(cell, stretch, echo, strength, [](Lengths l) { return (l.ray + l.other) / 2; });
        });
    }

    /// `slowness`: of c t over straight lengths. `ends_at`: what a ray beside it meets that ends the own
    /// plane, which reaches no farther.
    template <typename EndsAt>
    Stretch stretch_of(const LobeCell& cell, const Tangent& tangent, const Lengths& own, double slowness,
                       EndsAt&& ends_at) const {
        const auto edge = [&](const KnownAngle& elevation, std::size_t beside, bool is_beside) {
            const Vec3 direction = rotate(ping_.world_from_fan, fan_direction(cell.bearing, elevation));
            Lengths straight = tangent.at(lifted(direction, seen_[own_].lift), own.ray);
            const auto end = is_beside ? ends_at(seen_[beside]) : std::nullopt;
            if (end) {
                const auto between = [](double value, double a, double b) {
                    return std::clamp(value, std::min(a, b), std::max(a, b));
                };
                straight = {between(straight.ray, own.ray, end->ray),
                            between(straight.other, own.other, end->other)};
            }
            return Lengths{slowness * straight.ray, slowness * straight.other};
        };
        const auto& cells = cells_.cells();
        return {edge(cell.low, own_ - 1, own_ > 0 && cells[own_ - 1].high.at == cell.low.at),
                edge(cell.high, own_ + 1, own_ + 1 < cells.size() && cells[own_ + 1].low.at == cell.high.at)};
    }

    static double area(const LobeCell& cell, const Way& way) {
        return way.length * way.length * cell.solid_angle / std::max(way.cosine, 1e-3);
    }

    template <typename Apparent>
    void add(const LobeCell& cell, const Stretch& stretch, const PairEcho& echo, double strength,
             Apparent&& apparent) {
        double near = echo.range, far = echo.range;
        for (const Lengths& edge : stretch) {
            near = std::min(near, apparent(edge));
            far = std::max(far, apparent(edge));
        }
        const double power = echo.amplitude * echo.amplitude * strength;
        if (power > 0)
            fill_beams(cell, echo, static_cast<float>(near), static_cast<float>(far),
                       static_cast<float>(power));
    }

    /// A cell is wider than a beam: its echo comes from all its bearings.
    void fill_beams(const LobeCell& cell, const PairEcho& arrival, float near, float far, float power) {
        PathEcho echo;
        echo.near_range = near, echo.far_range = far, echo.power = power;
        echo.turned = static_cast<float>(arrival.turned);
        const double width = cell.last_bearing - cell.first_bearing, bearing = arrival.bearing;
        if (rows_) {  // beams share it by their patterns over the cell
            echo.bearing = static_cast<float>(bearing),
            echo.elevation = static_cast<float>(arrival.elevation);
            echo.width = static_cast<float>(width),
            echo.height = static_cast<float>(cell.high.at - cell.low.at);
            out_.push_back(echo);
            return;
        }
        const int copies =
            spacing_ > 0 ? std::clamp(static_cast<int>(std::ceil(width / spacing_)), 1, most_copies) : 1;
        const double first = bearing - (cell.bearing.at - cell.first_bearing);
        echo.power /= static_cast<float>(copies);
        for (int i = 0; i < copies; ++i) {
            echo.bearing = static_cast<float>(copies == 1 ? bearing : first + (i + 0.5) / copies * width);
            out_.push_back(echo);
        }
    }

    const PathPing& ping_;
    const LobeCells& cells_;
    std::vector<Seen> seen_;  ///< one a cell
    std::vector<Ray> rays_;
    std::vector<std::optional<Encounter>> met_;  ///< by them
    std::size_t own_ = 0;                        ///< the cell that is looked at
    bool rows_;
    std::vector<PathEcho>& out_;
    CornerList corners_;
    double spacing_ = 0;
};

}  // namespace

void find_diffuse_echoes(const PathPing& ping, const LobeCells& cells, std::vector<PathEcho>& out,
                         std::vector<Corner>& corners) {
    DiffuseSearch(ping, cells, out, corners).run();
}

}  // namespace echoloop
