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
#include "render/acoustics/random.h"
#include "render/acoustics/view_key.h"

namespace echoloop {

/// What is the same for all pings of one geometry.
struct ChainPlan {
    ChainPlan(const Shot& shot, double sound_speed, Effects effects, SpeckleOptions speckle);

    std::size_t bins;
    double first_range, bin_length;  ///< m
    bool pulse, speckle;             ///< which are on
    PulseShape shape;
    AngularGrid grid;
    LineFilter power, field, noise;
    bool fine = false;       ///< bins are shorter than the pulse: fields are filtered, not counted in looks
    double looks = 1;        ///< independent ones of the echo in one bin
    double noise_looks = 1;  ///< of the noise
    double noise_power = 0;  ///< uPa^2, 0: none
    double texture_shape = std::numeric_limits<double>::infinity();
    std::size_t texture_bins = 1;                                ///< bins that share a value of the texture
    float power_limit = std::numeric_limits<float>::infinity();  ///< uPa^2
    float amplitude_step = 0;                                    ///< uPa; 0: no steps
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
    /// In place, one beam's bins. `points`: those of this beam.
    void run(std::size_t beam, std::span<const PointEcho> points, std::span<float> values);

  private:
    /// A complex field, or in its place the power of looks, of one angular cell.
    struct Field {
        std::uint32_t cell = ~0U;
        std::vector<float> real, imaginary;
    };
    void spread(std::span<float> values);
    void modulate_texture(const AngularCells& cells, std::span<float> values);
    bool add_points(std::span<const PointEcho> points);
    void place(const PointEcho& point, double where);
    const Field& field_of(std::uint32_t cell);
    void fill_field(const LineFilter& filter, const RandomStream& stream, Field& out);
    RandomStream view_stream(std::uint32_t cell, std::uint32_t kind) const;
    RandomStream noise_stream(std::size_t beam, std::uint32_t kind) const;
    const Field& speckle_of(const AngularCells& cells);
    void blend(const AngularCells& cells, const Field& a, const Field& b);
    void fine_echo(std::size_t beam, const AngularCells& cells, bool points, std::span<float> values);
    void coarse_echo(const AngularCells& cells, bool points, std::span<float> values);
    void coarse_points(const AngularCells& cells, std::span<float> values) const;
    void coarse_noise(std::size_t beam, std::span<float> values);

    const ChainPlan* plan_ = nullptr;
    ChainPing ping_;
    std::array<Field, 2> fields_;
    std::size_t newest_ = 0;
    Field speckle_, noise_;
    Field points_;  ///< amplitude of the point echoes, sqrt(uPa^2)
    std::vector<float> looks_, cosines_, padded_, padded_imaginary_, scratch_;
};

}  // namespace echoloop
