// Draws one view of a scene after the other. For each sample it finds the nearest triangle, and only then
// what that looks like.
#pragma once

#include <span>
#include <vector>

#include "render/gl/split_scene.h"
#include "render/raster/node_triangles.h"
#include "render/rays/ray_packet.h"

namespace echoloop::raster {

/// What all views of a picture have in common.
struct Painting {
    const Scene& scene;
    SampleOffsets offset;
    const RayTable* rays = nullptr;         ///< null: they are straight
    const gl::SplitScene* split = nullptr;  ///< in place of what has long edges, where they bend
    std::size_t samples = 0;                ///< of a line of the image
    Pixel* image = nullptr;
};

class ViewPainter {
  public:
    /// Into the view's lines of the image.
    void paint(const Painting& painting, const gl::SeenView& seen);

  private:
    /// What may be the nearest somewhere.
    struct Shown {
        /// Of the three shares and the inverse of TrianglePlanes: their slopes along x, those along y, and
        /// what they are at 0.
        std::array<float, 12> numbers;
        std::array<const SceneVertex*, 3> vertices;
        std::int32_t part;  ///< in places_
        float side;         ///< -1: we see its front; 1: its back
    };

    void start(const View& view, SampleOffsets offset);
    void paint_triangles(std::span<const SceneVertex> vertices, const Painting& painting, bool double_sided);
    void add_shown(std::span<const SceneVertex> vertices, bool bent);
    void write(const Painting& painting, const View& view);
    void look(std::size_t at, float x, const float* y, std::size_t count, rays::HitArrays& hits,
              float* bow) const;
    void look_at(std::size_t number, float x, float y, std::size_t to, rays::HitArrays& hits,
                 float* bow) const;
    void look_at_many(std::size_t number, float x, const float* y, std::size_t first, std::size_t last,
                      rays::HitArrays& hits, float* bow) const;
    /// Into the view's axes, from those of a part.
    Four turned(Four normal, std::int32_t part) const;

    SampleGrid grid_{};
    std::size_t stride_ = 0;            ///< of a line in the arrays below
    std::vector<float> x_, y_;          ///< of every line, and of every sample and some beyond
    std::vector<float> inverse_;        ///< 1 over the distance along the axis; 0: nothing is there
    std::vector<std::int32_t> number_;  ///< in shown_, of what is nearest
    std::vector<Shown> shown_;
    std::vector<Four> bows_;  ///< SeenCorners::bow() at the corners of shown_; empty where rays are straight
    std::vector<PartPlace> places_;
    std::vector<std::array<std::array<float, 4>, 3>>
        columns_;  ///< the same: turn normals into the view's axes
    SeenCorners corners_;
    NodeTriangles triangles_;
};

}  // namespace echoloop::raster
