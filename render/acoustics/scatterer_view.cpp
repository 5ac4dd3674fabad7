#include "render/acoustics/scatterer_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/acoustics/random.h"

namespace echoloop {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double cell_widths = 0.7;

/// Layers last so many wavelengths over the beam width (rad), half the cells the one, half the other. Fitted
/// to the correlation of the field of an aperture that moves across the beam, the transform of its squared
/// two-way pattern at 2 x / wavelength: within 0.02 of it for all apertures but a plain line that only hears,
/// there within 0.03 from a tenth of its length on.
constexpr double usual_layers[2] = {0.20, 0.26}, plain_layers[2] = {0.115, 0.301};
/// Layers for each height of the fan that its plane turns by (own choice: a quarter is left of the field).
constexpr double layers_per_height = 1;
/// Beyond this angle between its axis and the vertical, a sonar lies: 66 deg, where few are mounted.
constexpr double lies = 0.4;
/// A taller fan hears a range of level ground from one elevation, however tall it is (own choice).
constexpr double tall = 0.09;  // rad, 5 deg
/// Where the sonar lies, each cell knows one of four headings, and on the mean two thirds of a level way.
constexpr double of_headings = 1.5;

bool is_plain_ear(AxisPattern axis) { return axis.shape == ApertureShape::line && axis.ways == 1; }

bool plain_ear(const Shot& shot) { return is_plain_ear(shot.horizontal); }

/// `reach` in widths. Fitted at one and at two looks or more to the correlation of intensity, |r|^2: normal
/// numbers correlate a little more than what is made of them.
BeamKernel kernel_of(double reach, double middle, double looks) {
    return {reach / cell_widths * (1 + 0.05 / looks), middle};
}

}  // namespace

AngularGrid::AngularGrid(double beam_width)
    : count_(static_cast<std::uint32_t>(std::max(8.0, std::round(two_pi / (cell_widths * beam_width))))) {}

double AngularGrid::place_of(double bearing) const {
    const double turns = bearing / two_pi, place = (turns - std::floor(turns)) * count_;
    return place < count_ ? place : 0;
}

std::uint32_t AngularGrid::beside(std::uint32_t cell, int steps) const {
    const std::int64_t count = count_, sum = std::int64_t{cell} + steps;
    return static_cast<std::uint32_t>((sum % count + count) % count);
}

double AngularGrid::cell_width() const { return two_pi / count_; }

double BeamKernel::weight(double distance) const {
    const double s = distance * distance / (reach * reach);
    return s < 1 ? (1 - s) * (1 - s) * (1 + middle * s) : 0;
}

BeamKernel echo_kernel(const Shot& shot, double looks) {
    if (plain_ear(shot)) return kernel_of(1.02, -2, looks);
    if (shot.horizontal.shape == ApertureShape::piston && shot.horizontal.ways == 1)
        return kernel_of(1.05, -2, looks);
    return kernel_of(1.155, -1, looks);
}

BeamKernel noise_kernel(const Shot& shot, double looks) {
    if (shot.horizontal.ways == 1) return echo_kernel(shot, looks);
    if (shot.horizontal.shape == ApertureShape::hamming) return kernel_of(1.7, -1, looks);
    return kernel_of(1.2, -1, looks);
}

ScattererView::ScattererView(const Shot& shot, const Pose& world_from_sonar, double wavelength)
    : tilt_(shot.tilt),
      position_(world_from_sonar.position),
      up_(rotate(world_from_sonar.orientation, {0, 0, 1})),
      angle_pace_(layers_per_height / shot.fan_height) {
    // Who looks down moves along its track, across the height of its fan.
    const bool by_height = shot.fan_height < tall;
    const double height = by_height ? shot.fan_height : shot.beam_width;
    const bool plain_height = is_plain_ear(by_height ? shot.vertical : shot.horizontal);
    for (int kind : {0, 1}) {
        pace_[kind] = shot.beam_width / wavelength / (plain_ear(shot) ? plain_layers : usual_layers)[kind];
        level_pace_[kind] =
            of_headings * height / wavelength / (plain_height ? plain_layers : usual_layers)[kind];
    }
    Quat q = world_from_sonar.orientation;
    if (std::abs(up_.z) < lies) {
        // The reference is straight down.
        mounting_ = Mounting::lying;
        const Vec3 x = rotate(q, {1, 0, 0}), y = rotate(q, {0, 1, 0});
        turn_ = -std::atan2(y.z, -x.z);
        return;
    }
    if (up_.z < 0) {
        // The turn about the sonar's z axis is undefined where that points straight down, so heads that hang
        // upside down count theirs from a half roll.
        mounting_ = Mounting::hanging;
        q = q * Quat{0, 1, 0, 0};
    }
    const double twist = 2 * std::atan2(q.z, q.w);
    turn_ = mounting_ == Mounting::hanging ? twist : -twist;
}

CellView ScattererView::of(std::uint32_t cell, double direction) const {
    const std::uint64_t hash = mix(0, cell);
    const auto sign = [&](int bit) { return (hash >> bit) % 2 == 0 ? 1.0 : -1.0; };
    const double pace = pace_[cell % 2], c = std::cos(direction), s = std::sin(direction);
    const Vec3& p = position_;
    CellView view;
    // Each cell changes its layers at places of its own. Signs that differ from cell to cell, so that no
    // motion along several axes at once leaves most of them as they are.
    double place = static_cast<double>(hash >> 11) * 0x1p-53;
    if (mounting_ == Mounting::lying) {
        constexpr double eighth = std::numbers::pi / 4;
        const double heading = 0.35 + eighth * static_cast<double>(hash >> 1 & 3);
        view.shift = -p.z * c;
        place += level_pace_[cell % 2] * (p.x * std::cos(heading) + p.y * std::sin(heading));
        place += pace * sign(3) * p.z * s;
        place += angle_pace_ * (sign(4) * up_.x + sign(5) * up_.y + sign(6) * (up_.z + tilt_));
    } else {
        const double side = mounting_ == Mounting::hanging ? 1 : -1;
        const double x = c, y = side * s;  // where the cell lies, on the map
        view.shift = p.x * x + p.y * y;
        place += pace * (p.x * y - p.y * x + sign(1) * p.z);
        place += angle_pace_ * sign(2) * (tilt_ - up_.x * x - up_.y * y);
    }
    const double layer = std::floor(place), share = place - layer, norm = std::hypot(1 - share, share);
    view.layer = static_cast<std::uint64_t>(static_cast<std::int64_t>(layer));
    view.weight = static_cast<float>((1 - share) / norm);
    view.next_weight = static_cast<float>(share / norm);
    return view;
}

}  // namespace echoloop
