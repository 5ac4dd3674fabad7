// Spreads echoes over the bins that they cover, eight bins at once: most cover two to five. Knows no pixels
// and no beams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace echoloop {

/// Floats behind the last bin of the last row that spread_over_rows() may touch; it adds 0 there.
inline constexpr std::size_t bins_at_once = 8;

/// Where echoes lie, and how strong they are: as LineBins::deposit() takes them.
struct EchoArrays {
    const float *low, *high, *amount, *slope;
};

/// Bins begin..end - 1.
struct BinStretch {
    std::size_t begin = 0, end = 0;
    bool empty() const { return begin >= end; }
};

/// Echoes as blocks of bins. Holds the work memory of one thread.
class EchoSpreader {
  public:
    /// Adds up the echoes of one line. Returns which of the `bins` of `values` it has set; what the others
    /// hold stays. Neighbours mostly cover the same bins, and what was just written is slow to read at
    /// another place: so they take turns in a few rows, which are added at the end.
    BinStretch spread(const EchoArrays& echoes, std::size_t count, std::size_t bins, float* values);

    /// Adds each echo to a row of its own choice: `row` says which one, `stride` floats after the one before.
    void spread_over_rows(const EchoArrays& echoes, const std::int32_t* row, std::size_t count,
                          std::size_t bins, std::size_t stride, float* rows);

  private:
    void find(const EchoArrays& echoes, const std::int32_t* row, std::size_t count, std::size_t bins,
              std::size_t stride, std::int32_t step);
    void add(std::size_t count, float* rows);

    std::vector<float> low_, high_, base_, change_;
    std::vector<std::int32_t> first_, blocks_, at_, turn_;
    std::vector<float> turns_;
};

/// Bins: of what is narrower nothing but its amount counts.
inline constexpr float narrowest_echo = 1.0F / 64;

}  // namespace echoloop
