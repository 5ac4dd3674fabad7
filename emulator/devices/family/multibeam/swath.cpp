#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "emulator/devices/family/multibeam/bottom.h"

namespace echoloop::multibeam {
namespace {

/// Of a beam, by the sine and the cosine of its angle.
struct Direction {
    double sine = 0, cosine = 1;
};

Direction direction_of(double angle) { return {std::sin(angle), std::cos(angle)}; }

/// Made once: neighbours are looked at again and again.
std::vector<Direction> directions_of(std::span<const double> angles) {
    std::vector<Direction> directions;
    directions.reserve(angles.size());
    for (const double angle : angles) directions.push_back(direction_of(angle));
    return directions;
}

/// A point of the swath in seconds across and down.
struct Point {
    double across = 0, down = 0;
};

Point point_of(const Detection& detection, Direction beam) {
    return {detection.time * beam.sine, detection.time * beam.cosine};
}

struct Line {
    double down = 0, slope = 0;  ///< s below the head, s per s across
};

/// Least squares through six detections by phase, from beam `first` on, where place() finds them; nothing if
/// one of them is another.
template <class Place>
std::optional<Line> line_through(std::span<const Detection> detections, std::span<const double> angles,
                                 std::size_t first, const Place& place) {
    constexpr std::size_t points = 6;
    if (first + points > std::min(detections.size(), angles.size())) return std::nullopt;
    Point mean;
    double across = 0, both = 0;
    for (const bool about_mean : {false, true})
        for (std::size_t beam = first; beam < first + points; ++beam) {
            const Detection& detection = detections[place(beam)];
            if (detection.method != Method::phase) return std::nullopt;
            const Point point = point_of(detection, direction_of(angles[place(beam)]));
            if (about_mean) {
                across += (point.across - mean.across) * (point.across - mean.across);
                both += (point.across - mean.across) * (point.down - mean.down);
            } else {
                mean.across += point.across / points;
                mean.down += point.down / points;
            }
        }
    if (!(across > 0)) return std::nullopt;
    const double slope = both / across;
    return Line{mean.down - slope * mean.across, slope};
}

/// Least squares through the `side` beams on either side of beam `own`, and through that one `with_own`.
std::optional<Line> line_around(std::span<const Point> points, std::size_t own, std::size_t side,
                                bool with_own) {
    double n = 0, x = 0, z = 0, xx = 0, xz = 0;
    const Point origin = points[own];
    for (std::size_t beam = own - side; beam <= own + side; ++beam) {
        if (beam == own && !with_own) continue;
        const double across = points[beam].across - origin.across, down = points[beam].down - origin.down;
        n += 1, x += across, z += down, xx += across * across, xz += across * down;
    }
    const double spread = n * xx - x * x;
    if (!(spread > 0)) return std::nullopt;
    const double slope = (n * xz - x * z) / spread;
    return Line{origin.down + (z - slope * x) / n - slope * origin.across, slope};
}

/// Two-way time at which a beam meets the line.
double time_on(const Line& line, Direction beam) {
    return line.down / (beam.cosine - line.slope * beam.sine);
}

/// How far a point is off the line, as a part of its time.
double off_line(const Line& line, Point point, Direction beam) {
    return std::abs(std::hypot(point.across, point.down) / time_on(line, beam) - 1);
}

std::vector<Point> points_of(std::span<const Detection> detections, std::span<const Direction> beams) {
    std::vector<Point> points(std::min(detections.size(), beams.size()));
    for (std::size_t n = 0; n < points.size(); ++n) points[n] = point_of(detections[n], beams[n]);
    return points;
}

/// Two-way time at which a beam meets the line through two points; 0 if it does not.
double time_on_line(Point a, Point b, Direction beam) {
    const double x = b.across - a.across, z = b.down - a.down;
    const double facing = beam.sine * z - beam.cosine * x;
    return facing == 0 ? 0 : (a.across * z - a.down * x) / facing;
}

}  // namespace

void continue_to_edges(std::span<Detection> detections, std::span<const double> angles, double beam_width) {
    const std::size_t count = std::min(detections.size(), angles.size());
    for (const bool last : {false, true}) {
        const auto place = [&](std::size_t beam) { return last ? count - 1 - beam : beam; };
        std::size_t edges = 1;  // without neighbours for half a beam width outwards
        while (edges < count && std::abs(angles[place(edges)] - angles[place(0)]) < beam_width / 2) ++edges;
        const auto line = line_through(detections, angles, edges, place);
        for (std::size_t beam = 0; line && beam < edges; ++beam) {
            Detection& own = detections[place(beam)];
            const double time = time_on(*line, direction_of(angles[place(beam)]));
            if (own.method == Method::phase && own.begin <= time && time <= own.end) own.time = time;
        }
    }
}

void move_to_neighbours(std::span<Detection> detections, std::span<const double> angles, double beam_width) {
    constexpr std::size_t side = 3;
    constexpr double scattered = 2.5;      // times the neighbours' own distance from their line
    constexpr double least_off = 0.003;    // of the time: nearer is near enough
    constexpr double most_uneven = 0.003;  // of the time: neighbours farther off their line make none
    const std::size_t count = std::min(detections.size(), angles.size());
    if (count < 2 || 2 * (angles[1] - angles[0]) < beam_width) return;  // neighbours that share their speckle
    const auto directions = directions_of(angles);
    const auto points = points_of(detections, directions);
    for (std::size_t n = side; n + side < count; ++n) {
        Detection& own = detections[n];
        bool all = true;
        for (std::size_t beam = n - side; beam <= n + side; ++beam) all &= detections[beam].found();
        const auto line = all ? line_around(points, n, side, false) : std::nullopt;
        if (!line) continue;
        double squares = 0;
        for (std::size_t beam = n - side; beam <= n + side; ++beam) {
            const double off = off_line(*line, points[beam], directions[beam]);
            if (beam != n) squares += off * off / (2 * side);
        }
        const double time = time_on(*line, directions[n]), uneven = std::sqrt(squares),
                     off = std::abs(own.time / time - 1);
        if (uneven < most_uneven && off > std::max(least_off, scattered * uneven) && own.begin <= time &&
            time <= own.end)
            own.time = time;
    }
}

void smooth_by_phase(std::span<Detection> detections, std::span<const double> angles, std::size_t beams) {
    constexpr double most_uneven =
        0.003;  // of the time: what is farther off its neighbours' line is really so
    if (beams < 3) return;
    const auto directions = directions_of(angles);
    const auto points = points_of(detections, directions);
    const auto by_phase = [&](std::size_t beam) {
        return beam < points.size() && detections[beam].method == Method::phase;
    };
    // Own fit: at 45 deg, where a sounding in 25 is still by amplitude, those of a real Sonic 2026 scatter as
    // phase alone does; at 55 deg, as five averaged ones.
    const std::size_t settled = 2 * beams;
    std::vector<std::size_t> others(points.size() + 1);  // how many beams before are not by phase
    for (std::size_t n = 0; n < points.size(); ++n) others[n + 1] = others[n] + !by_phase(n);
    for (std::size_t n = 0; n < points.size(); ++n) {
        const std::size_t from = n - std::min(n, settled), to = std::min(n + settled + 1, points.size());
        if (others[to] != others[from]) continue;
        std::size_t side = 0;
        while (side < beams / 2 && side < n && by_phase(n - side - 1) && by_phase(n + side + 1)) ++side;
        const auto line = side > 0 ? line_around(points, n, side, true) : std::nullopt;
        if (!line) continue;
        bool even = true;
        for (std::size_t beam = n - side; beam <= n + side; ++beam)
            even &= off_line(*line, points[beam], directions[beam]) < most_uneven;
        Detection& own = detections[n];
        const double time = time_on(*line, directions[n]);
        if (even && own.begin <= time && time <= own.end) own.time = time;
    }
}

void mark_in_line(std::span<Detection> detections, std::span<const double> angles) {
    constexpr double tolerance = 0.02;  // of the time, own choice
    const auto directions = directions_of(angles);
    const auto points = points_of(detections, directions);
    const auto count = static_cast<std::ptrdiff_t>(points.size());
    // Neighbours on either side, or two on one side: beyond a step the bottom goes on in a line, too.
    constexpr std::array<std::array<std::ptrdiff_t, 2>, 4> pairs{{{-1, 1}, {-2, 2}, {-2, -1}, {1, 2}}};
    for (std::ptrdiff_t n = 0; n < count; ++n) {
        Detection& own = detections[static_cast<std::size_t>(n)];
        const auto fits = [&](const std::array<std::ptrdiff_t, 2>& pair) {
            const std::ptrdiff_t a = n + pair[0], b = n + pair[1];
            if (a < 0 || b >= count) return false;
            const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
            if (!detections[i].found() || !detections[j].found()) return false;
            const double expected =
                time_on_line(points[i], points[j], directions[static_cast<std::size_t>(n)]);
            return std::abs(expected - own.time) < tolerance * own.time;
        };
        own.in_line = own.found() && std::any_of(pairs.begin(), pairs.end(), fits);
    }
}

double median_depth(std::span<const Detection> detections, std::span<const double> angles,
                    double sound_speed) {
    constexpr double near = deg_to_rad(30);
    double middle = 0;
    if (!angles.empty() && (angles.front() >= near || angles.back() <= -near))
        middle = (angles.front() + angles.back()) / 2;
    std::vector<double> depths;
    for (std::size_t n = 0; n < detections.size(); ++n)
        if (detections[n].found() && std::abs(angles[n] - middle) < near)
            depths.push_back(detections[n].time * sound_speed / 2 * std::cos(angles[n]));
    if (depths.empty()) return 0;
    const auto median = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), median, depths.end());
    return *median;
}

double median_slope(std::span<const Detection> detections, std::span<const double> angles) {
    constexpr std::size_t least = 8;
    std::vector<Point> points;
    for (std::size_t n = 0; n < detections.size(); ++n)
        if (detections[n].found() && std::abs(angles[n]) < deg_to_rad(60))
            points.push_back(point_of(detections[n], direction_of(angles[n])));
    if (points.size() < least) return 0;
    std::vector<double> slopes;
    const std::size_t half = points.size() / 2;
    for (std::size_t n = 0; n + half < points.size(); ++n) {
        const double across = points[n + half].across - points[n].across;
        if (across > 0) slopes.push_back((points[n].down - points[n + half].down) / across);
    }
    if (slopes.empty()) return 0;
    const auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
    std::nth_element(slopes.begin(), middle, slopes.end());
    return std::atan(*middle);
}

}  // namespace echoloop::multibeam
