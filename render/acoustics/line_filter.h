// Convolution of one beam with a short kernel or a long box. Deterministic; nothing wraps round the window's
// ends, and sums of what is not negative are never negative.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace echoloop {

class LineFilter {
  public:
    /// Leaves its input as it is.
    LineFilter() : LineFilter(0, {1.0F}) {}
    /// out[j] = sum over k of taps[k] in[j - first - k]. Throws std::invalid_argument where there is no tap.
    LineFilter(std::ptrdiff_t first, std::vector<float> taps);
    /// As above, but of an input that a box of `length` >= 1 bins and height 1, then one of `smoothing` bins
    /// and sum 1, have gone over: O(1) a bin.
    static LineFilter boxed(double length, std::size_t smoothing, std::ptrdiff_t first,
                            std::vector<float> taps);

    /// The same of an input that is moved by a part of a bin: of (1 - share) in[j] + share in[j + 1].
    LineFilter moved(float share) const;

    /// Bins of input that the first output needs before itself, and the last one behind itself.
    std::size_t before() const;
    std::size_t after() const;
    bool is_identity() const { return box_ == 0 && first_ == 0 && taps_.size() == 1 && taps_[0] == 1.0F; }

    /// `padded` holds before() bins, then `count` bins that belong to the output, then after() bins, and has
    /// room for room(count) floats; it is overwritten. `out` has room for `count`.
    void apply(std::span<float> padded, std::size_t count, float* out, std::vector<float>& scratch) const;
    /// Whether `values` can be filtered as they are, with zeros before and behind them, by filter().
    bool is_short() const { return box_ == 0 && taps_.size() <= most_short; }
    /// `out` lies elsewhere, and is as long. Of a filter that is_short().
    void filter(std::span<const float> values, float* out) const;
    std::size_t room(std::size_t count) const { return before() + count + after() + tile; }
    bool operator==(const LineFilter&) const = default;

    static constexpr std::size_t tile = 32;  ///< outputs at a time

  private:
    static constexpr std::size_t most_short = 8;  ///< taps, as many as have a loop of their own
    std::ptrdiff_t first_;
    std::vector<float> taps_;
    std::size_t box_ = 0, smoothing_ = 1;
    float rest_ = 0;  ///< the part of a bin by which the box is longer than box_
};

}  // namespace echoloop
