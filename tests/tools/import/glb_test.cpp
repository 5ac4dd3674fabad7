// What the writer of scene files makes, as the emulator's own strict reader finds it.
#include "tools/import/glb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "render/scene/scene.h"
#include "tests/render/gltf_files.h"

namespace echoloop::worlds {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// One triangle in the node's x-y plane, and a node that stands at (10, 20, -5) and is turned by 90 deg to
/// port.
World triangle() {
    World world;
    world.materials.push_back({.name = "hull", .acoustic = "steel"});
    world.meshes.push_back({"plate", {{{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {0, 1, 2}, 0}}});
    world.nodes.push_back(
        {.name = "wreck", .pose = {{10, 20, -5}, from_rpy(0, 0, deg_to_rad(90))}, .children = {1}});
    world.nodes.push_back({.name = "wreck::hull", .mesh = 0});
    world.roots = {0};
    return world;
}

std::shared_ptr<const Scene> read_back(const World& world) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("scene.glb", "");
    write_glb(world, file);
    return Scene::load(file, {.movable = {"wreck"}});
}

TEST(Glb, TheStrictReaderFindsNodesAndTheirPlaces) {
    const auto scene = read_back(triangle());
    EXPECT_EQ(scene->triangles(), 1U);
    EXPECT_THAT(scene->node_names(), ElementsAre("wreck", "wreck::hull"));
    EXPECT_THAT(scene->objects(), ElementsAre("wreck::hull"));
    // x 0..2 becomes y 20..22, y 0..1 becomes x 10..9
    EXPECT_NEAR(scene->bounds().min[0], 9, 1e-5);
    EXPECT_NEAR(scene->bounds().max[0], 10, 1e-5);
    EXPECT_NEAR(scene->bounds().min[1], 20, 1e-5);
    EXPECT_NEAR(scene->bounds().max[1], 22, 1e-5);
    EXPECT_NEAR(scene->bounds().min[2], -5, 1e-5);
    ASSERT_EQ(scene->movers().size(), 1U);
    EXPECT_NEAR(scene->movers()[0].rest.position.y, 20, 1e-9);
    EXPECT_NEAR(scene->movers()[0].rest.orientation.z, std::sqrt(0.5), 1e-9);
}

TEST(Glb, MaterialsKeepTheirAcoustics) {
    World world = triangle();
    world.materials[0] = {
        .name = "x", .figures = {{"mu_db", -20}, {"reflection", 0.5}}, .double_sided = true};
    const auto scene = read_back(world);
    ASSERT_EQ(scene->materials().size(), 1U);
    EXPECT_DOUBLE_EQ(scene->materials()[0].mu_db, -20);
    EXPECT_DOUBLE_EQ(scene->materials()[0].reflection, 0.5);
    EXPECT_TRUE(scene->materials()[0].double_sided);
}

TEST(Glb, SurfacesWithoutTrianglesAreLeftOut) {
    World world = triangle();
    world.meshes.insert(world.meshes.begin(), Mesh{"empty", {{}}});
    world.nodes[1].mesh = 1;
    world.nodes.push_back({.name = "nothing", .mesh = 0});
    world.roots.push_back(2);
    EXPECT_EQ(read_back(world)->triangles(), 1U);
}

TEST(Glb, RefusesWhatNoSceneCanHold) {
    World world = triangle();
    world.meshes[0].surfaces[0].positions[0].x = std::nan("");
    EXPECT_THAT([&] { read_back(world); }, ThrowsMessage<std::runtime_error>(HasSubstr("plate")));
    world = triangle();
    world.meshes[0].surfaces[0].indices[0] = 3;
    EXPECT_THAT([&] { read_back(world); }, ThrowsMessage<std::runtime_error>(HasSubstr("out of range")));
    EXPECT_THAT([&] { read_back({}); }, ThrowsMessage<std::runtime_error>(HasSubstr("holds nothing")));
}

TEST(Glb, ManyTrianglesAreRead) {
    World world = triangle();
    auto& surface = world.meshes[0].surfaces[0];
    surface = {};
    constexpr std::uint32_t side = 316;
    for (std::uint32_t i = 0; i <= side; ++i)
        for (std::uint32_t j = 0; j <= side; ++j)
            surface.positions.push_back({double(i), double(j), std::sin(i * 0.1) + std::cos(j * 0.13)});
    for (std::uint32_t i = 0; i < side; ++i)
        for (std::uint32_t j = 0; j < side; ++j) {
            const std::uint32_t a = i * (side + 1) + j, b = a + side + 1;
            surface.indices.insert(surface.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    EXPECT_EQ(read_back(world)->triangles(), 2U * side * side);
}

}  // namespace
}  // namespace echoloop::worlds
