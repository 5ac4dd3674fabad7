// How strongly a surface scatters back at a grazing angle: Lambert's law or a measured curve, and the lobe of
// its facets. Pure functions of angle; knows no scene file and no pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "render/scene/scene.h"

namespace echoloop {

/// Backscattering strength Sb in dB re 1 m^2 per m^2. `grazing`: rad, 0..pi/2.
///
/// Lambert: mu_db + 20 log10 sin g (Urick, Principles of Underwater Sound, 1983, chapter 8). A curve is
/// linear in dB over the angle, constant beyond its last point, and falls as sin^2 g below its first.
double backscatter_db(const Material& material, double grazing);

/// What a face sends back as its mirror's image in incoherent facets, 1 (linear) re 1 m^2 per m^2: the
/// high-frequency Kirchhoff approximation for Gaussian slopes (Barrick, IEEE Trans. AP-16 (1968) 449;
/// McDaniel & Gorman, JASA 73 (1983) 1476),
///     (1 - e^-G) V^2 / (8 pi s^2 cos^4 i) exp(-tan^2 i / 2 s^2), G = (2 k h cos i)^2 (Eckart 1953),
/// with s^2 = slope^2 + mesh_slope^2; the rest, e^-G, is the coherent echo of a flat face. A curved surface
/// (mesh_slope > 0) has none, so e^-G is 0. 0 for a measured curve, which holds its own lobe. Over a plane it
/// integrates to V^2 / 4 H^2 for every s; s is at least 0.02, so that pixels do not miss it. `wavenumber`:
/// rad/m; `cosine` of incidence, 0..1.
double facet_lobe(const Material& material, double wavenumber, double cosine);

/// sigma(i) / cos(i) of a material over the cosine of incidence, 0..1, with sigma = 10^(Sb / 10): times the
/// solid angle and R^-2 it is the echo of a pixel. Exact for Lambert's law (mu cos i), else linear between
/// its points.
class StrengthTable {
  public:
    static constexpr std::size_t cells = 4096;  ///< the last is 1.3 deg wide: lobes are at least as wide

    /// With the facets' lobe for a `wavenumber` in rad/m; 0: without. Throws std::invalid_argument for a
    /// curve whose angles do not ascend.
    explicit StrengthTable(const Material& material, double wavenumber = 0);

    /// Of any law: `strength` is sigma over the cosine, which is above 0.
    explicit StrengthTable(const std::function<double(double cosine)>& strength);

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
