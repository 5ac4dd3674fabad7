#include "render/grid/main_lobes.h"

#include <cmath>
#include <limits>
#include <optional>

#include "render/fan/ping_motion.h"
#include "render/fan/pixel_echoes.h"
#include "render/grid/turned_pixels.h"

namespace echoloop {
namespace {

class MainLobes {
  public:
    MainLobes(const BinningInput& in, const GridPlan& plan, std::vector<LineBins>& beams, WaterOfBeams* water,
              std::vector<MovedEcho>* outside)
        : in_(in),
          plan_(plan),
          gain_(in),
          beams_(beams),
          water_(water),
          outside_(outside),
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
        const TurnedPixels turned(in_, plan_);
        for (const PixelEcho& echo : echoes_) {
            const std::size_t own = view.first_pixel + line * view.samples + echo.sample;
            const auto pixel = turned.turns() ? turned.heard_at(view, line, echo) : std::optional(own);
            if (!pixel) continue;
            if (plan_.is_in_field(*pixel))
                add_pixel(echo, *pixel);
            else if (outside_ != nullptr)
                outside_->push_back({echo, *pixel});
        }
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
    std::vector<MovedEcho>* outside_;
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
                    WaterOfBeams* water, std::vector<MovedEcho>* outside) {
    MainLobes lobes(in, plan, beams, water, outside);
    for (const View& view : plan.field_views())
        for (std::size_t line = 0; line < view.lines; ++line) lobes.add(amount, view, line);
}

void add_wanted(const BinningInput& in, const GridPlan& plan, std::span<const std::size_t> lines,
                std::vector<LineBins>& beams) {
    MainLobes lobes(in, plan, beams, nullptr, nullptr);
    auto line = lines.begin();
    for (const View& view : plan.field_views())
        for (; line != lines.end() && *line < view.first_line + view.lines; ++line)
            lobes.add(Amount::wanted_echo, view, *line - view.first_line);
}

}  // namespace echoloop
