// Turns a scene, a shot and a pose into an echogram of absolute levels. Owns a GL context and therefore
// belongs to the thread that made it; never normalises, adds no noise and keeps no clock.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "render/acoustics/chain.h"
#include "render/echogram.h"
#include "render/effects.h"
#include "render/paths/paths.h"
#include "render/scene/scene.h"
#include "render/situation.h"
#include "render/water.h"

namespace echoloop {

class PlanCache;

struct RendererOptions {
    EchoRule rule = EchoRule::radiometric;
    double columns_per_beam = 1.5;  ///< rendered bearings across one beam, 1..64
    double pixel_density = 1;       ///< factor on the number of pixels, 0.1..64
    /// Move the sample inside its pixel: from ping to ping (by Shot::ping) in the main lobes, so that the
    /// mean over pings has no error from the pixel grid; around them by resting_offset().
    bool jitter = true;
    std::string context = "auto";  ///< GL context: "auto", "osmesa", "egl-surfaceless" or "egl-device"
    /// What finds the surfaces: "raster" (OpenGL), "native" (our own rasteriser), "rays" (Embree), or "auto":
    /// raster where somebody names a context or there is a GPU, else native, which is quicker than a software
    /// OpenGL in every scene of the bench (render/README.md).
    std::string sampler = "auto";
    std::size_t drawing_threads =
        1;  ///< that share a picture where the context allows it; the pixels are the same
    std::shared_ptr<PlanCache> plans{};  ///< shared by several renderers; empty: one of its own
    Effects effects{};                   ///< of EchoRule::radiometric; the paper's rule knows none
    SpeckleOptions speckle{};
    /// For multipath: rippled by a light air to begin with, which leaves no mirror at sonar frequencies;
    /// empty: none near.
    std::optional<WaterSurface> surface = WaterSurface{0, 0.01};
};

/// Where the time of the last render() went, and what it drew. Where threads share a ping, paths are traced
/// while surfaces are found, so that the parts add up to more than the whole.
struct RenderProfile {
    double cull = 0, draw = 0, read_back = 0, bins = 0, paths = 0, acoustics = 0;  ///< s of wall time
    std::size_t triangles = 0, chunks = 0, pixels = 0;                             ///< drawn
};

/// The image of Cerqueira et al. 2016 before it becomes an echogram: row-major, the highest elevation first,
/// bearings ascending from left to right. Columns have equal widths in tan(bearing) within one view, not
/// equal angles.
struct ChannelImage {
    std::size_t width = 0, height = 0;
    std::vector<float> intensity;  ///< cos(incidence), 0..1; 0 where there is nothing
    std::vector<float> range;      ///< m, Euclidean; NaN where there is nothing
    std::vector<float> bearing;    ///< rad, relative to Shot::pan, clockwise positive
};

class Renderer {
  public:
    /// Creates the GL context, where one is needed, and uploads the scene. Throws std::invalid_argument for
    /// bad water or options and std::runtime_error, with the package to install, when no GL can be had.
    Renderer(std::shared_ptr<const Scene> scene, Water water, RendererOptions options = {});
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// One ping. `situation` may be the sonar's pose alone. Throws std::invalid_argument, naming the member,
    /// for a shot or pose that is not finite, not ordered or too large (see validate(const Shot&)), and
    /// std::logic_error on a thread other than the constructor's.
    Echogram render(const Shot& shot, const Situation& situation);

    /// The three channels behind the same ping of one array. Throws as render().
    ChannelImage render_channels(const Shot& shot, const Situation& situation);

    const RenderProfile& profile() const;  ///< of the last ping
    const Scene& scene() const;
    const Water& water() const;
    double sound_speed() const;  ///< m/s, of the water
    /// For example "OSMesa, 4.5 (Core Profile) Mesa 22.3.6, llvmpipe", "own rasteriser" or "Embree 3.13.5".
    std::string context_description() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// Throws std::invalid_argument naming the member and its limits unless: 1..4096 bearings, strictly ascending
/// within
/// +-pi; beam_width 0.01..120 deg; bearings and beam_width span at most 360 deg; fan_height 0.01..120 deg;
/// |pan| <= 2 pi and |tilt| <= pi/2; 1..65536 bins and at most 16 Mi values in all; first_bin_time 0..60 s,
/// bin_interval 100 ns..10 s, a window that ends within 60 s; frequency 1 kHz..10 MHz; source_level within
/// +-300 dB; pulse_length and bandwidth not negative; no sides, or one for each bearing and no rows.
void validate(const Shot& shot);

}  // namespace echoloop
