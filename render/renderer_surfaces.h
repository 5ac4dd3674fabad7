// What finds the surfaces of a picture: OpenGL, our own rasteriser or rays, and which of them a renderer
// takes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/gl/drawing_crew.h"
#include "render/raster/raster_sampler.h"
#include "render/rays/ray_sampler.h"
#include "render/renderer.h"

namespace echoloop {

class SurfaceFinder {
  public:
    /// In a large scene no OpenGL is made but a GPU's. Throws as Renderer's constructor.
    SurfaceFinder(std::shared_ptr<const Scene> scene, const RendererOptions& options,
                  std::shared_ptr<Workers> workers);

    /// Fills `pixels`. `single`: of one beam. Returns what it drew, until the next call.
    const gl::DrawProfile& find(const Picture& picture, const gl::Outlook& outlook, bool single,
                                std::vector<Pixel>& pixels);

    /// As Renderer::context_description().
    std::string description() const;

  private:
    std::shared_ptr<const Scene> scene_;
    bool choose_;  ///< the choice is ours
    std::size_t threads_;
    std::optional<gl::DrawingCrew> crew_;  ///< one of these, but for bent rays of single beams
    std::optional<raster::RasterSampler> native_;
    std::optional<rays::RaySampler> rays_;
};

}  // namespace echoloop
