#include "render/scene/scene_origin.h"

#include "render/scene/document.h"
#include "render/scene/fault.h"
#include "render/scene/limits.h"

namespace echoloop {

std::optional<GeoPlace> scene_origin(const std::filesystem::path& file) try {
    const SceneFolder folder(file);
    const auto bytes = folder.read_scene(scene_limits::json_bytes + scene_limits::buffer_bytes);
    return check_document(open_container(bytes), folder).origin;
} catch (const SceneFault& fault) {
    throw SceneError(file.string(), fault.place, fault.reason, fault.remedy);
}

}  // namespace echoloop
