#include "render/gl/seen.h"

#include <algorithm>

namespace echoloop::gl {
namespace {

/// Finds what a view sees of the still scene and of every mover: nothing, where all of it would only hide.
void find_seen(const Scene& scene, const Outlook& outlook, SeenView& seen) {
    const ViewLimits limits = limits_of(*seen.view, outlook);
    bool wanted = false;
    const auto find = [&](SeenNodes& to, NodeRange range, const Pose& frame_from_fan, Vec3 up) {
        to.frame_from_fan = frame_from_fan, to.up = up;
        to.patches.clear();
        wanted |= find_visible(scene, range, *seen.view, frame_from_fan, limits, to.nodes, up);
    };
    find(seen.parts[0], {0, scene.still_nodes()}, outlook.world_from_fan, {0, 0, 1});
    // Seen from a mover's own frame nothing of it has moved: neither its buffers nor its bounds.
    for (std::size_t m = 0; m < outlook.movers.size(); ++m)
        find(seen.parts[m + 1], {scene.movers()[m].first_node, scene.movers()[m].last_node},
             inverse(outlook.movers[m]) * outlook.world_from_fan,
             rotate(conjugate(outlook.movers[m].orientation), {0, 0, 1}));
    seen.triangles = seen.chunks = 0;
    for (SeenNodes& part : seen.parts) {
        if (!wanted) part.nodes.clear();
        seen.chunks += part.nodes.size();
        for (const std::uint32_t node : part.nodes) seen.triangles += scene.nodes()[node].indices / 3;
    }
}

}  // namespace

double reach_of(const Outlook& outlook) {
    return outlook.end_range * (outlook.rays ? 1.01 + outlook.rays->most_stretch() : 1);
}

/// By how much a coarse stand-in may be off at most; in the root mean square it is a third of that. Pixels of
/// more than a degree show what side lobes hear: first of all the nearest bottom, whose first return shifts
/// with it, so near stand-ins are finer.
ViewLimits limits_of(const View& view, const Outlook& outlook) {
    const double pixel =
        std::max(view.line_width() * view.usual_width, view.sample_height() * view.usual_height);
    const bool background = outlook.begin_range > 0, coarse = pixel > deg_to_rad(1);
    return {.end_range = reach_of(outlook),
            .margin = pixel,
            .tolerance = (background ? 1.5
                          : coarse   ? 1.0
                                     : 0.4) *
                         pixel,
            .full_tolerance_range = coarse && !background ? full_tolerance_share * outlook.end_range : 0,
            .begin_range = outlook.begin_range,
            .hiding_tolerance = 4 * pixel,
            .rays = outlook.rays.get()};
}

void find_seen(const Scene& scene, const Picture& picture, const Outlook& outlook,
               std::vector<SeenView>& seen) {
    seen.resize(picture.views.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        seen[i].view = &picture.views[i];
        seen[i].parts.resize(1 + outlook.movers.size());
        find_seen(scene, outlook, seen[i]);
    }
}

}  // namespace echoloop::gl
