// The loops over the bins of a beam that leans: where each bin is heard, and what is heard there. No keys, no
// geometry, no memory of their own.
#pragma once

#include <cstddef>
#include <utility>

namespace echoloop::kernels {

/// Fields of neighbouring cells, and how much a place hears of each: see BeamKernel.
struct CellFields {
    const float* const* fields;
    std::size_t count;  ///< at least one
    int first;          ///< the cell of the first of them
    int beside;         ///< so many on either side of a place are heard at most
    float per_reach;    ///< 1 / reach^2
    float middle;
};

/// Bins that lean together, or are heard on the beam's axis.
constexpr std::size_t lean_block = 32;

/// Sets those of `differs` to true, one for each block of bins, where one of two powers is anywhere more than
/// `ratio` times the other and `least`.
void differ(const float* a, const float* b, float ratio, float least, std::size_t count, bool* differs);
/// out += scale ln(a / b), |error| < 1e-4 scale; powers below 1e-12 uPa^2 count as that.
void add_log_ratio(float scale, const float* a, const float* b, std::size_t count, float* out);
/// Brings what is beyond +-most back to it, and what is no number to -most.
void limit(float most, std::size_t count, float* values);
/// Adds `by` to places, and says within which cells they lie: the least and the greatest whole number below.
std::pair<int, int> shift(float by, std::size_t count, float* places);
/// out = what each bin hears at its place, in cells, with weights whose squares add up to 1. `energies`: room
/// for one number a bin.
void hear_cells(const CellFields& cells, const float* places, std::size_t count, float* energies, float* out);

}  // namespace echoloop::kernels
