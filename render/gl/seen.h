// What is to be drawn of a scene for one picture. Needs no GL.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/gl/culling.h"
#include "render/ray_table.h"
#include "render/scene/scene.h"
#include "render/view.h"

namespace echoloop::gl {

/// Of the split scene's vertices and indices.
struct SeenPatch {
    std::uint32_t first_vertex = 0, vertices = 0;
    std::uint32_t first_index = 0, indices = 0;
    bool double_sided = false;
};

/// What a view sees of the trees in one frame.
struct SeenNodes {
    Pose frame_from_fan;
    Vec3 up{0, 0, 1};  ///< the world's, in the frame
    std::vector<std::uint32_t> nodes;
    std::vector<SeenPatch> patches;  ///< where rays bend: instead of nodes with long edges
};

/// What is drawn of one view.
struct SeenView {
    const View* view = nullptr;
    std::vector<SeenNodes> parts;
    std::size_t triangles = 0, chunks = 0;
};

/// Where a fan is, and what moves: world_from_object of every mover.
struct Outlook {
    Pose world_from_fan;
    std::span<const Pose> movers{};
    double end_range = 0;  ///< m; surfaces beyond it may be missing
    /// m; of a faint background, else 0: nearer surfaces only hide what lies beyond and may be missing where
    /// nothing does, and all may be coarser.
    double begin_range = 0;
    SampleOffsets offset{};                  ///< move the sample point within every pixel
    std::shared_ptr<const RayTable> rays{};  ///< null: they are straight
    /// From nearly the same depth, for what pings at slightly other depths share; not null with `rays`.
    std::shared_ptr<const RayTable> rays_nearby{};
    double sag = 0;  ///< m, by which straight edges may stray from what bent rays make of them
};

/// m, within which surfaces are wanted.
double reach_of(const Outlook& outlook);

/// Of the end range, from where on what side lobes hear may be as coarse as its pixels.
inline constexpr double full_tolerance_share = 0.45;

/// What a view draws, and how coarse that may be.
ViewLimits limits_of(const View& view, const Outlook& outlook);

/// Fills `seen`, one for every view of the picture, whose places it keeps.
void find_seen(const Scene& scene, const Picture& picture, const Outlook& outlook,
               std::vector<SeenView>& seen);

}  // namespace echoloop::gl
