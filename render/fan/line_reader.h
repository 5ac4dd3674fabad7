// The pixels of one line, read for who adds them up, with the work memory that this takes. Knows no bins.
#pragma once

#include <cstddef>
#include <vector>

#include "render/fan/binning.h"
#include "render/fan/line_echoes.h"
#include "render/fan/pixel_rows.h"
#include "render/fan/reverberation.h"
#include "render/fan/sector_echoes.h"
#include "render/fan/spreads.h"
#include "render/fan/surround_hearing.h"

namespace echoloop {

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
    /// Shifts `extents` as in.motion, which is there, says, and returns `weight`, of each sample, times the
    /// closing speeds that are asked for.
    const float* apply_motion(const BinningInput& in, const View& view, std::size_t line,
                              const float* weight);
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
    SurroundHearing hearing;     ///< of a surround line's samples
    SectorEchoes of_sectors;     ///< the same
    SectorEchoes of_surface;     ///< of those that show the water's surface, in steps
    UnderWay under_way;          ///< what of the line no surface has met
    WayEnds ends;                ///< of a surround line's samples

  private:
    static bool load(PixelRow& row, const BinningInput& in, const View& view, std::size_t line);

    static constexpr std::size_t no_line = static_cast<std::size_t>(-1);
    PixelRow rows_[3];
    std::size_t next_ = no_line;  ///< image line that rows_[2] holds
    bool first_ = true, last_ = true, meets_water_ = false;
};

}  // namespace echoloop
