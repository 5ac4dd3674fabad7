#include "render/renderer_array.h"

#include "render/fan/resting_offset.h"

namespace echoloop {

Pose HeardArray::world_from_fan() const {
    return array.world_from_sonar * Pose{{}, sonar_from_fan(shot().pan, shot().tilt)};
}

Vec3 HeardArray::turning(const Situation& situation) const {
    return rotate(conjugate(world_from_fan().orientation) * situation.world_from_sonar.orientation,
                  situation.turning);
}

SampleOffsets HeardArray::offset(bool jitter) const {
    if (!jitter) return {};
    return {jitter_of(shot().ping),
            resting_offset(shot().random_key, array.world_from_sonar.position, shot().pan)};
}

std::vector<std::uint32_t> objects_of_surfaces(const Scene& scene) {
    std::vector<std::uint32_t> objects;
    for (const SceneSurface& surface : scene.surfaces()) objects.push_back(surface.object);
    return objects;
}

std::vector<std::uint32_t> movers_of_surfaces(const Scene& scene) {
    std::vector<std::uint32_t> movers, of_object(scene.objects().size());
    if (scene.movers().empty()) return movers;
    for (const SceneChunk& chunk : scene.chunks()) of_object[chunk.object] = chunk.mover;
    for (const SceneSurface& surface : scene.surfaces()) movers.push_back(of_object[surface.object]);
    return movers;
}

}  // namespace echoloop
