// Patches of a surface that scatter more or less than its mean: a log-normal factor for each pixel, of smooth
// noise that is fixed to the surface. Knows no levels.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/fan/pixel_rows.h"
#include "render/pose.h"
#include "render/ray_table.h"
#include "render/scene/scene.h"
#include "render/view.h"

namespace echoloop {

/// Smooth Gaussian noise of mean 0 and variance 1 that repeats after `size` cells along each axis, with the
/// correlation exp(-r^2 / length^2).
class PatchNoise {
  public:
    static constexpr int size = 64;
    static constexpr double length = 5;        ///< cells
    static constexpr float scale = 1 / 32.0F;  ///< of the values, which are stored in 8 bits
    static const PatchNoise& shared();
    /// `cell`: x + size (y + size z).
    std::int8_t at(std::uint32_t cell) const { return values_[cell]; }
    const std::int8_t* values() const { return values_.data(); }

  private:
    PatchNoise();
    std::vector<std::int8_t> values_;
};

/// mu(x) = mu0 exp(s n(x) - s^2 / 2), n the sum of noise at two scales and s = Material::patchiness / 4.343
/// dB, so the mean stays. Scintillation of the speckle is then 2 exp(s^2), for what is smaller than patches:
/// K distribution's 2 (1 + 1 / nu) (Jakeman & Pusey, IEEE Trans. AP 24 (1976) 806). A pixel larger than a
/// patch shows its mean: the noise of a scale falls with the pixel's width and depth on the surface. Noise is
/// keyed by the material's name and lies in the world, or in the frame of what moves.
class Patches {
  public:
    explicit Patches(const Scene& scene);
    /// Whether any surface has patches.
    bool any() const { return any_; }
    /// Where the fan is in the world, and the movers: world_from_object. `rays`: null where they are
    /// straight.
    void place(const Pose& world_from_fan, std::span<const Pose> movers,
               std::shared_ptr<const RayTable> rays = nullptr);

    /// Multiplies the weights of a line's pixels; false, and `out` as it was, where it shows no patches.
    bool weigh(const PixelRow& row, const View& view, std::size_t line, PixelOffset offset,
               const float* weight, std::vector<float>& out) const;

    static constexpr std::size_t lengths_count = 2;
    static constexpr double lengths[lengths_count] = {
        1.0, 0.25};  ///< m, correlation of the two scales; own choice
    /// The factor at a point of a surface of that material, for what is small: as weigh() finds it.
    static double factor(const Material& material, Vec3 point);

  private:
    struct Surface {
        float strength = 0;     ///< s
        std::uint32_t key = 0;  ///< added to the numbers of cells
        std::size_t frame = 0;  ///< 0: the world; else 1 + a mover
    };
    /// Samples first..last - 1 of a line, that show one surface.
    struct Stretch {
        std::size_t first, last;
        Surface surface;
    };
    /// Those of surfaces that have patches.
    void find_stretches(const float* surface, std::size_t count, std::vector<Stretch>& out) const;

    std::vector<Surface> surfaces_;
    /// At one scale the place of the fan, in cells, and its rotation to them.
    struct InCells {
        Vec3 eye;
        Quat from_fan;
    };
    using Frame = std::array<InCells, lengths_count>;
    std::vector<Frame> frames_;  ///< the world, then the movers
    Quat world_from_fan_;
    std::shared_ptr<const RayTable> rays_;
    bool any_ = false;
};

}  // namespace echoloop
