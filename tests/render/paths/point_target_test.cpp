// Targets of declared strength in scene files: where they are, and what is refused.
#include <gtest/gtest.h>

#include "render/scene/scene.h"
#include "tests/render/gltf_files.h"
#include "tests/render/meshes.h"

namespace echoloop {
namespace {

using nlohmann::json;

class TargetFile : public testing::Test {
  protected:
    TargetFile() { folder.write("mesh.bin", test::rectangle_bytes()); }
    std::shared_ptr<const Scene> load() const {
        return Scene::load(folder.write("scene.gltf", document.dump()));
    }
    std::string fault() const {
        try {
            load();
        } catch (const SceneError& error) {
            return error.place() + ": " + error.remedy();
        }
        return "loads";
    }
    test::TemporaryFolder folder;
    json document = test::rectangle_document();
};

TEST_F(TargetFile, NodeWithoutMeshIsATargetInTheWorld) {
    document["nodes"].push_back({{"translation", {0, 0, -5}}, {"children", {2}}});
    document["nodes"].push_back({{"name", "ball"},
                                 {"translation", {1, 2, 3}},
                                 {"extras", {{"sonar", {{"target_strength_db", -20.5}}}}}});
    document["scenes"][0]["nodes"].push_back(1);
    const auto scene = load();
    ASSERT_EQ(scene->point_targets().size(), 1U);
    const PointTarget& target = scene->point_targets()[0];
    EXPECT_EQ(target.name, "ball");
    EXPECT_EQ(target.position, (Vec3{1, 2, 2}));  // glTF (1, 2, -2) is ENU (1, 2, 2)
    EXPECT_EQ(target.strength_db, -20.5);
    EXPECT_EQ(scene->triangles(), 2U);
}

TEST_F(TargetFile, NodeWithMeshKeepsItsMesh) {
    document["nodes"][0]["extras"]["sonar"]["target_strength_db"] = 3;
    const auto scene = load();
    EXPECT_EQ(scene->triangles(), 2U);
    ASSERT_EQ(scene->point_targets().size(), 1U);
    EXPECT_EQ(scene->point_targets()[0].strength_db, 3);
}

TEST_F(TargetFile, OtherExtrasAreNoTarget) {
    document["nodes"][0]["extras"] = {{"other program", 1}};
    EXPECT_TRUE(load()->point_targets().empty());
    document["nodes"][0]["extras"] = "text";
    EXPECT_TRUE(load()->point_targets().empty());
    document["nodes"][0]["extras"] = {{"sonar", json::object()}};
    EXPECT_TRUE(load()->point_targets().empty());
}

TEST_F(TargetFile, FaultsNameThePlaceAndARemedy) {
    json& sonar = document["nodes"][0]["extras"]["sonar"];
    sonar = {{"target_strenght_db", -20}};
    EXPECT_EQ(fault(), "nodes[0].extras.sonar.target_strenght_db: did you mean target_strength_db?");
    sonar = {{"mu_db", -20}};
    EXPECT_EQ(fault(),
              "nodes[0].extras.sonar.mu_db: the known key is target_strength_db; materials have others");
    sonar = {{"target_strength_db", "strong"}};
    EXPECT_EQ(fault().rfind("nodes[0].extras.sonar.target_strength_db", 0), 0U);
    sonar = {{"target_strength_db", 121}};
    EXPECT_EQ(fault().rfind("nodes[0].extras.sonar.target_strength_db", 0), 0U);
    sonar = 5;
    EXPECT_EQ(fault().rfind("nodes[0].extras.sonar:", 0), 0U);
}

TEST(Targets, ComeWithMeshesInCode) {
    const std::vector meshes{test::floor_at(-10, 5)};
    const PointTarget ball{"ball", {1, 2, 3}, -26};
    EXPECT_EQ(Scene::from_meshes(meshes, std::vector{ball}).get()->point_targets()[0].position,
              ball.position);
    PointTarget bad = ball;
    bad.position.x = 1e6;
    EXPECT_THROW(Scene::from_meshes(meshes, std::vector{bad}), SceneError);
    bad = ball;
    bad.strength_db = std::nan("");
    EXPECT_THROW(Scene::from_meshes(meshes, std::vector{bad}), SceneError);
    EXPECT_THROW(Scene::from_meshes(meshes, std::vector(1001, ball)), SceneError);
}

}  // namespace
}  // namespace echoloop
