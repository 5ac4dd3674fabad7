// The echo of every line of pixels and of every surround sector, per range bin, before it goes to the beams.
// Owns the scratch memory of one kind of sum; knows no beams.
#pragma once

#include <span>
#include <vector>

#include "render/fan/bin_gain.h"
#include "render/fan/line_bins.h"
#include "render/fan/line_echoes.h"
#include "render/fan/pixel_rows.h"
#include "render/fan/reverberation.h"
#include "render/fan/sector_echoes.h"
#include "render/fan/spreads.h"

namespace echoloop {

class LineSums {
  public:
    /// `steps`: of the water's volume and of its surface, behind the bins of each row.
    void resize(std::size_t lines, std::size_t sectors, std::size_t bins, std::size_t steps = 0);
    LineBins& line(std::size_t i) { return lines_[i]; }
    LineBins& sector(std::size_t i) { return sectors_[i]; }
    const float* line_values(std::size_t i) const { return &values_[i * stride()]; }
    float* sector_values(std::size_t i) { return &values_[(lines_.size() + i) * stride()]; }
    const float* sector_values(std::size_t i) const { return &values_[(lines_.size() + i) * stride()]; }

    std::size_t steps() const { return steps_; }
    std::size_t stride() const { return bins_ + 2 * steps_; }
    /// Both kinds of steps of a line or sector, the volume's first.
    float* line_steps(std::size_t i) { return &values_[i * stride() + bins_]; }
    float* sector_steps(std::size_t i) { return line_steps(lines_.size() + i); }

  private:
    std::size_t bins_ = 0, steps_ = 0;
    std::vector<float> values_;
    std::vector<LineBins> lines_, sectors_;
};

/// Reads the pixels of one thread's lines; keeps three rows, so that who needs a line's neighbours unpacks
/// them once.
class LineReader {
  public:
    /// Line `line` of `view`, as far as the water's surface; valid until the next call.
    void read_alone(const BinningInput& in, const View& view, std::size_t line);
    /// The same and its neighbours.
    void read(const BinningInput& in, const View& view, std::size_t line);
    /// Forgets what it has read; before other pixels.
    void restart() { next_ = no_line; }
    const PixelRow& row() const { return rows_[1]; }
    /// Whether the line that read_alone() has read may show the water's surface.
    bool meets_water() const { return meets_water_; }
    /// The lines on both sides, at a view's edge the line itself.
    const PixelRow& before() const { return first_ ? rows_[1] : rows_[0]; }
    const PixelRow& after() const { return last_ ? rows_[1] : rows_[2]; }

    Extents extents;             ///< what the reader of the line makes of it
    std::vector<float> weights;  ///< of the line's samples, where they are not those of the plan
    std::vector<float> closing;  ///< m/s, of the line's samples, where something moves
    LineEchoes echoes;           ///< of the line's samples
    SectorEchoes of_sectors;     ///< of a surround line's samples
    SectorEchoes of_surface;     ///< of those that show the water's surface, in steps
    UnderWay under_way;          ///< what of the line no surface has met

  private:
    static bool load(PixelRow& row, const BinningInput& in, const View& view, std::size_t line);

    static constexpr std::size_t no_line = static_cast<std::size_t>(-1);
    PixelRow rows_[3];
    std::size_t next_ = no_line;  ///< image line that rows_[2] holds
    bool first_ = true, last_ = true, meets_water_ = false;
};

/// What a pixel adds for each rule, before the gain of its bin.
enum class Amount {
    echo,
    wanted_echo,  ///< of the surfaces in BinningInput::wanted only
    paper_echo,
    paper_share
};

constexpr bool is_echo(Amount amount) { return amount == Amount::echo || amount == Amount::wanted_echo; }

/// Adds the pixels of a level line to its bins, and the water's echo to its `steps` unless that is null.
void add_level_line(const BinningInput& in, const BinGain& gain, Amount amount, const View& view,
                    std::size_t line, LineReader& reader, LineBins& bins, float* steps = nullptr);
/// Adds the pixels of a surround line to their sectors; `only_wanted`: of the surfaces in
/// BinningInput::wanted. `under_way`: of every sector; empty where the water is silent.
void add_surround_line(const BinningInput& in, const BinGain& gain, bool only_wanted, const View& view,
                       std::size_t line, LineReader& reader, LineSums& sums,
                       std::span<UnderWay> under_way = {});

}  // namespace echoloop
