#include "render/grid/turned_pixels.h"

#include <cmath>

#include "render/fan/ping_motion.h"

namespace echoloop {
namespace {

/// `seen`: in the view's own frame.
std::optional<std::size_t> pixel_of(const View& view, Vec3 seen, PixelOffset lots) {
    if (!(seen.x > 0)) return std::nullopt;
    const double x = -seen.y / seen.x, y = seen.z / seen.x;
    const double line = std::floor((x - view.left) / view.line_width() - 0.5 + lots.line),
                 sample = std::floor((view.top - y) / view.sample_height() - 0.5 + lots.sample);
    if (!(line >= 0 && line < static_cast<double>(view.lines) && sample >= 0 &&
          sample < static_cast<double>(view.samples)))
        return std::nullopt;
    return view.first_pixel + static_cast<std::size_t>(line) * view.samples +
           static_cast<std::size_t>(sample);
}

}  // namespace

TurnedPixels::TurnedPixels(const BinningInput& in, const GridPlan& plan) : in_(in), plan_(plan) {}

bool TurnedPixels::turns() const { return in_.motion != nullptr && in_.motion->turning != Vec3{}; }

std::optional<std::size_t> TurnedPixels::heard_at(const View& view, std::size_t line,
                                                  const PixelEcho& echo) const {
    const double range = in_.first_range + 0.5 * (echo.near + echo.far) * in_.bin_length;
    const Vec3 sent = rotate(view.fan_from_view(), {1, -view.x(static_cast<double>(line) + 0.5),
                                                    view.y(static_cast<double>(echo.sample) + 0.5)});
    const Vec3 seen = sent - in_.motion->flight(range) * cross(in_.motion->turning, sent);
    const PixelOffset lots =
        lots_of(static_cast<double>(view.first_pixel + line * view.samples + echo.sample));
    const auto field = in_field(seen, lots);
    return field && !plan_.heard_by(*field).empty() ? field : around_field(seen, lots);
}

/// 0..1, other ones for every pixel and, by where its pixels are sampled, ping.
PixelOffset TurnedPixels::lots_of(double number) const {
    constexpr double many = 4099;
    const PixelOffset at = in_.offset.level;
    return {std::fmod((at.line + 1) * many + 0.7548776662466927 * number, 1.0),
            std::fmod((at.sample + 1) * many + 0.5698402909980532 * number, 1.0)};
}

std::optional<std::size_t> TurnedPixels::in_field(Vec3 seen, PixelOffset lots) const {
    const double bearing = std::atan2(-seen.y, seen.x);
    for (const View& view : plan_.field_views())
        if (std::abs(bearing - view.bearing) <= std::atan(view.right))
            return pixel_of(view, rotate(conjugate(view.fan_from_view()), seen), lots);
    return std::nullopt;
}

std::optional<std::size_t> TurnedPixels::around_field(Vec3 seen, PixelOffset lots) const {
    for (const View& view : plan_.other_views()) {
        const Vec3 d = rotate(conjugate(view.fan_from_view()), seen);
        if (std::abs(d.y) > d.x || std::abs(d.z) > d.x) continue;
        if (const auto pixel = pixel_of(view, d, lots)) return pixel;
    }
    return std::nullopt;
}

}  // namespace echoloop
