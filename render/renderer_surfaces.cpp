#include "render/renderer_surfaces.h"

#include <stdexcept>

#include "render/gl/egl.h"

namespace echoloop {

SurfaceFinder::SurfaceFinder(const std::shared_ptr<const Scene>& scene, const RendererOptions& options,
                             std::shared_ptr<Workers> workers) {
    const bool ours = options.sampler == "auto" && options.context == "auto";
    const std::size_t threads = options.drawing_threads;
    const auto make_crew = [&] {
        crew_.emplace([context = options.context] { return gl::make_context(context); }, scene, threads,
                      workers);
    };
    if (options.sampler == "rays") {
        rays_.emplace(scene, threads);
    } else if (options.sampler == "native" || (ours && !gl::may_have_gpu())) {
        native_.emplace(scene, threads, workers);
    } else if (!ours) {
        make_crew();
    } else {
        try {
            make_crew();
            if (crew_->drawer().context().kind() == gl::gpu_kind) return;
        } catch (const std::runtime_error&) {  // no OpenGL at all; `echoloop doctor` says why
        }
        crew_.reset();
        native_.emplace(scene, threads, workers);
    }
}

const gl::DrawProfile& SurfaceFinder::find(const Picture& picture, const gl::Outlook& outlook,
                                           std::vector<Pixel>& pixels) {
    if (rays_) return rays_->sample(picture, outlook, pixels), rays_->profile();
    if (native_) return native_->sample(picture, outlook, pixels), native_->profile();
    return crew_->draw(picture, outlook, pixels), crew_->profile();
}

std::string SurfaceFinder::description() const {
    if (native_) return raster::RasterSampler::description();
    if (rays_) return rays::RaySampler::description();
    return crew_->drawer().description();
}

}  // namespace echoloop
