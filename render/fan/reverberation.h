// What the water sends back between echoes: all that floats in it, and its surface in the wind. Every pixel's
// weight is under way until it meets something; no directions are added to those of the picture.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "render/echogram.h"
#include "render/fan/pixel_rows.h"
#include "render/pose.h"
#include "render/ray_table.h"
#include "render/view.h"
#include "render/water.h"

namespace echoloop {

/// The window in a few steps of range, as what varies slowly needs no more.
struct RangeSteps {
    std::size_t count = 0,
                bins = 1;  ///< steps, the last of them perhaps longer than the window; bins in each
    static constexpr std::size_t usual = 32;
    static RangeSteps of(std::size_t bins);
};

/// Ranges within which a beam is not formed yet, m, across its width and its height. Farther away the volume
/// that it hears grows with range; nearer it stays as large as the array. An aperture that sends and receives
/// hears the square of its own near field, which is as even as its face: 2/3 L^2 / wavelength for a line (own
/// derivation; 0.68 of a piston's area over the wavelength; Fresnel's integral agrees to 0.6 dB for lines and
/// Hamming). Where only one way is directive, all that it sends stays under way however near: half of the
/// array's length, since no stave is nearer than that to what all of it sees.
std::array<double, 2> near_ranges(const Shot& shot, double wavelength);

/// Where the array is, and what is around it.
struct WaterAround {
    Vec3 up;                                                   ///< of the world, in the fan's frame
    double depth = 0;                                          ///< m below the surface
    double surface = std::numeric_limits<double>::infinity();  ///< m, of the surface above; infinite: none
    float surface_number = 0;                                  ///< as Pixel::surface: what it scatters
    std::span<const ScatteringPoint> scattering{};
    std::array<double, 2> near{};    ///< see near_ranges()
    const RayTable* rays = nullptr;  ///< null: they are straight
};

/// From m to steps: range * per_metre - start.
struct StepScale {
    float per_metre, start;
};

/// Of one array's ping.
class Reverberation {
  public:
    /// `first_range`, `bin_length`: m.
    Reverberation(const WaterAround& around, double first_range, double bin_length, std::size_t bins);

    const RangeSteps& steps() const { return steps_; }
    float surface_number() const { return around_.surface_number; }
    /// The surface as that line meets it; false where it does not.
    bool find_plane(const View& view, std::size_t line, PixelOffset offset, PlaneOfLine& plane) const;

    /// Of volume scattering by direction: cells of the sine of elevation in the world, one where depth does
    /// not matter.
    std::size_t cells() const { return cells_; }
    bool by_depth() const { return cells_ > 1; }
    /// Strength times bin length over the steps, of a cell.
    const float* strengths(std::size_t cell) const { return &strengths_[cell * steps_.count]; }
    /// The same for a direction, in whole cells.
    std::size_t cell_near(double sine) const;
    /// Sine of elevation in the world; `x`, `y` on the view's image plane.
    class Rise {
      public:
        Rise(Vec3 up_in_view, double x)
            : upright_(static_cast<float>(up_in_view.x - x * up_in_view.y)),
              per_y_(static_cast<float>(up_in_view.z)),
              square_(static_cast<float>(1 + x * x)) {}
        float at(float y) const { return (upright_ + per_y_ * y) / std::sqrt(square_ + y * y); }

      private:
        float upright_, per_y_, square_;
    };
    Rise rise(const View& view, double x) const;
    /// Of each bin: the volume's power over what a beam formed at once would hear, 0..1.
    const std::vector<float>& nearness() const { return nearness_; }
    /// Steps from the window's beginning to a range in m.
    float place(float range) const { return range * scale_.per_metre - scale_.start; }
    StepScale scale() const { return scale_; }

  private:
    WaterAround around_;
    RangeSteps steps_;
    StepScale scale_{};
    double end_;  ///< m
    std::size_t cells_ = 1;
    std::vector<float> strengths_, nearness_;
};

/// Where directions meet something.
struct WayEnds {
    std::vector<std::int32_t> step;  ///< in which it is, counted from 1
    std::vector<float> within;       ///< share of that step that lies before it

    /// Of a row of directions, which meet `range`, in m, or where `surface` is 0 nothing.
    void find(const Reverberation& water, const float* range, const float* surface, std::size_t count);
};

/// Weight of directions that is still under way, by range.
class UnderWay {
  public:
    void reset(const Reverberation& water);
    /// For directions that are nearly the same.
    void reset_alike(const Reverberation& water);
    /// `end`: place where they meet something; infinite: nowhere.
    void add(float end, float weight) { add_to(0, end, weight); }
    /// `sine`: see Reverberation::cells().
    void add(float end, float sine, float weight) {
        if (cells_ == 1) return add_to(0, end, weight);
        const float cell = std::clamp(0.5F * (sine + 1), 0.0F, 1.0F) * static_cast<float>(cells_ - 1);
        const std::size_t lower = std::min(static_cast<std::size_t>(cell), cells_ - 2);
        const float share = cell - static_cast<float>(lower);
        add_to(lower, end, weight * (1 - share));
        add_to(lower + 1, end, weight * share);
    }
    /// The same of direction i of `ends`; where depth does not matter.
    void add(const WayEnds& ends, std::size_t i, float weight) {
        float* row = &met_[static_cast<std::size_t>(ends.step[i])];
        const float within = weight * ends.within[i];
        row[0] += within, row[-1] += weight - within;
    }
    /// The same for a row of directions of weights > 0 that meet `range`, in m, or where `surface` is 0
    /// nothing.
    void add(const Reverberation& water, const float* range, const float* surface, const float* weight,
             std::size_t count);
    /// Adds what it scatters to the steps, and resets.
    void scatter(const Reverberation& water, float* steps);
    /// The same of directions that are nearly the same, of one cell of the water.
    void scatter_alike(const Reverberation& water, std::size_t cell, float* steps);

  private:
    /// A step counts by the share of it that lies before `end`, so the sum from behind is right.
    void add_to(std::size_t cell, float end, float weight) {
        const float at = std::clamp(end + 1, 0.0F, static_cast<float>(row_ - 1));
        const auto whole = static_cast<int>(at);
        const float share = at - static_cast<float>(whole);
        float* row = &met_[cell * row_];
        row[whole] += weight * share;
        if (whole > 0) row[whole - 1] += weight * (1 - share);
    }

    void scatter_row(std::size_t number, const float* strength, float* steps);

    std::size_t cells_ = 1, row_ = 0;
    std::vector<float> met_;          ///< cells x (steps + 2), by where directions end
    std::vector<std::int32_t> ends_;  ///< of the row at hand
    std::vector<float> parts_;        ///< the same: of its weight, what counts there and in the step before
    static constexpr std::size_t turns = 4;
    std::vector<float> turns_;  ///< turns x (steps + 2) x both parts
};

/// Takes apart what was summed in rows of bins and, behind them, steps of volume and of surface echo: the
/// bins with the volume's echo, and what is new at every ping, as the mean power of a bin in each step.
class FinishedRows {
  public:
    /// `gain`: of the bins; the steps have none yet. Resizes `values` and `fresh` for so many rows.
    FinishedRows(const Reverberation& water, const std::vector<float>& gain, std::size_t rows,
                 std::vector<float>& values, std::vector<float>& fresh);
    /// Rows first..first + count - 1, which begin at `rows`; others may be finished at the same time.
    void finish(const float* rows, std::size_t first, std::size_t count);

  private:
    const Reverberation& water_;
    const std::vector<float>& gain_;
    std::vector<float> volume_gain_;
    std::vector<float>&values_, &fresh_;
};

/// The gain of such a row.
std::vector<float> with_steps(std::vector<float> gain, const RangeSteps& steps);

}  // namespace echoloop
