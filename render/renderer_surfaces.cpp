#include "render/renderer_surfaces.h"

#include "render/gl/egl.h"

namespace echoloop {

SurfaceFinder::SurfaceFinder(std::shared_ptr<const Scene> scene, const RendererOptions& options,
                             std::shared_ptr<Workers> workers)
    : scene_(std::move(scene)), choose_(options.sampler == "auto"), threads_(options.drawing_threads) {
    const bool large =
        choose_ && options.context == "auto" && scene_->triangles() >= least_triangles_for_native;
    if (options.sampler == "rays") {
        rays_.emplace(scene_, threads_);
    } else if (options.sampler == "native" || (large && !gl::may_have_gpu())) {
        native_.emplace(scene_, threads_, workers);
    } else {
        crew_.emplace([context = options.context] { return gl::make_context(context); }, scene_, threads_,
                      workers);
        if (!large || crew_->drawer().context().kind() == gl::gpu_kind) return;
        crew_.reset();
        native_.emplace(scene_, threads_, workers);
    }
}

/// Bent rays of a single beam are dear to draw, and few are worth splitting up a large scene for: where the
/// choice is ours they are followed.
const gl::DrawProfile& SurfaceFinder::find(const Picture& picture, const gl::Outlook& outlook, bool single,
                                           std::vector<Pixel>& pixels) {
    if (native_ && single && outlook.rays && choose_ && !rays_) rays_.emplace(scene_, threads_);
    if (rays_ && (!native_ || (single && outlook.rays)))
        return rays_->sample(picture, outlook, pixels), rays_->profile();
    if (native_) return native_->sample(picture, outlook, pixels), native_->profile();
    return crew_->draw(picture, outlook, pixels), crew_->profile();
}

std::string SurfaceFinder::description() const {
    if (native_) return raster::RasterSampler::description();
    if (rays_) return rays::RaySampler::description();
    return crew_->drawer().description();
}

}  // namespace echoloop
