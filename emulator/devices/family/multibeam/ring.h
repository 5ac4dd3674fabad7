// The ring: what a multibeam's beams hear of the nadir, or of anything loud, through their side lobes, at one
// range in all of them. Pure functions of the echogram; knows no device's settings.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "emulator/devices/family/multibeam/bottom.h"

namespace echoloop::multibeam {

/// What may come through side lobes: all that the fan hears at a time, times the mean floor of an array whose
/// staves differ (Allen 1961: the sum of both variances over the staves) and of its design, times what a lobe
/// may have more than the mean. Lobes' powers are exponentially distributed.
class SideLobes {
  public:
    explicit SideLobes(const Echogram& echogram);

    /// uPa^2, one a bin of the window: what the highest lobe of a unit brings, 5.6 to 7.2 dB above the mean.
    /// Fainter echoes are no bottom.
    std::span<const float> likely() const { return likely_; }
    /// What no lobe of any unit exceeds, of the loudest direction and of all together.
    std::span<const float> possible() const { return possible_; }

    /// How a beam is searched again.
    struct Searches {
        std::function<Detection(std::size_t)> above_possible;    ///< of what no side lobe brings
        std::function<Detection(std::size_t, TimeGate)> within;  ///< of all that it hears then
    };

    /// Of echoes between the two, those stay that lie in line with surer neighbours or between them, as heads
    /// keep to a gate about what they found beside. A beam that lost its bottom in a hole of the speckle,
    /// between sure ones, is searched in such a gate. Of the others each goes for what it has above
    /// possible(), if that lies nearer to their line or is nothing.
    void leave_out(std::span<Detection> detections, const Searches& again) const;

  private:
    /// uPa^2, the mean of possible() over an echo.
    double possible_in(const Detection& detection) const;

    const Shot& shot_;
    std::vector<float> likely_, possible_;
};

}  // namespace echoloop::multibeam
