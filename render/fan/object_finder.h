// Ground truth of a ping: which object most of each bin's direct echo comes from. Costs a pass over an
// object's pixels for each object in sight, so it is made for who asks only.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "render/fan/beam_sums.h"
#include "render/fan/line_sums.h"

namespace echoloop {

class ObjectFinder {
  public:
    explicit ObjectFinder(Workers& workers) : workers_(workers) {}

    /// Fills `objects` (beams x bins, as Echogram::objects). `object_of_surface`: index in Scene::objects()
    /// of every surface index. Bins with less power than `least` (uPa^2, of all echoes that arrive within the
    /// bin) are 0.
    void find(const BinningInput& input, std::span<const std::uint32_t> object_of_surface, double least,
              std::vector<std::uint16_t>& objects);

  private:
    /// An object, and an image line that shows it.
    using Sighting = std::pair<std::uint32_t, std::size_t>;

    void list_sightings(const BinningInput& in, std::span<const std::uint32_t> object_of_surface);
    /// Fills power_ with what one object sends back.
    void sum_object(BinningInput in, const BinGain& gain, std::span<const Sighting> lines,
                    std::span<const std::uint32_t> object_of_surface);

    Workers& workers_;
    LineSums sums_;
    BeamSums beams_;
    std::vector<Sighting> sightings_;  ///< by object, then by line
    std::vector<std::uint8_t> wanted_;
    std::vector<float> power_, strongest_;
};

}  // namespace echoloop
