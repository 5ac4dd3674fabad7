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
    /// Where nobody names a context or a sampler, no OpenGL is made but a GPU's. Throws as Renderer's
    /// constructor.
    SurfaceFinder(const std::shared_ptr<const Scene>& scene, const RendererOptions& options,
                  std::shared_ptr<Workers> workers);

    /// Fills `pixels`. Returns what it drew, until the next call.
    const gl::DrawProfile& find(const Picture& picture, const gl::Outlook& outlook,
                                std::vector<Pixel>& pixels);

    /// As Renderer::context_description().
    std::string description() const;

  private:
    std::optional<gl::DrawingCrew> crew_;  ///< one of these
    std::optional<raster::RasterSampler> native_;
    std::optional<rays::RaySampler> rays_;
};

}  // namespace echoloop
