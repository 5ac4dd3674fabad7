// Ground truth of a ping: which object most of each bin's direct echo comes from. Costs a pass over an
// object's pixels for each object in sight, so it is made for who asks only.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "render/fan/summing.h"

namespace echoloop {

class ObjectFinder {
  public:
    /// Fills in `objects` (as Echogram::objects, all 0 before). `object_of_surface`: index in
    /// Scene::objects() of every surface index. Bins with less power than `least` (uPa^2, of all echoes that
    /// arrive within the bin) are 0.
    void find(Summing& summing, BinningInput in, std::span<const std::uint32_t> object_of_surface,
              double least, std::vector<std::uint16_t>& objects);

  private:
    void list_sightings(const BinningInput& in, std::span<const std::uint32_t> object_of_surface);
    /// Takes the bins that `object` is loudest in, of those before.
    void take_loudest(std::uint32_t object, const WantedPower& power, std::vector<std::uint16_t>& objects);

    std::vector<std::pair<std::uint32_t, std::size_t>>
        sightings_;  ///< an object and a line that shows it, ascending
    std::vector<std::size_t> lines_;
    std::vector<std::uint8_t> wanted_;
    std::vector<float> strongest_;
};

}  // namespace echoloop
