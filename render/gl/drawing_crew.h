// One picture by several threads, each with a GL context of its own: a software rasteriser's time is the
// processors'. Who has drawn a view takes the next one. What is drawn does not depend on who draws it.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "render/gl/scene_drawer.h"
#include "render/workers.h"

namespace echoloop::gl {

/// Where the time of a draw() went, and what it drew.
struct DrawProfile {
    /// s of wall time; read_back a thread's share of it, draw until all were done and without that.
    double cull = 0, draw = 0, read_back = 0;
    std::size_t triangles = 0, chunks = 0, pixels = 0;  ///< drawn; a chunk in two views counts twice
};

class DrawingCrew {
  public:
    using MakeContext = std::function<std::unique_ptr<Context>()>;

    /// `threads`: the caller's included, on which draw() is to be called, of `workers`, or where that is null
    /// of its own. The others' contexts are made for the first picture that is worth sharing. Contexts that
    /// cannot draw beside others get one thread. Throws std::runtime_error.
    DrawingCrew(MakeContext make, std::shared_ptr<const Scene> scene, std::size_t threads,
                std::shared_ptr<Workers> workers = nullptr);
    ~DrawingCrew();

    /// Draws all views: picture.image_lines x picture.samples pixels. Throws std::runtime_error.
    void draw(const Picture& picture, const Outlook& outlook, std::vector<Pixel>& pixels);

    const DrawProfile& profile() const { return profile_; }  ///< of the last draw()
    const SceneDrawer& drawer() const { return own_; }       ///< for what all of them know

  private:
    bool find_order();
    SceneDrawer& drawer_of_thread();

    MakeContext make_;
    std::shared_ptr<const Scene> scene_;
    SceneDrawer own_;
    SplitScene split_;
    std::size_t threads_;
    std::shared_ptr<Workers> workers_;
    std::vector<std::unique_ptr<SceneDrawer>> drawers_;  ///< by Workers::number(); the caller's is own_
    std::vector<SeenView> seen_;
    std::vector<const SeenView*> order_;
    DrawProfile profile_;
};

}  // namespace echoloop::gl
