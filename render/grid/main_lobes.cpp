#include "render/grid/main_lobes.h"

#include "render/fan/pixel_echoes.h"

namespace echoloop {
namespace {

class MainLobes {
  public:
    MainLobes(const BinningInput& in, const GridPlan& plan, std::vector<LineBins>& beams)
        : in_(in),
          plan_(plan),
          gain_(in),
          beams_(beams),
          scratch_(in.bins),
          spread_(scratch_.data(), in.bins) {}

    void add(Amount amount, const View& view, std::size_t line) {
        list_echoes(in_, gain_, amount, view, line, reader_, echoes_);
        for (const PixelEcho& echo : echoes_)
            add_pixel(echo, view.first_pixel + line * view.samples + echo.sample);
    }

  private:
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
    std::vector<float> scratch_;
    LineBins spread_;
    std::vector<PixelEcho> echoes_;
};

}  // namespace

std::vector<LineBins> bins_of_beams(std::vector<float>& values, std::size_t beams, std::size_t bins) {
    values.assign(beams * bins, 0.0F);
    std::vector<LineBins> rows;
    rows.reserve(beams);
    for (std::size_t beam = 0; beam < beams; ++beam) rows.emplace_back(&values[beam * bins], bins);
    return rows;
}

void add_main_lobes(const BinningInput& in, const GridPlan& plan, Amount amount,
                    std::vector<LineBins>& beams) {
    MainLobes lobes(in, plan, beams);
    for (const View& view : plan.field_views())
        for (std::size_t line = 0; line < view.lines; ++line) lobes.add(amount, view, line);
}

void add_wanted(const BinningInput& in, const GridPlan& plan, std::span<const std::size_t> lines,
                std::vector<LineBins>& beams) {
    MainLobes lobes(in, plan, beams);
    auto line = lines.begin();
    for (const View& view : plan.field_views())
        for (; line != lines.end() && *line < view.first_line + view.lines; ++line)
            lobes.add(Amount::wanted_echo, view, *line - view.first_line);
}

}  // namespace echoloop
