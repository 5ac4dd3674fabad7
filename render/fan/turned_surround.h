// What coarse pixels in the far lobes hear of a ping whose receiver turns meanwhile. Knows no bins.
#pragma once

#include <cstddef>
#include <optional>

#include "render/fan/plan.h"

namespace echoloop {

struct BinningInput;

/// `power`: two-way, over the sine. `width`: of the sine, over which a pixel takes the mean; `spacing`: of
/// the pattern's nulls, over the sine.
SmoothLobe smooth_lobe(const LobeTable& power, int ways, double width, double spacing);

/// By how much the echo of a surround pixel changes when it comes back to a receiver that has turned.
struct Turned {
    float kept = 1;       ///< of its power
    float far = 1;        ///< of that, in a fan's far lobes
    float ahead = 0;      ///< the same in its main lobes, over `far`
    float sectors = 0;    ///< spacings of sectors, from where it was sent to where it is heard
    bool inside = false;  ///< it is heard from where the level views look, though it was sent beside
};

/// One line of a surround view. A direction d is seen at d - w x d by a receiver that has turned by w.
class TurnedSurround {
  public:
    /// Where nothing turns, at() must not be asked.
    TurnedSurround(const BinningInput& in, const View& view, std::size_t line);
    bool turns() const { return turns_; }
    /// `sector`: the place among the sectors at which the pixel was sent to; `range` in m.
    Turned at(std::size_t sample, float range, float sector) const;

  private:
    Vec3 along(double line, double sample) const;
    bool is_over_main_lobe(Vec3 sent) const;
    double left_by_level_views(Vec3 sent) const;
    double both_lobes(Vec3 sent, Vec3 seen) const;
    std::optional<float> kept_of_pixel(std::size_t sample, Vec3 turned) const;

    bool turns_ = false;
    const FanPlan* plan_ = nullptr;
    const View* view_ = nullptr;
    double line_ = 0;
    PixelOffset offset_;
    Vec3 forward_, port_, up_, level_, per_range_;  ///< of the array's frame; rad per m
    double first_sector_ = 0, last_sector_ = 0;     ///< between which level views look
    double first_slope_ = 0, last_slope_ = 0;       ///< the same, starboard over ahead
    double edge_ = 0, top_ = 0;                     ///< rad, half their height; its sine
    double width_ = 0;                              ///< of a pixel, in the image plane
    bool flat_ = false;                             ///< beams are not much higher than that
};

}  // namespace echoloop
