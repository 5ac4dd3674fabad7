// libFuzzer target: the scene reader must refuse any bytes with a SceneFault, never crash, hang or exhaust
// memory.
#include <cstdint>
#include <span>

#include "render/scene/fault.h"
#include "render/scene/reader.h"
#include "render/scene/scene.h"
#include "tests/render/gltf_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const echoloop::test::TemporaryFolder directory;
    static const echoloop::SceneFolder folder(directory.write("scene.gltf", "{}"));
    try {
        const auto scene =
            echoloop::read_scene({data, data + size}, folder, {.movable = {"a"}, .animations = true});
        for (const double seconds : {0.0, 0.5, 7.0, 1e5})
            echoloop::mover_poses(scene->movers(), seconds, echoloop::Playback::loop);
    } catch (const echoloop::SceneFault&) {
        return 0;
    }
    return 0;
}
