// One beam's way through the chain: pulse, speckle, noise, receiver. Holds the work memory of one thread;
// what it computes for a beam depends on that beam and its keys alone.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "render/acoustics/bin_filters.h"
#include "render/acoustics/chain.h"
#include "render/acoustics/lean.h"
#include "render/acoustics/random.h"
#include "render/acoustics/view_key.h"

namespace echoloop {

/// What is the same for all pings of one geometry.
struct ChainPlan {
    ChainPlan(const Shot& shot, double sound_speed, Effects effects, SpeckleOptions speckle);

    /// Whether a beam's speckle depends on the mean powers of the beams beside it.
    bool leans() const { return speckle && lean.any(); }

    std::size_t bins;
    double first_range, bin_length;  ///< m
    bool pulse, speckle;             ///< which are on
    PulseShape shape;
    AngularGrid grid;
    Lean lean;  ///< of the speckle's cells
    LineFilter power, field, noise;
    bool fine = false;       ///< bins are shorter than the pulse: fields are filtered, not counted in looks
    double looks = 1;        ///< independent ones of the echo in one bin
    double noise_looks = 1;  ///< of the noise
    double noise_power = 0;  ///< uPa^2, the converters' steps among it; 0: none
    double texture_shape = std::numeric_limits<double>::infinity();
    std::size_t texture_bins = 1;                                ///< bins that share a value of the texture
    float power_limit = std::numeric_limits<float>::infinity();  ///< uPa^2
};

/// What changes from ping to ping.
struct ChainPing {
    std::uint64_t key = 0, ping = 0;
    ViewKey view;
    double pan = 0;
    std::span<const double> bearings;
};

class BeamChain {
  public:
    /// Drops what it kept of the ping before.
    void start(const ChainPlan& plan, const ChainPing& ping);
    /// Mean power of one beam's bins after the pulse.
    void spread(std::span<const float> values, std::span<float> means);
    /// In place, one beam's bins. `points`: those of this beam. `means`: spread() of all beams, where the
    /// plan's speckle leans; else not read.
    void run(std::size_t beam, std::span<const PointEcho> points, std::span<const float> means,
             std::span<float> values);

  private:
    /// What random numbers are for.
    enum Kind : std::uint32_t { speckle, speckle_phase, speckle_blend, texture, noise, noise_phase };
    /// A complex field, or in its place the power of looks and how those of the next cell interfere, of one
    /// angular cell.
    struct Field {
        std::uint32_t cell = ~0U;
        std::uint64_t used = 0;  ///< greater: later
        std::vector<float> real, imaginary;
    };
    /// What a beam between two cells hears, in the bins [first, first + count).
    struct Part {
        const AngularCells& cells;
        std::size_t first = 0, count = 0;
    };
    void modulate_texture(const AngularCells& cells, std::span<float> values);
    bool add_points(std::span<const PointEcho> points);
    void place(const PointEcho& point, double where);
    const Field& field_of(std::uint32_t cell);
    void fill_field(const LineFilter& filter, const RandomStream& stream, Field& out);
    RandomStream view_stream(std::uint32_t cell, std::uint32_t kind) const;
    RandomStream noise_stream(std::size_t beam, std::uint32_t kind) const;
    void make_room(Field& field) const;
    const Field& speckle_of(std::size_t beam, const AngularCells& cells, std::span<const float> means);
    void blend(const Part& part);
    void blend_leaning(const Part& part, float* places);
    void interfere(const Part& part);
    void interfere_leaning(const Part& part, float* places);
    void fine_echo(std::size_t beam, const Field* field, bool points, std::span<float> values);
    void coarse_echo(const AngularCells& cells, const Field* field, bool points, std::span<float> values);
    void coarse_points(const AngularCells& cells, std::span<float> values) const;
    void coarse_noise(std::size_t beam, std::span<float> values);

    const ChainPlan* plan_ = nullptr;
    ChainPing ping_;
    std::array<Field, 2 * Lean::most + 2>
        fields_;  ///< of the cells that a beam may need, and of the last ones
    std::uint64_t uses_ = 0;
    Field speckle_, noise_;
    Field points_;  ///< amplitude of the point echoes, sqrt(uPa^2)
    std::vector<float> looks_, cosines_, places_, padded_, padded_imaginary_, scratch_;
};

}  // namespace echoloop
