// All directions in front of an array that its level views leave out, seen coarsely: five faces of a cube,
// cut at the array's plane. Side lobes hear from there the first bottom return and targets outside the fan.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/fan/far_lobes.h"
#include "render/fan/plan_parts.h"
#include "render/fan/turned_surround.h"

namespace echoloop {
namespace {

constexpr double pixels_per_side = 64, pixels_of_single_beam = 40;
constexpr double least_power = 3e-6;              ///< two ways; below, a direction is not heard
constexpr double widest_array = deg_to_rad(170);  ///< a ring of transducers has no plane and no surround

/// Of unit length, relative to the array's axis.
struct Direction {
    double ahead, starboard, up;
};

/// The directions that a view's pixels look in.
class Directions {
  public:
    /// `array_from_view`: the view's rotation relative to the array's axis.
    Directions(const View& view, Quat array_from_view)
        : view_(view),
          forward_(rotate(array_from_view, {1, 0, 0})),
          port_(rotate(array_from_view, {0, 1, 0})),
          up_(rotate(array_from_view, {0, 0, 1})) {}

    Direction at(double line, double sample) const {
        const Vec3 d = forward_ - view_.x(line) * port_ + view_.y(sample) * up_;
        const double shrink = 1 / norm(d);
        return {shrink * d.x, -shrink * d.y, shrink * d.z};
    }

  private:
    const View& view_;
    Vec3 forward_, port_, up_;
};

/// A lobe's power over the sine of the angle off its axis: a plan asks for it a hundred thousand times.
LobeTable over_sine(const Lobe& lobe, double width) {
    LobeTable table{std::sin(width) / 60, {}};
    for (double sine = 0; sine < 1 + 2 * table.step; sine += table.step)
        table.values.push_back(static_cast<float>(lobe.power(std::asin(std::min(sine, 1.0)))));
    return table;
}

/// The plane that comes nearest to values in a pixel, parts x parts of them.
template <int parts>
class Fit {
  public:
    static double place(int part) { return (part + 0.5) / parts - 0.5; }

    void add(double line, double sample, double value) {
        mean_ += value, line_ += line * value, sample_ += sample * value;
    }
    Linear linear() const {
        constexpr double count = parts * parts,
                         squares = count * (parts * parts - 1) / (12.0 * parts * parts);
        return {static_cast<float>(mean_ / count), static_cast<float>(line_ / squares),
                static_cast<float>(sample_ / squares)};
    }
    /// Flatter where it would else fall below nothing in a corner.
    Linear positive() const {
        Linear fit = linear();
        const float change = std::abs(fit.line) + std::abs(fit.sample), most = 2 * fit.mean;
        const float share = change > most ? most / change : 1;
        fit.line *= share, fit.sample *= share;
        return fit;
    }

  private:
    double mean_ = 0, line_ = 0, sample_ = 0;
};

/// `cuts`: per side, of each pixel of the faces, whose pattern its parts share: so that the mean over pings
/// hears the same pattern, however many they are.
class Surround {
  public:
    Surround(FanPlan& plan, const FanGeometry& geometry, const FanLobes& lobes, std::size_t cuts)
        : plan_(plan), lobes_(lobes), cuts_(cuts), vertical_(over_sine(lobes.vertical, geometry.fan_height)) {
        if (lobes.single && !lobes.piston) horizontal_ = over_sine(lobes.horizontal, geometry.beam_width);
        first_slope_ = std::tan(plan.first_edge - plan.centre),
        last_slope_ = std::tan(plan.last_edge - plan.centre);
    }

    /// What of the patterns a receiver that turns needs to know; `side`: pixels of a face.
    void smooth(const FanGeometry& geometry, std::size_t side) {
        const double width = std::sqrt(2 * std::numbers::pi / 3) / static_cast<double>(side);  // of the mean
        const auto spacing = [](AxisPattern axis, double lobe) {
            return 1 / TwoWayPattern(axis, lobe).aperture().length_in_wavelengths();
        };
        if (lobes_.single && !lobes_.piston)
            plan_.far_across = smooth_lobe(horizontal_, geometry.horizontal.ways, width,
                                           spacing(geometry.horizontal, geometry.beam_width));
        if (geometry.vertical.ways == 2)
            plan_.far_upwards =
                smooth_lobe(vertical_, 2, width, spacing(geometry.vertical, geometry.fan_height));
    }

    /// Appends what the array hears of the face: the rectangle of pixels that have weight, if any, or the two
    /// above and below what level views show alone.
    void add(const View& face, double bearing) {
        View turned = face;
        turned.bearing = bearing;
        const Directions directions(face, turned.fan_from_view());
        heard_.clear();
        for (std::size_t line = 0; line < face.lines; ++line)
            for (std::size_t sample = 0; sample < face.samples; ++sample)
                heard_.push_back(heard_of(directions, line, sample));
        const Rectangle heard = rectangle(face, {0, face.lines, 0, face.samples});
        const auto [above, below] = beside_gap(face, heard);
        for (const Rectangle& part : {above, below})
            if (part.first_line < part.last_line) add(face, part);
    }

  private:
    /// Lines and samples first..last - 1.
    struct Rectangle {
        std::size_t first_line, last_line, first_sample, last_sample;
    };

    void add(const View& face, const Rectangle& heard) {
        View view = cropped(face, heard);
        view.first_pixel = plan_.weight.size();
        view.first_line = plan_.image_lines;
        for (std::size_t line = heard.first_line * cuts_; line < heard.last_line * cuts_; ++line)
            for (std::size_t sample = heard.first_sample * cuts_; sample < heard.last_sample * cuts_;
                 ++sample)
                add_pixel(face, line, sample);
        plan_.image_lines += view.lines;
        plan_.views.push_back(view);
    }

    bool is_heard(const View& face, std::size_t line, std::size_t sample) const {
        return power_of(heard_[line * face.samples + sample]) > 0;
    }

    /// The pixels within `in` that have weight.
    Rectangle rectangle(const View& face, const Rectangle& in) const {
        Rectangle r{face.lines, 0, face.samples, 0};
        for (std::size_t line = in.first_line; line < in.last_line; ++line)
            for (std::size_t sample = in.first_sample; sample < in.last_sample; ++sample)
                if (is_heard(face, line, sample))
                    r = {std::min(r.first_line, line), line + 1, std::min(r.first_sample, sample),
                         std::max(r.last_sample, sample + 1)};
        return r;
    }

    /// `all` without its widest band of samples that no line hears; the second may be empty. A narrow band is
    /// not worth another view.
    std::array<Rectangle, 2> beside_gap(const View& face, const Rectangle& all) const {
        constexpr std::size_t narrow = 4;
        std::size_t begin = all.last_sample, end = begin, first = all.first_sample;
        for (std::size_t sample = first; sample < all.last_sample; ++sample)
            for (std::size_t line = all.first_line; line < all.last_line; ++line)
                if (is_heard(face, line, sample)) {
                    if (sample - first > std::max(end - begin, narrow)) begin = first, end = sample;
                    first = sample + 1;
                    break;
                }
        const auto part = [&](std::size_t from, std::size_t to) {
            return rectangle(face, {all.first_line, all.last_line, from, to});
        };
        return {part(all.first_sample, begin), part(end, all.last_sample)};
    }

    View cropped(const View& face, const Rectangle& r) const {
        View view = face;
        view.left = face.x(static_cast<double>(r.first_line)),
        view.right = face.x(static_cast<double>(r.last_line));
        view.top = face.y(static_cast<double>(r.first_sample));
        view.bottom = face.y(static_cast<double>(r.last_sample));
        view.lines = (r.last_line - r.first_line) * cuts_;
        view.samples = (r.last_sample - r.first_sample) * cuts_;
        view.usual_width = view.usual_height = static_cast<double>(cuts_);
        view.surround = true;
        return view;
    }

    static float power_of(const SurroundPixel& p) { return p.beside.mean + p.off_plane.mean; }

    /// The pattern's powers and the sector across a pixel, each as the line that fits best.
    SurroundPixel heard_of(const Directions& directions, std::size_t line, std::size_t sample) const {
        constexpr int parts =
            4;  // cuts pixels smoothly at the limit of the level views; 6 plan a ping too late
        using Power = Fit<parts>;
        const auto at = [&](double u, double v) {
            return directions.at(static_cast<double>(line) + 0.5 + u, static_cast<double>(sample) + 0.5 + v);
        };
        Power beside, off_plane;
        for (int i = 0; i < parts * parts; ++i) {
            const double u = Power::place(i / parts), v = Power::place(i % parts);
            const Direction d = at(u, v);
            (is_beside(d) ? beside : off_plane).add(u, v, power_at(d));
        }
        using Angle = Fit<2>;
        Angle sector;
        for (int i = 0; i < 4 && plan_.beams.size() > 1; ++i) {
            const double u = Angle::place(i / 2), v = Angle::place(i % 2);
            sector.add(u, v, sector_place(angle_of(at(u, v).starboard)));
        }
        return {beside.positive(), off_plane.positive(), sector.linear()};
    }

    /// `line`, `sample`: of the parts into which the face's pixels are cut.
    void add_pixel(const View& face, std::size_t line, std::size_t sample) {
        const std::size_t whole_line = line / cuts_, whole_sample = sample / cuts_;
        const double at = static_cast<double>(whole_line) + 0.5, count = static_cast<double>(cuts_);
        const auto place = [&](std::size_t part) {  // in the whole pixel, -0.5..0.5
            return static_cast<float>((static_cast<double>(part % cuts_) + 0.5) / count - 0.5);
        };
        const auto part_of = [&](const Linear& whole, double size) {
            const auto a = static_cast<float>(size), b = static_cast<float>(size / count);
            return Linear{a * whole.at(place(line), place(sample)), b * whole.line, b * whole.sample};
        };
        const SurroundPixel& whole = heard_[whole_line * face.samples + whole_sample];
        const double solid_angle = face.solid_angle(face.x(at) * face.x(at), whole_sample) / (count * count);
        plan_.surround.push_back({part_of(whole.beside, solid_angle), part_of(whole.off_plane, solid_angle),
                                  part_of(whole.sector, 1)});
        plan_.coverage.push_back(1);
        plan_.weight.push_back(power_of(plan_.surround.back()));
    }

    bool is_ahead(Direction d) const {
        return d.starboard >= first_slope_ * d.ahead && d.starboard <= last_slope_ * d.ahead;
    }
    bool is_beside(Direction d) const { return !is_ahead(d) && std::abs(d.up) <= sine_of_edge_; }

    double power_at(Direction d) const {
        const bool ahead = is_ahead(d), below_edge = std::abs(d.up) < sine_of_edge_;
        const double left = ahead && below_edge ? 1 - level_share(lobes_, angle_of(d.up)) : 1;
        if (left == 0) return 0;
        if (lobes_.piston) return left * power(vertical_, std::hypot(d.starboard, d.up));
        const double across = lobes_.single ? power(horizontal_, d.starboard) : 1;
        const double both = across * power(vertical_, d.up);
        return both < least_power ? 0 : left * both;
    }

    static double angle_of(double sine) { return std::asin(std::clamp(sine, -1.0, 1.0)); }
    static double power(const LobeTable& table, double sine) {
        return static_cast<double>(table.at(static_cast<float>(sine)));
    }

    FanPlan& plan_;
    const FanLobes& lobes_;
    const std::size_t cuts_;
    LobeTable horizontal_, vertical_;          ///< over sines; the first of single beams only
    double first_slope_ = 0, last_slope_ = 0;  ///< starboard over ahead, between which the level views look
    double sine_of_edge_ = std::sin(drawn_half_height(lobes_));
    std::vector<SurroundPixel> heard_;  ///< of its pixels, of which each has the solid angle 1
};

}  // namespace

std::array<View, 5> front_half_cube(std::size_t side) {
    constexpr double right_angle = std::numbers::pi / 2;
    const auto face = [side](double bearing, double elevation, double left, double right, double bottom,
                             double top) {
        View view{bearing, elevation, left, right, bottom, top, side, side, 0, 0};
        view.lines = static_cast<std::size_t>(static_cast<double>(side) * (right - left) / 2);
        view.samples = static_cast<std::size_t>(static_cast<double>(side) * (top - bottom) / 2);
        return view;
    };
    return {face(0, 0, -1, 1, -1, 1), face(-right_angle, 0, 0, 1, -1, 1), face(right_angle, 0, -1, 0, -1, 1),
            face(0, -right_angle, -1, 1, 0, 1), face(0, right_angle, -1, 1, -1, 0)};
}

void add_surround(FanPlan& plan, const FanGeometry& geometry, const FanLobes& lobes, double density) {
    if (plan.last_edge - plan.first_edge > widest_array) return;
    const double usual = plan.beams.size() == 1 ? pixels_of_single_beam : pixels_per_side;
    const auto side =
        static_cast<std::size_t>(std::max(16.0, usual * std::sqrt(std::min(density, 1.0)))) / 2 * 2;
    const std::size_t cuts = std::clamp<std::size_t>(plan.samples / side, 1, cuts_per_side(density));
    Surround surround(plan, geometry, lobes, cuts);
    surround.smooth(geometry, side);
    for (View view : front_half_cube(side)) {
        const double relative = view.bearing;
        view.bearing += plan.centre;
        surround.add(view, relative);
    }
}

}  // namespace echoloop
