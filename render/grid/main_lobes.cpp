#include "render/grid/main_lobes.h"

#include <cmath>
#include <limits>
#include <optional>

#include "render/fan/ping_motion.h"
#include "render/fan/pixel_echoes.h"

namespace echoloop {
namespace {

class MainLobes {
  public:
    MainLobes(const BinningInput& in, const GridPlan& plan, std::vector<LineBins>& beams, WaterOfBeams* water)
        : in_(in),
          plan_(plan),
          gain_(in),
          beams_(beams),
          water_(water),
          scratch_(in.bins),
          spread_(scratch_.data(), in.bins) {}

    void add(Amount amount, const View& view, std::size_t line) {
        list_echoes(in_, gain_, amount, view, line, reader_, echoes_);
        if (in_.motion != nullptr)
            add_moved(view, line);
        else
            for (const PixelEcho& echo : echoes_)
                add_pixel(echo, view.first_pixel + line * view.samples + echo.sample);
        if (water_ != nullptr) add_water(view, line);
    }

  private:
    /// The same of a sonar that moves: what arrives from a pixel is heard as if it came from another one.
    void add_moved(const View& view, std::size_t line) {
        shift_echoes(in_, view, line, reader_, echoes_);
        const bool turns = in_.motion->turning != Vec3{};
        for (const PixelEcho& echo : echoes_)
            if (const auto pixel =
                    turns ? arrival(view, line, echo) : view.first_pixel + line * view.samples + echo.sample)
                add_pixel(echo, *pixel);
    }

    /// The pixel that shows the direction from which a pixel's echo arrives; between two of them by lot, so
    /// that the mean is right. Empty: outside the field.
    std::optional<std::size_t> arrival(const View& view, std::size_t line, const PixelEcho& echo) const {
        const double x = view.x(static_cast<double>(line) + 0.5), y = view.y(echo.sample + 0.5);
        const double range = in_.first_range + 0.5 * (echo.near + echo.far) * in_.bin_length;
        const Vec3 turn =
            in_.motion->flight(range) * rotate(conjugate(view.fan_from_view()), in_.motion->turning);
        const Vec3 seen = Vec3{1, -x, y} - cross(turn, {1, -x, y});
        return pixel_at(view, -seen.y / seen.x, seen.z / seen.x,
                        lots_of(static_cast<double>(line * view.samples + echo.sample)));
    }

    /// 0..1, other ones for every pixel and, by where its pixels are sampled, ping.
    PixelOffset lots_of(double number) const {
        constexpr double many = 4099;
        const PixelOffset at = in_.offset.level;
        return {std::fmod((at.line + 1) * many + 0.7548776662466927 * number, 1.0),
                std::fmod((at.sample + 1) * many + 0.5698402909980532 * number, 1.0)};
    }

    std::optional<std::size_t> pixel_at(const View& view, double x, double y, PixelOffset lots) const {
        const View* shows = &view;
        if (x < view.left || x >= view.right) {  // a neighbour may
            const double bearing = view.bearing + std::atan(x), rise = y / std::sqrt(1 + x * x);
            for (const View& other : plan_.field_views())
                if (std::abs(bearing - other.bearing) < std::atan(other.right)) shows = &other;
            x = std::tan(bearing - shows->bearing), y = rise * std::sqrt(1 + x * x);
        }
        const double line = std::floor((x - shows->left) / shows->line_width() - 0.5 + lots.line),
                     sample = std::floor((shows->top - y) / shows->sample_height() - 0.5 + lots.sample);
        if (!(line >= 0 && line < static_cast<double>(shows->lines) && sample >= 0 &&
              sample < static_cast<double>(shows->samples)))
            return std::nullopt;
        return shows->first_pixel + static_cast<std::size_t>(line) * shows->samples +
               static_cast<std::size_t>(sample);
    }

    void add_water(const View& view, std::size_t line) {
        constexpr float nowhere = std::numeric_limits<float>::infinity();
        const std::size_t first = view.first_pixel + line * view.samples;
        const PixelRow& row = reader_.row();
        for (std::size_t i = 0; i < view.samples; ++i) {
            const float end = row.surface()[i] != 0 ? in_.water->place(row.range()[i]) : nowhere;
            const float weight = plan_.weight[first + i] / whole_share;
            for (const Heard& heard : plan_.heard_by(first + i))
                water_->under_way[heard.beam].add(end, weight * static_cast<float>(heard.share));
        }
        const float per_bin = 1 / static_cast<float>(in_.water->steps().bins);
        for (const PixelEcho& echo : echoes_)
            for (const Heard& heard : plan_.heard_by(first + echo.sample))
                if (echo.of_water)
                    water_->surface[heard.beam].deposit(
                        echo.near * per_bin, echo.far * per_bin,
                        echo.amount * static_cast<float>(heard.share) / whole_share);
    }

    /// Most pixels lie in two or three bins: they are told apart once for all beams.
    void add_pixel(const PixelEcho& echo, std::size_t pixel) {
        spread_.deposit(echo.near, echo.far, echo.amount, echo.slope);
        if (spread_.empty()) return;
        for (const Heard& heard : plan_.heard_by(pixel))
            beams_[heard.beam].add(scratch_.data(), static_cast<float>(heard.share) / whole_share,
                                   spread_.begin(), spread_.end());
        spread_.clear();
    }

    const BinningInput& in_;
    const GridPlan& plan_;
    BinGain gain_;
    LineReader reader_;
    std::vector<LineBins>& beams_;
    WaterOfBeams* water_;
    std::vector<float> scratch_;
    LineBins spread_;
    std::vector<PixelEcho> echoes_;
};

}  // namespace

std::vector<LineBins> bins_of_beams(std::vector<float>& values, std::size_t beams, std::size_t bins,
                                    std::size_t stride) {
    stride = std::max(stride, bins);
    values.assign(beams * stride, 0.0F);
    std::vector<LineBins> rows;
    rows.reserve(beams);
    for (std::size_t beam = 0; beam < beams; ++beam) rows.emplace_back(&values[beam * stride], bins);
    return rows;
}

void add_main_lobes(const BinningInput& in, const GridPlan& plan, Amount amount, std::vector<LineBins>& beams,
                    WaterOfBeams* water) {
    MainLobes lobes(in, plan, beams, water);
    for (const View& view : plan.field_views())
        for (std::size_t line = 0; line < view.lines; ++line) lobes.add(amount, view, line);
}

void add_wanted(const BinningInput& in, const GridPlan& plan, std::span<const std::size_t> lines,
                std::vector<LineBins>& beams) {
    MainLobes lobes(in, plan, beams, nullptr);
    auto line = lines.begin();
    for (const View& view : plan.field_views())
        for (; line != lines.end() && *line < view.first_line + view.lines; ++line)
            lobes.add(Amount::wanted_echo, view, *line - view.first_line);
}

}  // namespace echoloop
