// What a grid's beams hear beside their main lobes: sectors, nodes, and views of all that is around the
// field.
#include <array>
#include <cmath>
#include <numbers>

#include "render/fan/far_lobes.h"
#include "render/fan/plan_parts.h"
#include "render/grid/field.h"

namespace echoloop {
namespace {

constexpr std::size_t columns_per_node = 8;
constexpr double pixels_per_side = 64;  ///< of a face of the cube around the field
constexpr double sector_spacing = std::numbers::pi / (sectors_per_array - 1);

Between between(double at, std::size_t count) {
    const double lower = std::clamp(std::floor(at), 0.0, static_cast<double>(count - 2));
    return {static_cast<std::uint16_t>(lower), static_cast<float>(std::clamp(at - lower, 0.0, 1.0))};
}

Between sector_of(double angle) {
    return between((angle / std::numbers::pi + 0.5) * (sectors_per_array - 1), sectors_per_array);
}

/// What a beam on `axis` hears of a sector's echo through its side lobes: the mean over the sector's tent.
float mean_far(const Lobe& lobe, double axis, std::size_t sector) {
    constexpr int steps = 65;
    double sum = 0, weights = 0;
    for (int i = 0; i < steps; ++i) {
        const double place = 2 * (i + 0.5) / steps - 1,
                     off = sector_middle(sector) + place * sector_spacing - axis;
        const double weight = 1 - std::abs(place);
        weights += weight;
        if (std::abs(off) > lobe.edge()) sum += weight * lobe.power(off);
    }
    return static_cast<float>(sum / weights);
}

/// Half the distance between the neighbours of `i`.
double spacing(std::span<const double> places, std::size_t i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, places.size() - 1);
    return (places[after] - places[before]) / static_cast<double>(after - before);
}

class FarPlan {
  public:
    FarPlan(GridPlan& plan, const FieldLimits& limits)
        : plan_(plan), far_(plan.far), g_(plan.geometry), lobes_(plan.lobes), limits_(limits) {
        const auto [least, most] = std::ranges::minmax(plan.axes);
        far_.nodes = std::max<std::size_t>(2, plan.columns / columns_per_node + 1);
        first_node_ = least, node_step_ = (most - least) / static_cast<double>(far_.nodes - 1);
    }

    void weigh_sectors() {
        for (std::size_t node = 0; node < far_.nodes; ++node)
            for (std::size_t s = 0; s < sectors_per_array; ++s)
                far_.beside.push_back(
                    mean_far(lobes_.horizontal, first_node_ + static_cast<double>(node) * node_step_, s));
        for (const double elevation : g_.elevations)
            for (std::size_t s = 0; s < sectors_per_array; ++s)
                far_.above.push_back(mean_far(lobes_.vertical, elevation, s));
    }

    void place_beams() {
        for (const double elevation : g_.elevations) far_.row_sector.push_back(sector_of(elevation));
        for (std::size_t beam = 0; beam < plan_.axes.size(); ++beam) {
            const std::size_t row = beam / plan_.columns, column = beam % plan_.columns;
            const double width =
                spacing(std::span(plan_.axes).subspan(row * plan_.columns, plan_.columns), column);
            const double height = spacing(g_.elevations, row);
            far_.node.push_back(node_of(plan_.axes[beam]));
            far_.across.push_back(sector_of(plan_.axes[beam]));
            far_.row_share.push_back(static_cast<float>(width / lobes_.across.integral()));
            far_.column_share.push_back(
                static_cast<float>(width / node_step_ * height / lobes_.upwards.integral()));
        }
    }

    void add_view(View view) {
        const std::size_t before = far_.shares.size(), first = far_.first.size();
        view.first_line = plan_.image_lines, view.first_pixel = plan_.weight.size();
        view.surround = true;
        for (std::size_t line = 0; line < view.lines; ++line)
            for (std::size_t sample = 0; sample < view.samples; ++sample) add_pixel(view, line, sample);
        if (far_.shares.size() == before) {  // nobody hears any of it
            far_.first.resize(first);
            plan_.weight.resize(view.first_pixel), plan_.coverage.resize(view.first_pixel);
            return;
        }
        plan_.image_lines += view.lines;
        plan_.samples = std::max(plan_.samples, view.samples);
        plan_.views.push_back(view);
    }

  private:
    struct Direction {
        double bearing, elevation;
    };

    static Direction direction(const View& view, double line, double sample) {
        const Vec3 d = rotate(view.fan_from_view(), {1, -view.x(line), view.y(sample)});
        return {std::atan2(-d.y, d.x), std::atan2(d.z, std::hypot(d.x, d.y))};
    }

    Between node_of(double across) const { return between((across - first_node_) / node_step_, far_.nodes); }

    /// Of a pixel, what the field's views leave out.
    double share_outside(const View& view, std::size_t line, std::size_t sample) const {
        constexpr int parts = 3;  // per side
        int outside = 0;
        for (int i = 0; i < parts * parts; ++i) {
            const Direction d = direction(view, static_cast<double>(line) + (i / parts + 0.5) / parts,
                                          static_cast<double>(sample) + (i % parts + 0.5) / parts);
            outside += limits_.contains(d.bearing, d.elevation) ? 0 : 1;
        }
        return static_cast<double>(outside) / (parts * parts);
    }

    void add_pixel(const View& view, std::size_t line, std::size_t sample) {
        far_.first.push_back(static_cast<std::uint32_t>(far_.shares.size()));
        const double at = static_cast<double>(line) + 0.5, outside = share_outside(view, line, sample);
        const double solid_angle = outside * view.solid_angle(view.x(at) * view.x(at), sample);
        const Direction d = direction(view, at, static_cast<double>(sample) + 0.5);
        const double across = cone_angle(d.bearing, d.elevation), half = std::sqrt(solid_angle) / 2;
        const std::size_t before = far_.shares.size();
        if (half > 0) add_to_rows(d.elevation, half, sector_of(across));
        if (half > 0) add_to_column(across, sector_of(d.elevation));
        const bool heard = far_.shares.size() > before;
        plan_.coverage.push_back(1);
        plan_.weight.push_back(heard ? static_cast<float>(solid_angle) : 0.0F);
    }

    void add(std::size_t sum, double share) {
        if (share > 0) far_.shares.push_back({static_cast<std::uint32_t>(sum), static_cast<float>(share)});
    }

    void add_to_rows(double elevation, double half, Between sector) {
        for (std::size_t row = 0; row < plan_.rows; ++row) {
            const double off = elevation - g_.elevations[row];
            const double share = lobes_.upwards.mean(off - half, off + half);
            add(far_.sum_beside(row, sector.lower), share * (1 - sector.next));
            add(far_.sum_beside(row, sector.lower + 1U), share * sector.next);
        }
    }

    void add_to_column(double across, Between sector) {
        const double at = (across - first_node_) / node_step_;
        for (std::size_t node = 0; node < far_.nodes; ++node) {
            const double tent = std::max(0.0, 1 - std::abs(at - static_cast<double>(node)));
            const double share = tent * lobes_.across.integral() / node_step_;
            add(far_.sum_above(node, sector.lower, plan_.rows), share * (1 - sector.next));
            add(far_.sum_above(node, sector.lower + 1U, plan_.rows), share * sector.next);
        }
    }

    GridPlan& plan_;
    GridFar& far_;
    const FanGeometry& g_;
    const GridLobes& lobes_;
    const FieldLimits& limits_;
    double first_node_ = 0, node_step_ = 0;  ///< rad
};

}  // namespace

std::size_t GridFar::sum_beside(std::size_t row, std::size_t sector) const {
    return row * sectors_per_array + sector;
}

std::size_t GridFar::sum_above(std::size_t number_of_node, std::size_t sector, std::size_t rows) const {
    return (rows + number_of_node) * sectors_per_array + sector;
}

void add_grid_far(GridPlan& plan, const FieldLimits& limits, double density) {
    FarPlan far(plan, limits);
    far.weigh_sectors();
    far.place_beams();
    const auto side = static_cast<std::size_t>(std::max(16.0, pixels_per_side * std::sqrt(density))) / 2 * 2;
    for (const View& face : front_half_cube(side)) far.add_view(face);
    plan.far.first.push_back(static_cast<std::uint32_t>(plan.far.shares.size()));
}

}  // namespace echoloop
