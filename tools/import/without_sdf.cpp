// Stands for sdf_world.cpp where there is no libsdformat: worlds are refused, surveys are read.
#include "emulator/contract/error.h"
#include "tools/import/fault.h"
#include "tools/import/sdf_world.h"

namespace echoloop::worlds {

void require_sdf(const std::filesystem::path& world) {
    throw StartError(Exit::unavailable,
                     printable(world.string()) +
                         ": this echoloop-import was built without libsdformat 12 and reads surveys only; "
                         "import the world where that can be had (Debian 12) and bring the .glb here");
}

void add_sdf(const Sources& sources, const ModelPaths&, SdfChoices&, World&, Report&, Stage&, const Told&) {
    require_sdf(sources.world);
}

}  // namespace echoloop::worlds
