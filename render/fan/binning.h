// From rendered pixels to received power per beam and bin. Plain CPU code, deterministic; knows no GL, no noise and no
// pulse: those act on its result.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "render/acoustics/scattering.h"
#include "render/echogram.h"
#include "render/fan/plan.h"
#include "render/paths/paths.h"
#include "render/pixel.h"

namespace echoloop {

class Workers;

struct BinningInput {
    const FanPlan& plan;
    std::span<const Pixel> pixels;              ///< plan.image_lines x plan.samples
    std::span<const StrengthTable> strength;    ///< per surface index
    PixelOffset offset;                         ///< where in the pixels the ping sampled
    EchoRule rule;
    double first_range = 0;  ///< m, leading edge of bin 0
    double bin_length = 0;   ///< m
    std::size_t bins = 0;
    double source_power = 1;  ///< uPa^2 at 1 m
    double absorption = 0;    ///< Np/m
    bool spreading = true;    ///< R^-4
    std::span<const PathEcho> paths;  ///< echoes by other ways, added to the lines that they arrive on
    std::span<const std::uint8_t> wanted{};  ///< per surface index, for Amount::wanted_echo: not 0, it counts
};

class Binning {
  public:
    explicit Binning(Workers& workers);
    ~Binning();

    /// Fills `values` (beams x bins, beam-major). For EchoRule::radiometric the sum over pixels of
    /// SL S(i) w R^-2 exp(-4 a R), with w the solid angle times the pattern and S the backscattering strength over
    /// cos(i): mu cos(i) for Lambert. For EchoRule::cerqueira2016 the mean of cerqueira_sigmoid(cos(i)).
    /// Power before the first or beyond the last bin is dropped, never wrapped or piled up.
    void bin(const BinningInput& input, std::vector<float>& values);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// The sigmoid of Cerqueira et al. 2016, equation 1, with the constants of the authors' code.
float cerqueira_sigmoid(float cosine);

}  // namespace echoloop
