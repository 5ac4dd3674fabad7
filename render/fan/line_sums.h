// The echo of every line of pixels and of every surround sector, per range bin, before it goes to the beams.
// Owns the scratch memory of one kind of sum; knows no beams.
#pragma once

#include <span>
#include <vector>

#include "render/fan/bin_gain.h"
#include "render/fan/line_bins.h"
#include "render/fan/line_reader.h"
#include "render/simd.h"

namespace echoloop {

class LineSums {
  public:
    /// `steps`: of the water's volume and of its surface, behind the bins of each row.
    void resize(std::size_t lines, std::size_t sectors, std::size_t bins, std::size_t steps = 0);
    /// The same, but rows may hold what they did, for who sets each line, and clears its steps right before
    /// that, on the thread that does so.
    void fit(std::size_t lines, std::size_t sectors, std::size_t bins, std::size_t steps);
    void clear_steps(std::size_t i);
    void clear_sectors();
    LineBins& line(std::size_t i) { return lines_[i]; }
    LineBins& sector(std::size_t i) { return sectors_[i]; }
    /// Of the whole rows, their steps among them.
    FilledBins filled_line(std::size_t i) const { return lines_[i].filled() | filled_steps(); }
    FilledBins filled_sector(std::size_t i) const { return sectors_[i].filled() | filled_steps(); }
    const float* line_values(std::size_t i) const { return row(i); }
    float* sector_values(std::size_t i) { return row(lines_.size() + i); }
    const float* sector_values(std::size_t i) const { return row(lines_.size() + i); }

    /// After surround lines have been added.
    void look_at_sectors();

    std::size_t steps() const { return steps_; }
    /// Of a row: its bins and both kinds of steps.
    std::size_t length() const { return bins_ + 2 * steps_; }
    /// From row to row, whole lines of the processor's cache, with zeros at the end: a vector that lies
    /// across two of them is slow to read.
    std::size_t stride() const {
        return (length() + floats_per_line - 1) / floats_per_line * floats_per_line;
    }
    /// Both kinds of steps of a line or sector, the volume's first.
    float* line_steps(std::size_t i) { return row(i) + bins_; }
    float* sector_steps(std::size_t i) { return line_steps(lines_.size() + i); }

  private:
    FilledBins filled_steps() const {
        return FilledBins::within(bins_, length(), FilledBins::shift_of(length()));
    }
    float* row(std::size_t i) { return first_ + i * stride(); }
    const float* row(std::size_t i) const { return first_ + i * stride(); }

    std::size_t bins_ = 0, steps_ = 0;
    std::vector<float> values_;
    float* first_ = nullptr;  ///< of values_, where a line of the cache begins
    std::vector<LineBins> lines_, sectors_;
};

/// What a pixel adds for each rule, before the gain of its bin.
enum class Amount {
    echo,
    wanted_echo,  ///< of the surfaces in BinningInput::wanted only
    paper_echo,
    paper_share
};

constexpr bool is_echo(Amount amount) { return amount == Amount::echo || amount == Amount::wanted_echo; }

/// Sets the bins of a level line to what its pixels send back, and adds the water's echo to its `steps`
/// unless that is null.
void add_level_line(const BinningInput& in, const BinGain& gain, Amount amount, const View& view,
                    std::size_t line, LineReader& reader, LineBins& bins, float* steps = nullptr);
/// Adds the pixels of a surround line to their sectors, at which nobody looks; `only_wanted`: of the surfaces
/// in BinningInput::wanted. `under_way`: of every sector; empty where the water is silent.
void add_surround_line(const BinningInput& in, const BinGain& gain, bool only_wanted, const View& view,
                       std::size_t line, LineReader& reader, LineSums& sums,
                       std::span<UnderWay> under_way = {});

}  // namespace echoloop
