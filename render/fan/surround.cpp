// All directions in front of an array that its level views leave out, seen coarsely: five faces of a cube,
// cut at the array's plane. Side lobes hear from there the first bottom return and targets outside the fan.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/fan/far_lobes.h"
#include "render/fan/plan_parts.h"

namespace echoloop {
namespace {

constexpr double pixels_per_side = 64, pixels_of_single_beam = 40;
constexpr double least_power = 3e-6;             ///< two ways; below, a direction is not heard
constexpr double widest_part = deg_to_rad(170);  ///< a ring of transducers has no plane and no surround

struct Direction {
    double bearing, elevation;  ///< rad, relative to the array's axis
};

/// `array_from_view`: the view's rotation relative to the array's axis.
Direction direction_at(const View& view, Quat array_from_view, double line, double sample) {
    const Vec3 d = rotate(array_from_view, {1, -view.x(line), view.y(sample)});
    return {std::atan2(-d.y, d.x), std::atan2(d.z, std::sqrt(d.x * d.x + d.y * d.y))};
}

/// The plane that comes nearest to values in a pixel, parts x parts of them.
class Fit {
  public:
    static constexpr int parts =
        4;  ///< cuts pixels smoothly at the limit of the level views; 6 plan a ping too late
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
    Surround(FanPlan& plan, const FanPart& part, const FanLobes& lobes, std::size_t cuts)
        : plan_(plan), part_(part), lobes_(lobes), cuts_(cuts) {}

    /// Appends what the array hears of the face: the rectangle of pixels that have weight, if any.
    bool add(const View& face, double bearing) {
        View turned = face;
        turned.bearing = bearing;
        array_from_view_ = turned.fan_from_view();
        heard_.clear();
        for (std::size_t line = 0; line < face.lines; ++line)
            for (std::size_t sample = 0; sample < face.samples; ++sample)
                heard_.push_back(heard_of(face, line, sample));
        const Rectangle heard = rectangle(face);
        if (heard.last_line <= heard.first_line) return false;
        View view = cropped(face, heard);
        view.first_pixel = plan_.weight.size();
        view.first_line = plan_.image_lines;
        for (std::size_t line = heard.first_line * cuts_; line < heard.last_line * cuts_; ++line)
            for (std::size_t sample = heard.first_sample * cuts_; sample < heard.last_sample * cuts_;
                 ++sample)
                add_pixel(face, line, sample);
        plan_.image_lines += view.lines;
        plan_.views.push_back(view);
        return true;
    }

  private:
    /// Lines and samples first..last - 1.
    struct Rectangle {
        std::size_t first_line, last_line, first_sample, last_sample;
    };

    Rectangle rectangle(const View& face) const {
        Rectangle r{face.lines, 0, face.samples, 0};
        for (std::size_t line = 0; line < face.lines; ++line)
            for (std::size_t sample = 0; sample < face.samples; ++sample)
                if (power_of(heard_[line * face.samples + sample]) > 0)
                    r = {std::min(r.first_line, line), line + 1, std::min(r.first_sample, sample),
                         std::max(r.last_sample, sample + 1)};
        return r;
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
        return view;
    }

    static float power_of(const SurroundPixel& p) { return p.beside.mean + p.off_plane.mean; }

    /// The pattern's powers and the sector across a pixel, each as the line that fits best.
    SurroundPixel heard_of(const View& view, std::size_t line, std::size_t sample) const {
        Fit beside, off_plane, sector;
        for (int i = 0; i < Fit::parts * Fit::parts; ++i) {
            const double u = Fit::place(i / Fit::parts), v = Fit::place(i % Fit::parts);
            const Direction d = direction_at(view, array_from_view_, static_cast<double>(line) + 0.5 + u,
                                             static_cast<double>(sample) + 0.5 + v);
            (is_beside(d) ? beside : off_plane).add(u, v, power_at(d));
            sector.add(u, v, sector_place(cone_angle(d.bearing, d.elevation)));
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
        const double bearing = part_.centre + d.bearing;
        return bearing >= part_.first_edge && bearing <= part_.last_edge;
    }
    bool is_beside(Direction d) const { return !is_ahead(d) && std::abs(d.elevation) <= edge(); }

    double power_at(Direction d) const {
        const double left = is_ahead(d) ? 1 - level_share(lobes_, d.elevation) : 1;
        if (left == 0) return 0;
        if (lobes_.piston) return left * lobes_.of_piston(d.bearing, d.elevation);
        const double across = lobes_.single ? lobes_.horizontal.power(cone_angle(d.bearing, d.elevation)) : 1;
        const double power = across * lobes_.vertical.power(d.elevation);
        return power < least_power ? 0 : left * power;
    }

    double edge() const { return drawn_half_height(lobes_); }

    FanPlan& plan_;
    const FanPart& part_;
    const FanLobes& lobes_;
    const std::size_t cuts_;
    Quat array_from_view_;              ///< of the face at hand
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

void add_surround(FanPlan& plan, FanPart& part, const FanLobes& lobes, double density) {
    part.first_surround = plan.views.size();
    if (part.last_edge - part.first_edge > widest_part) return;
    part.first_sector = plan.sectors;
    const double usual = part.beams == 1 ? pixels_of_single_beam : pixels_per_side;
    const auto side =
        static_cast<std::size_t>(std::max(16.0, usual * std::sqrt(std::min(density, 1.0)))) / 2 * 2;
    const std::size_t cuts = std::clamp<std::size_t>(plan.samples / side, 1, cuts_per_side(density));
    Surround surround(plan, part, lobes, cuts);
    for (View view : front_half_cube(side)) {
        const double relative = view.bearing;
        view.bearing += part.centre;
        part.surrounds += surround.add(view, relative);
    }
}

}  // namespace echoloop
