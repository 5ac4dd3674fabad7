#include "emulator/dataset/picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace echoloop {
namespace {

constexpr std::size_t most_to_the_end = 400;  ///< px of a Cartesian picture, over the range

/// Columns by bearing, all round.
class ByBearing {
  public:
    explicit ByBearing(std::span<const double> bearings) {
        for (std::size_t i = 0; i < bearings.size(); ++i) sorted_.emplace_back(turned(bearings[i]), i);
        std::ranges::stable_sort(sorted_, {}, &std::pair<double, std::size_t>::first);
    }
    /// The nearest column and how far off it is, rad.
    std::pair<std::size_t, double> nearest(double bearing) const {
        bearing = turned(bearing);
        const auto after =
            std::ranges::lower_bound(sorted_, bearing, {}, &std::pair<double, std::size_t>::first);
        const auto& upper = after == sorted_.end() ? sorted_.front() : *after;
        const auto& lower = after == sorted_.begin() ? sorted_.back() : *std::prev(after);
        const double to_upper = apart(upper.first, bearing), to_lower = apart(lower.first, bearing);
        return to_upper < to_lower ? std::pair(upper.second, to_upper) : std::pair(lower.second, to_lower);
    }
    /// rad, the usual distance between neighbours.
    double spacing() const {
        std::vector<double> gaps;
        for (std::size_t i = 1; i < sorted_.size(); ++i)
            gaps.push_back(sorted_[i].first - sorted_[i - 1].first);
        if (gaps.empty()) return 0;
        const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
        std::ranges::nth_element(gaps, middle);
        return *middle;
    }

  private:
    static constexpr double turn = 2 * std::numbers::pi;
    static double turned(double bearing) { return bearing - turn * std::floor(bearing / turn); }
    static double apart(double a, double b) {
        const double difference = std::abs(a - b);
        return std::min(difference, turn - difference);
    }
    std::vector<std::pair<double, std::size_t>> sorted_;
};

/// m, of a sector that begins and ends with a bearing.
struct Box {
    double left = 0, right = 0, top = 0, bottom = 0;
    void grow(double x, double y) {
        left = std::min(left, x), right = std::max(right, x);
        bottom = std::min(bottom, y), top = std::max(top, y);
    }
};

Box sector(double begin, double end, double range) {
    Box box;
    constexpr int steps = 64;
    for (int i = 0; i <= steps; ++i) {
        const double bearing = begin + (end - begin) * i / steps;
        box.grow(range * std::sin(bearing), range * std::cos(bearing));
    }
    return box;
}

}  // namespace

std::uint16_t PictureScale::count(double level) const {
    if (!(level > -std::numeric_limits<double>::infinity())) return 0;
    return static_cast<std::uint16_t>(std::clamp(std::round((level - at_0) / per_count), 1.0, 65535.0));
}

PictureScale scale_of(EchoRule rule) {
    return rule == EchoRule::radiometric ? PictureScale{-60, 0.005} : PictureScale{0, 1.0 / 65535};
}

CountPicture polar_picture(const Scan& scan, std::size_t bins) {
    CountPicture picture{scan.bearings.size(), bins, {}, {}};
    picture.counts.resize(scan.counts.size());
    picture.labels.resize(scan.labels.size());
    for (std::size_t x = 0; x < picture.width; ++x)
        for (std::size_t bin = 0; bin < bins; ++bin) {
            picture.counts[bin * picture.width + x] = scan.counts[x * bins + bin];
            picture.labels[bin * picture.width + x] = scan.labels[x * bins + bin];
        }
    return picture;
}

CartesianMap cartesian_map(std::span<const double> bearings, double width, const RangeAxis& axis,
                           bool all_round) {
    const ByBearing columns(bearings);
    const double reach = std::max(width, columns.spacing()) / 2;
    const double end = axis.first + axis.step * static_cast<double>(axis.bins);
    const auto bins_of_a_pixel = std::ceil(end / axis.step / static_cast<double>(most_to_the_end) - 1e-9);
    CartesianMap map;
    const double pixel = map.metres_per_pixel = std::max(1.0, bins_of_a_pixel) * axis.step;
    const Box box = all_round ? sector(0, 2 * std::numbers::pi, end)
                              : sector(bearings.front() - reach, bearings.back() + reach, end);
    map.origin_x = std::ceil(-box.left / pixel), map.origin_y = std::ceil(box.top / pixel);
    map.width = static_cast<std::size_t>(map.origin_x + std::ceil(box.right / pixel));
    map.height = static_cast<std::size_t>(map.origin_y + std::ceil(-box.bottom / pixel));
    map.height = std::max<std::size_t>(map.height, 1), map.width = std::max<std::size_t>(map.width, 1);
    const auto bins = static_cast<double>(axis.bins);
    for (std::size_t y = 0; y < map.height; ++y)
        for (std::size_t x = 0; x < map.width; ++x) {
            const double right = (static_cast<double>(x) + 0.5 - map.origin_x) * pixel,
                         ahead = (map.origin_y - static_cast<double>(y) - 0.5) * pixel;
            const double range = std::hypot(right, ahead);
            const auto [column, off] = columns.nearest(std::atan2(right, ahead));
            const double from = std::floor((range - pixel / 2 - axis.first) / axis.step + 0.5),
                         to = std::max(from + 1,
                                       std::floor((range + pixel / 2 - axis.first) / axis.step + 0.5));
            CartesianMap::Spot spot;
            if (off <= reach && to > 0 && from < bins) {
                const double first = std::max(from, 0.0);
                spot.first = static_cast<std::uint32_t>(static_cast<double>(column) * bins + first);
                spot.count = static_cast<std::uint32_t>(std::min(to, bins) - first);
            }
            map.spots.push_back(spot);
        }
    return map;
}

CountPicture cartesian_picture(const CartesianMap& map, const Scan& scan) {
    CountPicture picture{map.width, map.height, {}, {}};
    for (const CartesianMap::Spot& spot : map.spots) {
        std::size_t loudest = spot.first;
        for (std::size_t i = spot.first; i < spot.first + spot.count; ++i)
            if (scan.counts[i] > scan.counts[loudest]) loudest = i;
        picture.counts.push_back(spot.count > 0 ? scan.counts[loudest] : std::uint16_t{0});
        picture.labels.push_back(spot.count > 0 ? scan.labels[loudest] : std::uint16_t{0});
    }
    return picture;
}

FrontPictures front_pictures(std::span<const std::uint16_t> counts, std::span<const std::uint16_t> labels,
                             const Shot& shot, const RangeAxis& axis) {
    FrontPictures out;
    out.levels.width = shot.bearings.size(), out.levels.height = shot.rows();
    constexpr double fine = 0.001, coarse = 0.01, most = 65.535;
    out.metres_per_count = axis.first + axis.step * static_cast<double>(axis.bins) < most ? fine : coarse;
    for (std::size_t row = shot.rows(); row-- > 0;)
        for (std::size_t column = 0; column < out.levels.width; ++column) {
            const std::size_t begin = (row * out.levels.width + column) * axis.bins;
            const auto beam = counts.subspan(begin, axis.bins);
            const auto bin = static_cast<std::size_t>(std::ranges::max_element(beam) - beam.begin());
            const double range = axis.first + (static_cast<double>(bin) + 0.5) * axis.step;
            out.levels.counts.push_back(beam[bin]);
            out.levels.labels.push_back(labels[begin + bin]);
            out.ranges.push_back(beam[bin] == 0 ? std::uint16_t{0}
                                                : static_cast<std::uint16_t>(std::min(
                                                      std::round(range / out.metres_per_count), 65535.0)));
        }
    return out;
}

}  // namespace echoloop
