// libFuzzer target: a world or a robot of a stranger's must be refused with a Fault or become a scene. The
// first byte says whether libsdformat, which is slow, reads what is left of it; the rest is the file.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tools/import/fault.h"
#include "tools/import/glb.h"
#include "tools/import/sdf_world.h"

namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& content) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
}

/// Made once; gone with the process. What worlds may name lies in it.
class Folder {
  public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "echoloop-world-fuzz-XXXXXX").string();
        path = fs::canonical(::mkdtemp(name.data()));
        write(path / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        write(path / "d.asc",
              "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\n-3 -4 -5\n-3 -4 -9999\n");
        write(path / "m/model.config", "<model><sdf>model.sdf</sdf></model>");
        write(path / "m/model.sdf",
              "<sdf version=\"1.7\"><model name=\"m\"><link name=\"l\"><visual name=\"v\">"
              "<geometry><box><size>1 1 1</size></box></geometry></visual></link></model>"
              "</sdf>");
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    fs::path path;
};

void convert(const Folder& folder, bool all) {
    using namespace echoloop::worlds;
    const fs::path file = folder.path / "world.sdf", scratch = folder.path / "scratch";
    fs::remove_all(scratch);
    fs::create_directory(scratch);
    const ModelPaths paths(file, {}, {});
    SdfChoices choices{.allow_missing = true};
    const Sources sources = collect_sources(file, paths, scratch, true);
    if (!all) return;
    World world;
    Report report;
    Stage stage;
    add_sdf(sources, paths, choices, world, report, stage, [](std::size_t, std::size_t) {});
    std::ostringstream out;
    try {
        write_glb(world, out);
    } catch (const std::runtime_error&) {  // no scene can hold it
    }
    report.text("scene.glb");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Folder folder;
    if (size < 2) return 0;
    write(folder.path / "world.sdf", {reinterpret_cast<const char*>(data) + 1, size - 1});
    try {
        convert(folder, data[0] % 2 == 1);
    } catch (const echoloop::worlds::Fault&) {
    }
    return 0;
}
