// One picture by several threads, each with a GL context of its own and its share of the views: a software
// rasteriser's time is the processors'. What is drawn does not depend on who draws it.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "render/gl/scene_drawer.h"

namespace echoloop::gl {

/// Where the time of a draw() went, and what it drew.
struct DrawProfile {
    /// s of wall time; read_back of who was slowest, draw until all were done and without that.
    double cull = 0, draw = 0, read_back = 0;
    std::size_t triangles = 0, chunks = 0, pixels = 0;  ///< drawn; a chunk in two views counts twice
};

class DrawingCrew {
  public:
    using MakeContext = std::function<std::unique_ptr<Context>()>;

    /// `threads`: the caller's included, on which draw() is to be called; the others are made for the first
    /// picture that is worth sharing. Contexts that cannot draw beside others get one. Throws
    /// std::runtime_error.
    DrawingCrew(MakeContext make, std::shared_ptr<const Scene> scene, std::size_t threads);
    ~DrawingCrew();

    /// Draws all views: picture.image_lines x picture.samples pixels. Throws std::runtime_error.
    void draw(const Picture& picture, const Outlook& outlook, std::vector<Pixel>& pixels);

    const DrawProfile& profile() const { return profile_; }  ///< of the last draw()
    const SceneDrawer& drawer() const { return own_; }       ///< for what all of them know

  private:
    class Helper;
    struct Share {
        std::vector<const SeenView*> views;
        double cost = 0;
    };

    void share_out();

    MakeContext make_;
    std::shared_ptr<const Scene> scene_;
    SceneDrawer own_;
    SplitScene split_;
    std::size_t threads_;
    std::vector<std::unique_ptr<Helper>> helpers_;
    std::vector<SeenView> seen_;
    std::vector<Share> shares_;  ///< the caller's first
    std::vector<std::size_t> order_;
    DrawProfile profile_;
};

}  // namespace echoloop::gl
