// How a picture becomes received power per beam and bin: by the beams of a fan, or by rows of them (grid/).
// Plain CPU code, deterministic; knows no GL, no noise and no pulse: those act on its result.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/acoustics/chain.h"
#include "render/fan/binning.h"

namespace echoloop {

class Workers;

/// What some surfaces send straight back, in memory of the one who summed it: until it sums again.
struct WantedPower {
    struct Stretch {
        std::size_t begin, end;
    };
    std::span<const float> values;       ///< beams x bins, beam-major
    std::span<const Stretch> stretches;  ///< of `values`, ascending; all others are 0
};

/// Owns the scratch memory of one renderer; `BinningInput::plan` is always one that its own plan() made.
class Summing {
  public:
    virtual ~Summing() = default;

    virtual std::shared_ptr<const FanPlan> plan(const FanGeometry& geometry,
                                                const PlanDensity& density) const = 0;

    /// Fills `values` (beams x bins, beam-major). For EchoRule::radiometric the sum over pixels of
    /// SL S(i) w R^-2 exp(-4 a R), with w the solid angle times the pattern and S the backscattering strength
    /// over cos(i): mu cos(i) for Lambert. For EchoRule::cerqueira2016 the mean of cerqueira_sigmoid(cos(i)).
    /// Power before the first or beyond the last bin is dropped, never wrapped or piled up. `fresh`: beams x
    /// RangeSteps, what of it the water sends back, which is new at every ping: the mean power of a bin in
    /// each step; nothing where in.water is null.
    virtual void sum(const BinningInput& in, std::vector<float>& values, std::vector<float>& fresh) = 0;

    /// Sums in the same way, radiometrically, what the surfaces in `in.wanted` send straight back. `lines`:
    /// those of the image that show such a surface, ascending.
    virtual WantedPower sum_wanted(const BinningInput& in, std::span<const std::size_t> lines) = 0;

    /// Fills in the nearest range of every beam.
    virtual void find_nearest(const BinningInput& in, std::span<BeamTruth> truth) const = 0;

    /// What the beams hear of targets: one echo for each beam and target.
    virtual std::vector<PointEcho> points(const FanPlan& plan, std::span<const TargetEcho> targets) const = 0;
};

std::unique_ptr<Summing> make_fan_summing(Workers& workers);

}  // namespace echoloop
