// What is summed into beams and bins: a picture, and what an echo is worth.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "render/acoustics/scattering.h"
#include "render/echogram.h"
#include "render/fan/plan.h"
#include "render/paths/paths.h"
#include "render/pixel.h"

namespace echoloop {

class Patches;
struct PingMotion;  // render/fan/ping_motion.h
class Reverberation;

struct BinningInput {
    const FanPlan& plan;
    std::span<const Pixel> pixels;                   ///< plan.image_lines x plan.samples
    std::span<const StrengthTable* const> strength;  ///< per surface index
    SampleOffsets offset;                            ///< where in the pixels the ping sampled
    EchoRule rule;
    double first_range = 0;  ///< m, leading edge of bin 0
    double bin_length = 0;   ///< m
    std::size_t bins = 0;
    double source_power = 1;                 ///< uPa^2 at 1 m
    double absorption = 0;                   ///< Np/m
    bool spreading = true;                   ///< R^-4
    std::span<const PathEcho> paths;         ///< echoes by other ways, added to the lines that they arrive on
    std::span<const float> focus{};          ///< per pixel: power over that of straight rays; empty: 1
    std::span<const std::uint8_t> wanted{};  ///< per surface index, for Amount::wanted_echo: not 0, it counts
    const Reverberation* water = nullptr;    ///< null: it is silent
    const Patches* patches = nullptr;        ///< null: even materials
    const PingMotion* motion = nullptr;      ///< null: all stands still
    /// Echoes are multiplied by this power of their closing speed plus PingMotion::fastest, which is not
    /// negative; only direct ones count then. 0: they are powers.
    int moment = 0;
};

/// The focus of a line's pixels; null where rays are straight.
inline const float* focus_of(const BinningInput& in, const View& view, std::size_t line) {
    return in.focus.empty() ? nullptr : &in.focus[(view.first_line + line) * in.plan.samples];
}

/// The sigmoid of Cerqueira et al. 2016, equation 1, with the constants of the authors' code.
inline float cerqueira_sigmoid(float cosine) { return 1 / (1 + std::exp(-18 * (cosine - 2.0F / 3))); }

}  // namespace echoloop
