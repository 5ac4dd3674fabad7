// The beams of one or many pings in order of bearing, to be looked up by range and bearing; draws nothing.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/echogram.h"

namespace echoloop::draw {

/// One beam: where it points and its values over slant range.
struct Ray {
    double bearing = 0;    ///< rad, starboard positive
    double width = 0;      ///< rad
    double first = 0;      ///< m, slant range of the middle of bin 0
    double step = 0;       ///< m per bin
    std::size_t ping = 0;  ///< index of the ping it belongs to
    std::span<const float> values;
    std::size_t first_sum = 0;  ///< place of its running sums in PolarScan
};

class PolarScan {
  public:
    /// Refers to the values of `pings`, which must outlive it. Throws std::invalid_argument as
    /// polar_picture().
    explicit PolarScan(std::span<const Echogram> pings);

    /// Value at a slant range (m) and a bearing (rad, any turn), linear between neighbouring beams; along the
    /// range it is the mean over `extent` m, or linear between the middles of bins where these are longer. 0
    /// where no beam looks.
    double value(double range, double bearing, double extent = 0) const;
    /// Whether a beam looks at a bearing: it lies between neighbours or within an outer edge.
    bool covers(double bearing) const;

    const std::vector<Ray>& rays() const { return rays_; }
    bool full_turn() const { return full_turn_; }
    double begin() const { return begin_; }  ///< rad, port edge of the sector
    double end() const { return end_; }      ///< rad, starboard edge; begin() + 2 pi for a full turn
    double max_range() const { return max_range_; }

  private:
    void add(const Echogram& ping, std::size_t index);
    void sum_up(std::span<const float> values);
    double along(const Ray& ray, double range, double extent) const;
    void sort_rays();
    void cut_at_widest_gap();
    void set_edges(double widest_gap);
    /// The beams to either side of a bearing and the weight of the second.
    struct Place {
        const Ray* left;
        const Ray* right;
        double weight;
    };
    std::optional<Place> find(double bearing) const;
    bool neighbours(const Ray& left, const Ray& right, double gap) const;

    std::vector<Ray> rays_;
    std::vector<double> sums_;  ///< per ray: 0, then the sum of the values up to each bin
    bool full_turn_ = false;
    double spacing_ = 0;  ///< rad, usual angle between neighbours
    double begin_ = 0, end_ = 0, max_range_ = 0;
};

}  // namespace echoloop::draw
