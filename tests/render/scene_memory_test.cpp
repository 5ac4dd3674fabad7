// What a large scene takes while it is read: some users' machines have little more.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "render/scene/scene.h"
#include "tools/echoloop/bench/scenes.h"

namespace echoloop {
namespace {

/// MB: "VmHWM", the most that this process has had in memory, or "VmRSS", what it has now.
double megabytes(const std::string& what) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(what + ":")) return std::stod(line.substr(what.size() + 1)) * 1024 / 1e6;
    return 0;
}

/// Beside the caller's mesh of 72 MB. With room that is kept until the scene is finished it would be 271.
TEST(SceneMemory, TwoMillionTrianglesAreReadIn250Megabytes) {
    auto meshes = bench::scene_meshes("one2m");
    const double before = megabytes("VmRSS");
    if (!(std::ofstream("/proc/self/clear_refs") << 5 << std::flush))
        GTEST_SKIP() << "this kernel does not forget the most that a process had";
    const auto scene = Scene::from_own_meshes(std::move(meshes));
    EXPECT_GT(scene->triangles(), 2'000'000U);
    EXPECT_LT(megabytes("VmHWM") - before, 250);
}

}  // namespace
}  // namespace echoloop
