// Keeps a scene's triangles on the GL side and draws views of it into a float image. Knows nothing of beams
// or levels.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "render/gl/objects.h"
#include "render/gl/split_scene.h"
#include "render/pixel.h"
#include "render/recently_used.h"
#include "render/scene/scene.h"

namespace echoloop::gl {

/// Where rays bend: their table, and the patches in place of what has long edges.
struct Bending {
    std::shared_ptr<const RayTable> rays{};  ///< null: they are straight
    const SplitScene* split = nullptr;
};

class SceneDrawer {
  public:
    /// Makes the context current on this thread and uploads the scene. Throws std::runtime_error.
    SceneDrawer(std::unique_ptr<Context> context, std::shared_ptr<const Scene> scene);
    ~SceneDrawer();
    SceneDrawer(const SceneDrawer&) = delete;
    SceneDrawer& operator=(const SceneDrawer&) = delete;

    /// Draws these views of a picture and reads them back to where they are in its image, whose lines have so
    /// many samples. Returns the s of wall time that the reading took, which begins when the last pixel of a
    /// view is there.
    double draw(std::span<const SeenView* const> views, std::size_t samples, SampleOffsets offset,
                Pixel* image, const Bending& bending = {});

    const Scene& scene() const { return *scene_; }
    const Context& context() const { return *context_; }
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
    /// What it takes to draw with bent rays.
    struct BentDrawing;
    struct Uniforms {
        GLint view_from_world, eye, window, pixel;
        GLint up = -1, columns = -1, rows = -1;  ///< of bent rays only
    };

    void upload();
    void clear_target(int width, int height);
    void draw_view(const SeenView& seen, SampleOffsets offset);
    void draw_part(const View& view, const SeenNodes& part, SampleOffsets offset);
    void set_view(const View& view, const SeenNodes& part, SampleOffsets offset) const;
    void draw_patches(const View& view, const SeenNodes& part);
    void begin_straight();
    void begin_bent(const Bending& bending);
    Uniforms uniforms_of(const Program& program) const;
    void list(const SceneNode& node);
    void submit(const DrawList& list, bool double_sided) const;

    std::unique_ptr<Context> context_;
    std::shared_ptr<const Scene> scene_;
    Functions gl_;
    std::unique_ptr<Program> program_;
    Uniforms uniforms_{}, straight_uniforms_{};
    std::unique_ptr<BentDrawing> bent_;  ///< made when rays first bend
    bool bends_ = false;                 ///< the picture at hand
    std::unique_ptr<VertexArray> array_;
    std::unique_ptr<Buffer> vertices_, indices_;
    RecentlyUsed<SizedTarget> targets_{64 << 20};
    std::array<DrawList, 2> lists_;
};

}  // namespace echoloop::gl
