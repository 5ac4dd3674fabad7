// Keeps a scene's triangles on the GL side and draws views of it into a float image. Knows nothing of beams
// or levels.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "render/fan/binning.h"
#include "render/fan/culling.h"
#include "render/gl/objects.h"
#include "render/recently_used.h"
#include "render/scene/scene.h"

namespace echoloop::gl {

/// Where the time of a draw() went, and what it drew.
struct DrawProfile {
    double cull = 0, draw = 0, read_back = 0;  ///< s of wall time; draw ends when the last pixel is there
    std::size_t triangles = 0, chunks = 0, pixels = 0;  ///< drawn; a chunk in two views counts twice
};

class SceneDrawer {
  public:
    /// Makes the context current on this thread and uploads the scene. Throws std::runtime_error.
    SceneDrawer(std::unique_ptr<Context> context, std::shared_ptr<const Scene> scene);
    ~SceneDrawer();
    SceneDrawer(const SceneDrawer&) = delete;
    SceneDrawer& operator=(const SceneDrawer&) = delete;

    /// Draws all views of the plan and reads the image back: plan.image_lines x plan.samples pixels. Surfaces
    /// beyond `end_range` may be missing. `offset` moves the sample point within every pixel.
    /// `movers`: world_from_object of every one.
    void draw(const FanPlan& plan, const Pose& world_from_fan, std::span<const Pose> movers, double end_range,
              PixelOffset offset, std::vector<Pixel>& pixels);

    const DrawProfile& profile() const { return profile_; }  ///< of the last draw()

    /// Index into Scene::materials() of every surface number, which is Pixel::surface - 1.
    const std::vector<std::uint32_t>& material_of_surface() const { return material_of_surface_; }
    /// The same into Scene::objects().
    const std::vector<std::uint32_t>& object_of_surface() const { return object_of_surface_; }
    const Scene& scene() const { return *scene_; }
    std::string description() const;

  private:
    /// Ranges of indices that one call draws, single-sided and double-sided surfaces apart.
    struct DrawList {
        std::vector<GLsizei> counts;
        std::vector<const void*> offsets;
        std::vector<GLint> bases;
        void clear();
    };
    struct SizedTarget {
        int width, height;
        std::unique_ptr<FloatTarget> target;
    };
    struct Uniforms {
        GLint view_from_world, eye, window, pixel;
    };

    void upload();
    void bind_target(int width, int height);
    /// What a view sees of the trees in one frame.
    void draw_view(const View& view, NodeRange range, const Pose& frame_from_fan, double end_range, PixelOffset offset);
    void set_view(const View& view, const Pose& frame_from_fan, PixelOffset offset) const;
    void list(const SceneNode& node);
    void submit(const DrawList& list, bool double_sided) const;

    std::unique_ptr<Context> context_;
    std::shared_ptr<const Scene> scene_;
    Functions gl_;
    std::unique_ptr<Program> program_;
    Uniforms uniforms_{};
    std::unique_ptr<VertexArray> array_;
    std::unique_ptr<Buffer> vertices_, indices_;
    RecentlyUsed<SizedTarget> targets_{64 << 20};
    std::vector<std::uint32_t> material_of_surface_, object_of_surface_;
    std::vector<std::uint32_t> visible_;
    std::array<DrawList, 2> lists_;
    DrawProfile profile_;
};

}  // namespace echoloop::gl
