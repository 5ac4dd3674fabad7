// libFuzzer target: a survey of a stranger's must be refused with a Fault or become triangles. The first byte
// says what the command line says of it, the rest is the file; its driver is found out by what is in it.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tools/import/fault.h"
#include "tools/import/glb.h"
#include "tools/import/terrain/terrain.h"

namespace {

namespace fs = std::filesystem;

/// Made once; gone with the process.
struct Folder {
    Folder() {
        std::string name = (fs::temp_directory_path() / "echoloop-grid-fuzz-XXXXXX").string();
        path = ::mkdtemp(name.data());
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    fs::path path;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::worlds;
    static const Folder folder;
    if (size < 2) return 0;
    static constexpr const char* endings[] = {"xyz", "asc", "grd", "nc"};  // .xyz is known by its name only
    const std::uint8_t choices = data[0];
    const fs::path file = folder.path / (std::string("bottom.") + endings[choices % 4]);
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
    TerrainOptions options{.triangles = 5000};
    options.survey.local = (choices & 4) != 0;
    options.survey.local_if_unknown = (choices & 8) != 0;
    if (choices & 16) options.survey.units = "ft";
    if (choices & 32) options.survey.positive = "down";
    if (choices & 64) options.origin = Origin{59.4, 10.5, 0};
    World world;
    try {
        add_terrain(world, file, options);
    } catch (const Fault&) {
        return 0;
    }
    std::ostringstream out;
    write_glb(world, out);
    return 0;
}
