// Scenes that are good: containers, axes, transforms, materials, normals and chunks.
#include "render/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "render/scene/materials.h"
#include "tests/render/gltf_files.h"
#include "tests/render/meshes.h"

namespace echoloop {
namespace {

using nlohmann::json;

class SceneFile : public testing::Test {
  protected:
    SceneFile() { folder.write("mesh.bin", test::rectangle_bytes()); }
    std::shared_ptr<const Scene> load(const json& changed) const {
        return Scene::load(folder.write("scene.gltf", changed.dump()));
    }
    test::TemporaryFolder folder;
    json document = test::rectangle_document();
};

void expect_bounds(const Scene& scene, std::array<float, 3> low, std::array<float, 3> high) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(scene.bounds().min[axis], low[axis], 1e-6) << axis;
        EXPECT_NEAR(scene.bounds().max[axis], high[axis], 1e-6) << axis;
    }
}

/// World normal of the first triangle, from its winding.
Vec3 winding(const Scene& scene) {
    const auto at = [&](std::size_t i) {
        const auto& p = scene.vertices()[scene.chunks()[0].first_vertex + scene.indices()[i]].position;
        return Vec3{p[0], p[1], p[2]};
    };
    const Vec3 n = cross(at(1) - at(0), at(2) - at(0));
    return (1 / norm(n)) * n;
}

// glTF (x, y, z) is ENU (x, -z, y): up is y, and what faces +z in glTF faces south (-y).
TEST_F(SceneFile, IsTurnedFromYUpToEnu) {
    const auto scene = load(document);
    EXPECT_EQ(scene->triangles(), 2U);
    expect_bounds(*scene, {-1, 0, 0}, {1, 0, 1});
    EXPECT_EQ(winding(*scene), (Vec3{0, -1, 0}));
    EXPECT_NEAR(scene->vertices()[0].normal[1], -1, 1e-6);
    EXPECT_EQ(scene->objects()[0], "panel");
}

TEST_F(SceneFile, AllThreeContainersAreTheSame) {
    const auto glb = Scene::load(folder.write("scene.glb", test::as_glb(document, test::rectangle_bytes())));
    const auto data_uri = load(test::embedded(document, test::rectangle_bytes()));
    const auto file = load(document);
    for (const auto& scene : {glb, data_uri}) {
        ASSERT_EQ(scene->vertices().size(), file->vertices().size());
        for (std::size_t i = 0; i < file->vertices().size(); ++i)
            EXPECT_EQ(scene->vertices()[i].position, file->vertices()[i].position);
    }
}

TEST_F(SceneFile, NodesAreBakedIntoTheWorld) {
    document["nodes"] = json::parse(
        R"([{"translation": [10, 0, 0], "children": [1], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476]},
        {"name": "child", "mesh": 0, "scale": [1, 3, 1]}])");
    // Turned by 90 degrees about glTF's y, the panel runs along glTF's z, which is ENU's -y, and faces glTF's
    // +x.
    const auto scene = load(document);
    expect_bounds(*scene, {10, -1, 0}, {10, 1, 3});
    EXPECT_NEAR(winding(*scene).x, 1, 1e-6);
    EXPECT_EQ(scene->objects()[0], "child");
}

TEST_F(SceneFile, MatrixIsColumnMajor) {
    document["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -7, 1};
    expect_bounds(*load(document), {-2, 7, 0}, {2, 7, 1});
}

TEST_F(SceneFile, MirrorKeepsTheOutside) {
    document["nodes"][0]["scale"] = {-1, 1, 1};
    const auto scene = load(document);
    EXPECT_EQ(winding(*scene), (Vec3{0, -1, 0}));  // still the side that faces south
}

TEST_F(SceneFile, SameMeshTwice) {
    document["nodes"].push_back({{"mesh", 0}, {"translation", {0, 5, 0}}});
    document["scenes"][0]["nodes"] = {0, 1};
    const auto scene = load(document);
    EXPECT_EQ(scene->triangles(), 4U);
    EXPECT_EQ(scene->objects()[1], "node1");
}

TEST_F(SceneFile, WithoutScenesAllRootsAreTaken) {
    document.erase("scenes");
    document.erase("scene");
    EXPECT_EQ(load(document)->triangles(), 2U);
}

TEST_F(SceneFile, MaterialsByNameAndByExtras) {
    EXPECT_NEAR(load(document)->materials()[0].mu_db, *mu_db_by_name("steel"), 1e-9);
    EXPECT_FALSE(load(document)->materials()[0].double_sided);
    document["materials"][0] = {{"name", "whatever"}, {"doubleSided", true}};
    EXPECT_EQ(load(document)->materials()[0].mu_db, -27);
    EXPECT_TRUE(load(document)->materials()[0].double_sided);
    document["materials"][0]["extras"]["sonar"]["material"] = "Mud";
    EXPECT_NEAR(load(document)->materials()[0].mu_db, *mu_db_by_name("mud"), 1e-9);
    document["materials"][0]["extras"]["sonar"] = {{"mu_db", -35.5}};
    EXPECT_EQ(load(document)->materials()[0].mu_db, -35.5);
    document["materials"][0]["extras"] = {{"other program", 1}};
    EXPECT_EQ(load(document)->materials()[0].mu_db, -27);
    document["meshes"][0]["primitives"][0].erase("material");
    EXPECT_EQ(load(document)->materials()[0].mu_db, -27);
}

TEST_F(SceneFile, MaySayWhereItLiesOnTheEarth) {
    EXPECT_FALSE(load(document)->origin());
    document["scenes"][0]["extras"] = {{"other program", 1}};
    EXPECT_FALSE(load(document)->origin());
    document["scenes"][0]["extras"]["sonar"]["origin"] = {{"latitude", 59.4}, {"longitude", -10.5}};
    EXPECT_EQ(load(document)->origin(), (GeoPlace{59.4, -10.5, 0}));
    document["scenes"][0]["extras"]["sonar"]["origin"]["height"] = 3.5;
    EXPECT_EQ(load(document)->origin(), (GeoPlace{59.4, -10.5, 3.5}));
}

TEST_F(SceneFile, MaterialsReflectAsTheirNamesSay) {
    EXPECT_NEAR(load(document)->materials()[0].reflection, 0.938, 0.001);  // steel
    document["materials"][0] = {{"extras", {{"sonar", {{"material", "mud"}, {"roughness", 0.01}}}}}};
    EXPECT_NEAR(load(document)->materials()[0].reflection, 0.2, 1e-9);  // |V| of 1.5 x 1.0
    EXPECT_EQ(load(document)->materials()[0].roughness, 0.01);
    document["materials"][0]["extras"]["sonar"]["reflection"] = -1;
    // Less the little that mud scatters: V^2 + pi mu is 1.
    const double scattered = std::numbers::pi * std::pow(10, *mu_db_by_name("mud") / 10);
    EXPECT_NEAR(load(document)->materials()[0].reflection, -std::sqrt(1 - scattered), 1e-9);
    EXPECT_NEAR(load(document)->materials()[0].mu_db, *mu_db_by_name("mud"), 1e-9);
    document["meshes"][0]["primitives"][0].erase("material");
    EXPECT_NEAR(load(document)->materials()[0].reflection, 0.353, 0.001);  // sand
}

TEST_F(SceneFile, MaterialsWithMeasuredCurves) {
    auto& sonar = document["materials"][0]["extras"]["sonar"];
    sonar = {{"backscatter_db", {{5, -45.5}, {90, -12}}}};
    const std::vector<BackscatterPoint> expected{{5, -45.5}, {90, -12}};
    EXPECT_EQ(load(document)->materials()[0].backscatter, expected);
    sonar["seabed"] = "mud-200khz";
    EXPECT_EQ(load(document)->materials()[0].backscatter, expected);  // the curve wins
    sonar.erase("backscatter_db");
    EXPECT_GT(load(document)->materials()[0].backscatter.size(), 10U);
    EXPECT_NEAR(load(document)->materials()[0].reflection, 0.2, 1e-9);
}

// What a sonar does not need may be missing or broken.
TEST_F(SceneFile, ImagesAndAnimationsAreNotRead) {
    document["images"] = {{{"uri", "../../etc/passwd"}}, {{"bufferView", 99}}};
    document["textures"] = {{{"source", 5}}};
    document["animations"] = "none";
    document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    EXPECT_EQ(load(document)->triangles(), 2U);
}

TEST_F(SceneFile, StripsAndFansAndListsWithoutIndices) {
    auto& primitive = document["meshes"][0]["primitives"][0];
    primitive.erase("indices");
    primitive["mode"] = 6;  // the four corners as a fan
    EXPECT_EQ(load(document)->triangles(), 2U);
    EXPECT_EQ(winding(*load(document)), (Vec3{0, -1, 0}));
    primitive["mode"] = 5;
    EXPECT_EQ(load(document)->triangles(), 2U);
    primitive["mode"] = 4;
    EXPECT_EQ(load(document)->triangles(), 1U);
}

TEST_F(SceneFile, LinksInsideTheFolderAreFollowed) {
    std::filesystem::create_symlink(folder / "mesh.bin", folder / "link.bin");
    document["buffers"][0]["uri"] = "link.bin";
    EXPECT_EQ(load(document)->triangles(), 2U);
    folder.write("with space.bin", test::rectangle_bytes());
    document["buffers"][0]["uri"] = "with%20space.bin";
    EXPECT_EQ(load(document)->triangles(), 2U);
}

TEST(MaterialNames, WordsInAnySpelling) {
    for (const char* name : {"sand", "SAND", "Sand_02", "wetSand", "mat.sandy", "01-sand"})
        EXPECT_NEAR(mu_db_by_name(name).value(), -27, 1e-9) << name;
    for (const char* name : {"", "sandwich", "thousand", "blue", "0815"})
        EXPECT_FALSE(mu_db_by_name(name)) << name;
}

TEST(MaterialNames, HarderIsLouderAndNoneExceedsTheCeiling) {
    double before = -100;
    for (const char* name : {"mud", "silt", "sand", "gravel", "concrete", "rock", "steel"}) {
        EXPECT_GT(mu_db_by_name(name).value(), before) << name;
        before = mu_db_by_name(name).value();
    }
    for (const auto& name : known_materials()) EXPECT_LT(mu_db_by_name(name).value(), ceiling_mu_db);
    // Basalt against sand: |V| = 0.8086 and 0.3528.
    EXPECT_NEAR(*mu_db_by_name("basalt") - *mu_db_by_name("sand"), 20 * std::log10(0.80861 / 0.35275), 0.01);
}

TEST(SceneChunks, AreSmallCompactAndComplete) {
    const auto scene = test::scene_of({test::floor_at(-5, 50, 100), test::box("box", {0, 0, 0}, {1, 1, 1})});
    EXPECT_EQ(scene->triangles(), 20'012U);
    std::size_t triangles = 0;
    for (const SceneChunk& chunk : scene->chunks()) {
        triangles += chunk.indices / 3;
        EXPECT_LE(chunk.indices / 3, 256U);
        if (scene->objects()[chunk.object] != "floor") continue;
        EXPECT_GE(chunk.indices / 3, 64U);
        EXPECT_LE(chunk.bounds.max[0] - chunk.bounds.min[0], 13);
        for (std::uint32_t i = 0; i < chunk.indices; ++i)
            ASSERT_LT(scene->indices()[chunk.first_index + i], chunk.vertices);
    }
    EXPECT_EQ(triangles, scene->triangles());
}

TEST(SceneNormals, AreMadeWhereTheyLackOrFaceTheWrongWay) {
    Mesh wall = test::wall_at(10, 1, -1, 1);
    EXPECT_NEAR(test::scene_of({wall})->vertices()[0].normal[0], -1, 1e-6);
    wall.normals.assign(4, {1, 0, 0});  // against the winding
    EXPECT_NEAR(test::scene_of({wall})->vertices()[0].normal[0], -1, 1e-6);
    wall.normals.assign(4, {-0.8, 0.6, 0});
    EXPECT_NEAR(test::scene_of({wall})->vertices()[0].normal[1], 0.6, 1e-6);
}

}  // namespace
}  // namespace echoloop
