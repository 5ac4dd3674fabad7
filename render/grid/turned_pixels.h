// From which pixel of a grid an echo is heard when the sonar has turned since it sent. Knows no beams.
#pragma once

#include <cstddef>
#include <optional>

#include "render/fan/pixel_echoes.h"
#include "render/grid/plan.h"

namespace echoloop {

class TurnedPixels {
  public:
    TurnedPixels(const BinningInput& in, const GridPlan& plan);
    bool turns() const;
    /// The pixel that shows the direction from which a pixel's echo arrives; between two of them by lot, so
    /// that the mean is right. One of the field where any beam hears that, else one around it. Empty: nobody
    /// hears it. Of the field's pixels and of those around it.
    std::optional<std::size_t> heard_at(const View& view, std::size_t line, const PixelEcho& echo) const;

  private:
    PixelOffset lots_of(double number) const;
    std::optional<std::size_t> in_field(Vec3 seen, PixelOffset lots) const;
    std::optional<std::size_t> around_field(Vec3 seen, PixelOffset lots) const;

    const BinningInput& in_;
    const GridPlan& plan_;
};

}  // namespace echoloop
