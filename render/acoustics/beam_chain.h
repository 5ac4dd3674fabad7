// One beam's way through the chain: pulse, speckle, noise, receiver. Holds the work memory of one thread;
// what it computes for a beam depends on that beam and its keys alone.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "render/acoustics/bin_filters.h"
#include "render/acoustics/bin_law.h"
#include "render/acoustics/chain.h"
#include "render/acoustics/interference.h"
#include "render/acoustics/lean.h"
#include "render/acoustics/random.h"
#include "render/acoustics/range_correlation.h"
#include "render/acoustics/ring_down.h"
#include "render/acoustics/row_fields.h"
#include "render/acoustics/scatterer_view.h"

namespace echoloop {

/// White numbers, how they correlate, and how much a bin scatters: of the echo or of the noise.
struct Scatter {
    double looks = 1;       ///< independent ones in a bin
    LineFilter bins;        ///< over range
    double neighbours = 0;  ///< correlation of what it makes, one bin on
    BeamKernel kernel;      ///< over directions
    BeamKernel upright;     ///< over rows of cells
    BinLaw law;
    bool operator==(const Scatter&) const = default;
};

/// What is the same for all pings of one geometry.
struct ChainPlan {
    ChainPlan(const Shot& shot, double sound_speed, Effects effects, SpeckleOptions speckle);

    /// Whether a beam's speckle depends on the mean powers of the beams beside it.
    bool leans() const { return speckle && lean.any(); }
    bool textured() const { return std::isfinite(texture_shape); }
    /// Whether what is new at every ping correlates and scatters as the noise does: then its numbers are the
    /// noise's.
    bool fresh_is_noise() const { return noise_power > 0 && echo == noise && !textured(); }

    std::size_t bins;
    double first_range, bin_length;  ///< m
    bool pulse, speckle;             ///< which are on
    bool keeps_peaks;                ///< BinRule::peak
    PulseShape shape;
    AngularGrid grid;
    Lean lean;  ///< of the speckle's cells
    LineFilter power;
    double power_gain = 1;  ///< of the pulse, where power is the same in all bins
    Scatter echo, noise;
    double noise_power = 0;    ///< uPa^2, the converters' steps among it; 0: none
    bool shares_noise = true;  ///< beams lie so near to each other that their noise is in part the same
    double texture_shape = std::numeric_limits<double>::infinity();
    BinLaw texture;
    std::size_t bins_per_look = 1;
    float power_limit = std::numeric_limits<float>::infinity();  ///< uPa^2
    RingDownPlan ring_down;
    InterferencePlan interference;
};

/// A row of cells, and how the sonar sees it.
struct CellRow {
    RowShare share;
    ScattererView view;
    float echo, noise;  ///< weights, whose squares each add up to 1 over the rows that a row of beams hears
};

/// What changes from ping to ping.
struct ChainPing {
    std::uint64_t key = 0, ping = 0;
    ScattererView view;
    double pan = 0;
    std::span<const double> bearings;
    double source_level = 0;      ///< dB re 1 uPa at 1 m
    std::vector<CellRow> rows{};  ///< of cells, that a row of beams hears; none: one of its own
    bool first_row = false;       ///< of a ping
};

class BeamChain {
  public:
    /// Drops what it kept of the ping before, or of the row of beams before what the next does not need.
    void start(const ChainPlan& plan, const ChainPing& ping);
    /// Before a stretch of beams, which are run one after the other.
    void start_stretch() { next_mean_ = none; }
    /// A beam's bins before the pulse.
    using Before = std::function<std::span<const float>(std::size_t beam)>;
    /// In place, one beam's bins. `points`: those of this beam. `before`: of that one or the next, and of one
    /// beside them, where the plan's speckle leans; each is asked for once in a stretch.
    void run(std::size_t beam, std::span<const PointEcho> points, const Before& before,
             const FreshPower& fresh, std::span<float> values);

  private:
    /// What random numbers are for.
    enum Kind : std::uint32_t { speckle, noise, texture, point_phase, noise_phase, fresh_speckle, kinds };
    /// Normal numbers of one angular cell, over the bins.
    struct Field {
        std::uint32_t cell = ~0U;
        std::uint64_t used = 0;  ///< greater: later
        std::vector<float> values;
    };
    /// Those that neighbouring beams share: as many as one beam may need, however it leans.
    static constexpr std::size_t kept = 16;
    struct Fields {
        std::array<Field, kept> of_cells;
        std::vector<float> heard;  ///< by one beam
    };
    /// The bins [first, first + count).
    struct Part {
        std::size_t first = 0, count = 0;
    };
    /// Fields that a beam hears, and how much of each.
    struct HeardCells {
        static constexpr std::size_t most = 10;
        std::array<const float*, most> fields{};
        std::array<float, most> weights{};
        std::size_t count = 0;
    };
    const float* field_of(Kind kind, std::uint32_t cell);
    const float* speckle_beside(std::uint32_t cell, int step);
    HeardCells cells_at(Kind kind, double place);
    void fill(Kind kind, std::uint32_t cell, std::vector<float>& out);
    void fill_from(const ScattererView& view, std::uint64_t key, Kind kind, std::uint32_t cell,
                   std::vector<float>& out);
    void filter_white(const LineFilter& filter, std::size_t at, std::vector<float>& out);
    void fill_from_layers(const ScattererView& view, std::uint64_t key, Kind kind, std::uint32_t cell,
                          std::vector<float>& out);
    void mix_rows(Kind kind, std::uint32_t cell, std::vector<float>& out);
    void hear(Kind kind, const HeardCells& cells, Part part);
    void hear_leaning(double place, Part part);
    const float* speckle_of(std::size_t beam, double place);
    void spread(std::span<const float> values, std::span<float> means);
    void find_means(std::size_t beam, const Before& before);
    void scatter_with_noise(std::span<const float> means, const float* echo, const float* of_noise,
                            const FreshPower& fresh, std::span<float> values);
    void spread_steps(const FreshPower& fresh);
    void renew_speckle(std::size_t beam, const FreshPower& fresh, std::span<const float> means);
    const float* noise_of(std::size_t beam);
    void steady_in_noise(std::size_t beam, std::span<float> values);
    bool add_points(std::span<const PointEcho> points);
    Part bins_of(const PointEcho& point) const;
    void place_point(const PointEcho& point);
    double share_of(double from) const;
    void interfere_with_points(double place, std::span<float> values) const;

    static constexpr std::size_t none = ~std::size_t{0};

    const ChainPlan* plan_ = nullptr;
    ChainPing ping_;
    Lean::Means means_;             ///< after the pulse
    std::size_t next_mean_ = none;  ///< beam of the next of them
    std::vector<Lean::Stretch> stretches_;
    std::vector<float> own_means_;  ///< of a beam that knows none beside it
    std::vector<float> textured_;
    std::array<Fields, kinds> fields_;
    std::array<RowFields, kinds> of_rows_;
    std::array<const float*, kept> beside_{};  ///< fields of speckle of the beam under way, by steps from it
    std::uint64_t uses_ = 0;
    Part with_points_;                                   ///< bins that a beam's point echoes reach
    std::vector<float> points_real_, points_imaginary_;  ///< amplitude of the point echoes, sqrt(uPa^2)
    std::vector<float> places_, energies_, cosines_, padded_, white_, scratch_, fresh_;
};

}  // namespace echoloop
