// What becomes of mean echo power on its way to the receiver's output: pulse, speckle, noise, saturation,
// converter. Plain CPU code, deterministic with any number of threads; knows no GL, no scene and no protocol.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/acoustics/receiver_noise.h"
#include "render/echogram.h"
#include "render/effects.h"

namespace echoloop {

class Workers;

/// An echo of one scatterer that does not fluctuate, such as a target of declared strength: it interferes
/// with the diffuse echo, but has no speckle of its own.
struct PointEcho {
    std::size_t beam = 0;
    double range = 0;  ///< m, slant
    double power = 0;  ///< uPa^2 at the receiver, at the pulse's full height, beam pattern included
    double phase = 0;  ///< rad
};

/// Of the mean echo power, what comes from scatterers that are others at every ping: what floats in the
/// water, waves.
struct FreshPower {
    std::span<const float> steps;   ///< beams x steps of range, uPa^2 in a bin; empty: none
    std::size_t bins_per_step = 1;  ///< the last step may reach beyond the last bin
};

/// Scintillation of the speckle: K distribution with shape nu, var(I)/mean(I)^2 = 1 + 2/nu; infinite: fully
/// developed.
struct SpeckleOptions {
    double shape = std::numeric_limits<double>::infinity();
};

/// One of the rows of white numbers that a row of beams hears, as it hears cells along its beams.
struct RowShare {
    std::uint32_t row = 0;  ///< number of the row of cells
    std::uint64_t key = 0;  ///< of its random numbers
    double tilt = 0;        ///< rad, where it lies
    double distance = 0;    ///< from the row of beams, in heights of a cell
};
/// Which of them a row of beams hears; rows of one ping one after the other, `first` beginning anew.
struct RowShares {
    bool first = true;
    std::vector<RowShare> shares;
};

class AcousticChain {
  public:
    /// `workers`: null: those of its own.
    explicit AcousticChain(Effects effects, SpeckleOptions speckle = {},
                           std::shared_ptr<Workers> workers = nullptr);
    ~AcousticChain();
    AcousticChain(AcousticChain&&) noexcept;

    /// Turns `values` (beams x bins of the shot, beam-major; each the sum of the echo power that arrives
    /// within the bin as if the pulse were infinitely short and of unit height, uPa^2) into the mean
    /// intensity of the receiver's output over each bin, or what else its BinRule says, uPa^2, in place.
    /// Returns the mean noise power in it, uPa^2. `rows`: of a row of beams among others.
    ///
    /// Pulse on: convolved with the pulse's shape of unit height, so that area scattering has the insonified
    /// length c tau / 2 (CW) or c / (2 B) (chirp), whatever the bin size; off: left as it is. A CW echo
    /// begins at its range, a compressed chirp lies around it (see PulseShape). Speckle's random numbers are
    /// a function of shot.random_key and of the pose: the same view gives the same speckle, one moved a
    /// little nearly the same (see ScattererView). Noise, and speckle of `fresh`, are keyed by shot.ping as
    /// well.
    double apply(const Shot& shot, const Pose& world_from_sonar, double sound_speed,
                 std::span<const PointEcho> points, std::span<float> values, FreshPower fresh = {},
                 const RowShares* rows = nullptr);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// m: half the length of the pulse in water, c tau / 2, or of a chirp after compression, c / (2 B).
double range_resolution(const Shot& shot, double sound_speed);

}  // namespace echoloop
