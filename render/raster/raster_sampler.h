// Draws a picture without OpenGL, as gl::DrawingCrew does with it: the same nodes, samples and arithmetic,
// but in the processor's widest vectors, and nothing more is done than what becomes echoes needs. What is
// found does not depend on the number of threads.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "render/gl/drawing_crew.h"
#include "render/raster/view_painter.h"
#include "render/workers.h"

namespace echoloop::raster {

class RasterSampler {
  public:
    /// `threads`: the caller's included, of `workers`, or where that is null of its own.
    RasterSampler(std::shared_ptr<const Scene> scene, std::size_t threads,
                  std::shared_ptr<Workers> workers = nullptr);

    /// As gl::DrawingCrew::draw().
    void sample(const Picture& picture, const gl::Outlook& outlook, std::vector<Pixel>& pixels);

    const gl::DrawProfile& profile() const { return profile_; }  ///< of the last sample()
    static std::string description();

  private:
    std::unique_ptr<ViewPainter> take_painter();
    void give_back(std::unique_ptr<ViewPainter> painter);

    std::shared_ptr<const Scene> scene_;
    gl::SplitScene split_;
    std::size_t threads_;
    std::shared_ptr<Workers> workers_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<ViewPainter>> idle_;  ///< under mutex_
    std::vector<gl::SeenView> seen_;
    std::vector<const gl::SeenView*> order_;
    gl::DrawProfile profile_;
};

}  // namespace echoloop::raster
