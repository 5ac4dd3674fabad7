// libFuzzer target: the scene reader must refuse any bytes with a SceneFault, never crash, hang or exhaust
// memory.
#include <cstdint>
#include <span>

#include "render/scene/fault.h"
#include "render/scene/reader.h"
#include "tests/render/gltf_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const echoloop::test::TemporaryFolder directory;
    static const echoloop::SceneFolder folder(directory.write("scene.gltf", "{}"));
    try {
        echoloop::read_scene(std::span(data, size), folder);
    } catch (const echoloop::SceneFault&) {
        return 0;
    }
    return 0;
}
