#include "render/ray_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/ray_shooter.h"
#include "render/refraction.h"

namespace echoloop {

using rays::Crossing, rays::Level, rays::RowCrossings, rays::Shooter, rays::kinds;

namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();
constexpr int half_fan = 160;  ///< rays to either side of level

/// Elevations from straight down to straight up: dense near level, where rays bend most.
std::vector<double> fan_of_rays() {
    std::vector<double> all;
    for (int i = half_fan; i >= 1; --i) {
        const double part = static_cast<double>(i) / half_fan;
        all.push_back(-std::numbers::pi / 2 * (0.1 * part + 0.9 * part * part * part) +
                      (i == half_fan ? 1e-12 : 0));
    }
    for (int i = half_fan - 1; i >= 0; --i) all.push_back(-all[static_cast<std::size_t>(i)]);
    return all;
}

/// Four times as close at the sonar's depth as on the average, which lies in the middle between two rows.
RayTable::Rows rows_between(double above, double below) {
    RayTable::Rows rows{(above + below) / (4.0 * (RayTable::rows - 1)), 0, 0};
    double low = 0, high = above + below;
    for (int i = 0; i < 100; ++i) {
        rows.b = (low + high) / 2;
        (rows.row(above) + rows.row(below) > RayTable::rows - 1 ? low : high) = rows.b;
    }
    rows.first = -std::floor(rows.row(above)) - 0.5;
    return rows;
}

}  // namespace

RayTable::RayTable(std::span<const SoundSpeedPoint> profile, double depth, double range, bool surface)
    : profile_(profile.begin(), profile.end()),
      depth_(depth),
      range_(range),
      surface_(surface),
      speed_(sound_speed_at(profile, depth)) {
    const double most = 1.1 * range;  // rays may lead farther than c t, where sound is faster
    column_step_ = most / static_cast<double>(columns - 1);
    // From a little above the surface to as far down, with the sonar in the middle between two rows.
    const double up = surface ? std::min(most, std::max(depth, 0.0) + 0.05 * most) : most;
    places_ = rows_between(up, most);
    cells_.assign(rows * columns, {0, 0, 0, -std::numeric_limits<float>::infinity()});
    const auto whole = endless_profile(profile, 2 * most + 10);
    for (std::size_t i = 0; i + 1 < whole.size(); ++i)
        steepest_ = std::max(steepest_, std::abs((whole[i + 1].speed - whole[i].speed) /
                                                 (whole[i + 1].depth - whole[i].depth)));
    shoot(whole, surface);
    close_gaps();
    find_moves();
    find_errors(surface);
    find_focus(whole);
    if (surface && depth > 0) find_surface(whole);
    constexpr int parts = 16;  // of a row
    for (std::size_t row = 1; row < rows; ++row) {
        const double above = places_.below(static_cast<double>(row - 1)),
                     step = (places_.below(static_cast<double>(row)) - above) / parts;
        plumb_[row] = plumb_[row - 1];
        for (int part = 0; part < parts; ++part)
            plumb_[row] += step * speed_ / sound_speed_at(whole, depth_ + above + (part + 0.5) * step);
    }
}

void RayTable::shoot(std::span<const SoundSpeedPoint> profile, bool surface) {
    std::vector<Level> levels;
    for (std::size_t row = 0; row < rows; ++row) {
        const double at = depth_ + places_.below(static_cast<double>(row));
        levels.push_back({at, sound_speed_at(profile, at), static_cast<int>(row)});
    }
    for (const SoundSpeedPoint& point : profile) levels.push_back({point.depth, point.speed, -1});
    std::ranges::stable_sort(levels, {}, &Level::depth);
    const Shooter shooter(levels, depth_, speed_, column_step_ * static_cast<double>(columns) * 1.05);
    const double above = speed_ - sound_speed_at(profile, depth_ - 1e-3),
                 below = sound_speed_at(profile, depth_ + 1e-3) - speed_;

    std::vector<double> nearest(rows * columns, unreached);  // of c t
    const auto fill = [&](std::size_t row, const Crossing& a, const Crossing& b) {
        const double low = std::min(a.distance, b.distance), high = std::max(a.distance, b.distance);
        const double deeper = places_.below(static_cast<double>(row));
        auto column = static_cast<std::size_t>(std::max(0.0, std::ceil(low / column_step_ - 1e-9)));
        for (; column < columns && static_cast<double>(column) * column_step_ <= high + 1e-9 * column_step_;
             ++column) {
            const double x = static_cast<double>(column) * column_step_;
            const double part =
                high > low ? std::clamp((x - a.distance) / (b.distance - a.distance), 0.0, 1.0) : 0;
            const double stretch = std::lerp(a.stretch, b.stretch, part),
                         clearance = std::lerp(a.clearance, b.clearance, part);
            double length = std::hypot(x, deeper) * (1 + stretch);
            if (surface && clearance < 0) length += 1e6;  // any ray below the surface comes before it
            double& first = nearest[row * columns + column];
            if (length >= first) continue;
            first = length;
            const double kept = surface ? clearance : column_step_;
            cells_[row * columns + column] = {
                static_cast<float>(std::lerp(a.turn, b.turn, part)), static_cast<float>(stretch),
                static_cast<float>(std::lerp(a.bow, b.bow, part)), static_cast<float>(kept)};
        }
    };
    std::vector<RowCrossings> last(rows), now(rows);
    double last_elevation = 0;
    bool first = true;
    for (const double elevation : fan_of_rays()) {
        shooter.shoot(elevation, now);
        // Across level: a ray that turns at once continues its neighbour, which does not.
        const bool level = !first && last_elevation < 0 && elevation >= 0;
        const std::size_t last_more = below > 0 ? 1 : 0, now_more = above < 0 ? 1 : 0;
        for (std::size_t row = 0; row < rows && !first; ++row) {
            const RowCrossings &a = last[row], &b = now[row];
            if (level) {
                if (last_more == now_more) continue;
                for (std::size_t kind = 0; kind + 1 < kinds; ++kind)
                    if (const std::size_t k = kind + last_more, n = kind + now_more; a.has(k) && b.has(n))
                        fill(row, a.all[k], b.all[n]);
                continue;
            }
            for (std::size_t kind = 0; (a.there | b.there) >> kind != 0; ++kind) {
                if (a.has(kind) && b.has(kind)) fill(row, a.all[kind], b.all[kind]);
                // The last ray of several that reaches the row before it turns, and after.
                if (a.has(kind) && a.has(kind + 1) && !b.has(kind) && !b.has(kind + 1))
                    fill(row, a.all[kind], a.all[kind + 1]);
                if (b.has(kind) && b.has(kind + 1) && !a.has(kind) && !a.has(kind + 1))
                    fill(row, b.all[kind], b.all[kind + 1]);
            }
        }
        std::swap(last, now);
        last_elevation = elevation, first = false;
    }
}

/// Where no ray leads, and beside leaps from one family of rays to another, nothing is to be seen.
void RayTable::close_gaps() {
    const auto step = static_cast<float>(column_step_);
    const auto leap = static_cast<float>(10 * steepest_ / speed_ * column_step_ + 0.005);
    std::vector<bool> leaps(cells_.size());
    const auto compare = [&](std::size_t a, std::size_t b) {
        const bool both = std::isfinite(cells_[a][3]) && std::isfinite(cells_[b][3]);
        if (both && std::abs(cells_[a][0] - cells_[b][0]) > leap) leaps[a] = leaps[b] = true;
    };
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 1; column < columns; ++column) {
            compare(row * columns + column - 1, row * columns + column);
            if (row > 0) compare((row - 1) * columns + column, row * columns + column);
        }
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 1; column < columns; ++column) {
            auto& cell = cells_[row * columns + column];
            if (!std::isfinite(cell[3]))
                cell = cells_[row * columns + column - 1], cell[3] = -std::max(std::abs(cell[3]), step);
            if (leaps[row * columns + column]) cell[3] = -step;
        }
}

/// Right above and below the sonar as between the first two columns.
void RayTable::find_moves() {
    moves_.resize(cells_.size());
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = columns; column-- > 0;) {
            const std::size_t at = row * columns + column;
            const double height = -places_.below(static_cast<double>(row)),
                         level = static_cast<double>(column) * column_step_;
            const double turn = static_cast<double>(cells_[at][0]),
                         longer = 1 + static_cast<double>(cells_[at][1]);
            const double sine = std::sin(turn), cosine = std::cos(turn);
            const double turned =
                column > 0 ? sine / level : static_cast<double>(cells_[at + 1][0]) / column_step_;
            const double outwards = longer * (cosine - height * turned);
            moves_[at] = {static_cast<float>(outwards - 1),
                          static_cast<float>(longer * (level * sine + height * cosine) - height),
                          column > 0
                              ? static_cast<float>(static_cast<double>(cells_[at][2]) / (outwards * level))
                              : moves_[at + 1].bow,
                          cells_[at][3]};
        }
}

void RayTable::find_errors(bool surface) {
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const auto& cell = cells_[row * columns + column];
            const double below = places_.below(static_cast<double>(row));
            const double length = std::hypot(static_cast<double>(column) * column_step_, below);
            if (length > range_ || (surface && depth_ + below < 0)) continue;
            const double turn = static_cast<double>(cell[0]), stretch = static_cast<double>(cell[1]);
            most_turn_ = std::max(most_turn_, std::abs(turn));
            most_stretch_ = std::max(most_stretch_, std::abs(stretch));
            has_shadow_ |= cell[3] < 0;
            const std::size_t step =
                std::min(columns - 1, static_cast<std::size_t>(std::ceil(length / column_step_)));
            error_[step] =
                std::max(error_[step], cell[3] < 0 ? unreached : length * std::hypot(turn, stretch));
            if (column > 0) find_lift(step, static_cast<double>(column) * column_step_, below, turn);
        }
    for (std::size_t i = 1; i < columns; ++i) {
        error_[i] = std::max(error_[i], error_[i - 1]);
        for (auto& lift : lifts_) lift[i] = std::max(lift[i], lift[i - 1]);
    }
}

/// A point in the direction of the horizontal unit vector h, with h' = h n, is seen at the elevation e' above
/// the plane where tan e' n + h' >= 0; so at its own elevation e its sine over the plane, cos e (tan e n +
/// h'), is at least cos e n (tan e - tan e') = -n sin(e' - e) / cos e'.
void RayTable::find_lift(std::size_t step, double distance, double below, double turn) {
    constexpr double linear_between_cells = 1.05;
    const double launch = std::atan2(-below, distance) + turn;
    const double lift = linear_between_cells * std::sin(turn) / std::max(std::cos(launch), 1e-3);
    for (const bool down : {false, true})
        lifts_[down ? 1 : 0][step] = std::max(lifts_[down ? 1 : 0][step], down ? -lift : lift);
}

RayTable::Corners RayTable::corners(double distance, double below) const {
    const double x = std::clamp(distance / column_step_, 0.0, static_cast<double>(columns - 1)),
                 y = std::clamp(places_.row(below), 0.0, static_cast<double>(rows - 1));
    const auto column = std::min(static_cast<std::size_t>(x), columns - 2),
               row = std::min(static_cast<std::size_t>(y), rows - 2);
    return {row * columns + column, static_cast<float>(x - static_cast<double>(column)),
            static_cast<float>(y - static_cast<double>(row))};
}

BentRay RayTable::at(double distance, double below) const {
    const Corners among = corners(distance, below);
    const auto* upper = &cells_[among.upper];
    const auto* lower = upper + columns;
    std::array<float, 4> all;
    for (std::size_t i = 0; i < 3; ++i) {
        const float above = upper[0][i] + among.across * (upper[1][i] - upper[0][i]),
                    under = lower[0][i] + among.across * (lower[1][i] - lower[0][i]);
        all[i] = above + among.down * (under - above);
    }
    // May be infinite.
    all[3] = std::lerp(std::lerp(upper[0][3], upper[1][3], among.across),
                       std::lerp(lower[0][3], lower[1][3], among.across), among.down);
    return {static_cast<double>(all[0]), static_cast<double>(all[1]), static_cast<double>(all[2]),
            static_cast<double>(all[3])};
}

RayTable::Move RayTable::move(double distance, double below) const {
    const Corners among = corners(distance, below);
    const Move* const upper = &moves_[among.upper];
    const Move* const lower = upper + columns;
    const auto between = [&](float Move::*m) {
        const float above = upper[0].*m + among.across * (upper[1].*m - upper[0].*m),
                    under = lower[0].*m + among.across * (lower[1].*m - lower[0].*m);
        return above + among.down * (under - above);
    };
    return {between(&Move::outwards), between(&Move::rise), between(&Move::bow), between(&Move::clearance)};
}

/// As cells are, so beyond the ends as between the last rows.
double RayTable::plumb(double below) const {
    const auto row =
        static_cast<std::size_t>(std::clamp(places_.row(below), 0.0, static_cast<double>(rows - 2)));
    const double first = places_.below(static_cast<double>(row)),
                 last = places_.below(static_cast<double>(row + 1));
    return plumb_[row] + (below - first) / (last - first) * (plumb_[row + 1] - plumb_[row]);
}

double RayTable::slowness(double below_1, double below_2) const {
    constexpr double least = 0.5;  // m
    const double middle = (below_1 + below_2) / 2, half = std::max(std::abs(below_2 - below_1), least) / 2;
    return (plumb(middle + half) - plumb(middle - half)) / (2 * half);
}

double RayTable::straight_error(double range) const {
    const auto steps = static_cast<std::size_t>(std::max(0.0, std::ceil(range / column_step_)));
    return error_[std::min(steps, columns - 1)];
}

}  // namespace echoloop
