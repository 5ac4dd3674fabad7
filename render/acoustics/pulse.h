// How one scatterer's echo is spread along range by the pulse and the receiver. Pure functions; knows no
// bins.
#pragma once

#include <vector>

#include "render/echogram.h"

namespace echoloop {

/// A compressed chirp of u = x / (stretch c / (2 B)), the transform of Hamming weights over the band, has the
/// integral c / (2 B): that of its square over u is (0.54^2 + 0.46^2 / 2) / 0.54^2.
inline constexpr double chirp_stretch = 1 / (1 + 0.46 * 0.46 / (2 * 0.54 * 0.54));

/// The power of one echo over range, with peak 1 and an integral of range_resolution().
///
/// CW: it begins at the target's range; its power rises and, c tau / 2 later, falls linearly within half the
/// resolution c / (2 B) of the receiver's bandwidth B (1 / tau where not given; at most c tau / 2).
/// Chirp: after compression with Hamming weights, centred on the target's range: side lobes -42.7 dB, -3 dB
/// width 0.956 c / (2 B), cut off at six resolutions.
class PulseShape {
  public:
    PulseShape(const Shot& shot, double sound_speed);

    double length() const { return length_; }          ///< m, the integral
    double begin() const { return begin_; }            ///< m, against the target's range
    double end() const { return end_; }                ///< m
    double main_begin() const { return main_begin_; }  ///< m, of the main lobe
    double main_end() const { return main_end_; }      ///< m
    bool is_chirp() const { return !table_.empty(); }
    double edge() const { return edge_; }  ///< m, length of a CW pulse's edges

    /// m, the integral of the power from the beginning to `offset` m against the target's range.
    double energy_until(double offset) const;

  private:
    void make_chirp_table();
    double length_, edge_ = 0, begin_ = 0, end_ = 0, main_begin_ = 0, main_end_ = 0;
    std::vector<double> table_;  ///< energy until begin + i * step, of a chirp
};

}  // namespace echoloop
