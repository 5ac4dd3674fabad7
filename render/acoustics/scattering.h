// How strongly a surface scatters back at a grazing angle: Lambert's law or a measured curve. Pure functions
// of angle; knows no scene file and no pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "render/scene/scene.h"

namespace echoloop {

/// Backscattering strength Sb in dB re 1 m^2 per m^2. `grazing`: rad, 0..pi/2.
///
/// Lambert: mu_db + 20 log10 sin g (Urick, Principles of Underwater Sound, 1983, chapter 8). A curve is
/// linear in dB over the angle, constant beyond its last point, and falls as sin^2 g below its first.
double backscatter_db(const Material& material, double grazing);

/// sigma(i) / cos(i) of a material over the cosine of incidence, 0..1, with sigma = 10^(Sb / 10): times the
/// solid angle and R^-2 it is the echo of a pixel. Exact for Lambert's law (mu cos i), else linear between
/// its points.
class StrengthTable {
  public:
    static constexpr std::size_t cells = 1024;

    /// Throws std::invalid_argument for a curve whose angles do not ascend.
    explicit StrengthTable(const Material& material);

    /// `cosine`: 0..1.
    float at(float cosine) const {
        const float place = cosine * static_cast<float>(cells);
        // 32 bits: before AVX-512 no instruction turns a float into 64 bits without a sign.
        const auto cell = std::min(static_cast<std::uint32_t>(place), static_cast<std::uint32_t>(cells - 1));
        const float share = place - static_cast<float>(cell);
        return values_[cell] + share * (values_[cell + 1] - values_[cell]);
    }
    /// The values at cosine k / cells, for loops that look up for themselves.
    const std::array<float, cells + 1>& values() const { return values_; }

  private:
    std::array<float, cells + 1> values_{};
};

}  // namespace echoloop
