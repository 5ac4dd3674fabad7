// Scenes that are bad: each gives a SceneError that names the place, and none crashes, hangs or reads
// elsewhere.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>
#include <limits>

#include "render/scene/scene.h"
#include "tests/render/gltf_files.h"
#include "tests/render/meshes.h"

namespace echoloop {
namespace {

using nlohmann::json;

/// The place in the error that loading `file` throws; fails the test when it loads.
std::string fault_of(const std::filesystem::path& file) {
    try {
        Scene::load(file);
    } catch (const SceneError& error) {
        EXPECT_EQ(error.file(), file.string());
        EXPECT_FALSE(error.reason().empty());
        EXPECT_FALSE(error.remedy().empty());
        EXPECT_NE(std::string(error.what()).find(error.place()), std::string::npos);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.place();
    }
    ADD_FAILURE() << file << " loads";
    return "loads";
}

struct Broken {
    const char* name;
    const char* place;
    std::function<void(json&)> damage;
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

class BrokenDocument : public testing::TestWithParam<Broken> {};

TEST_P(BrokenDocument, NamesThePlace) {
    const test::TemporaryFolder folder;
    folder.write("mesh.bin", test::rectangle_bytes());
    json document = test::rectangle_document();
    GetParam().damage(document);
    EXPECT_EQ(fault_of(folder.write("scene.gltf", document.dump())), GetParam().place);
}

const Broken broken_documents[] = {
    {"version", "asset.version", [](json& d) { d["asset"]["version"] = "1.0"; }},
    {"no_asset", "asset.version", [](json& d) { d.erase("asset"); }},
    {"nodes_type", "nodes", [](json& d) { d["nodes"] = 7; }},
    {"node_type", "nodes[0]", [](json& d) { d["nodes"][0] = "x"; }},
    {"node_mesh_range", "nodes[0].mesh", [](json& d) { d["nodes"][0]["mesh"] = 1; }},
    {"node_mesh_negative", "nodes[0].mesh", [](json& d) { d["nodes"][0]["mesh"] = -1; }},
    {"node_mesh_huge", "nodes[0].mesh", [](json& d) { d["nodes"][0]["mesh"] = 4294967296; }},
    {"child_range", "nodes[0].children[0]", [](json& d) { d["nodes"][0]["children"] = {5}; }},
    {"self_child", "scene root nodes[0]",
     [](json& d) {
         d["scenes"][0]["nodes"] = {0, 0};
     }},
    {"cycle", "nodes[1].children[0]",
     [](json& d) { d["nodes"] = json::parse(R"([{"mesh": 0, "children": [1]}, {"children": [0]}])"); }},
    {"own_child", "nodes[0].children[0]", [](json& d) { d["nodes"][0]["children"] = {0}; }},
    {"two_parents", "nodes[1].children[0]",
     [](json& d) {
         d["nodes"] = json::parse(R"([{"children": [2]}, {"children": [2]}, {"mesh": 0}])");
         d["scenes"][0]["nodes"] = {0, 1};
     }},
    {"scene_index", "scene", [](json& d) { d["scene"] = 3; }},
    {"scene_node", "scenes[0].nodes[0]", [](json& d) { d["scenes"][0]["nodes"] = {9}; }},
    {"translation_length", "nodes[0].translation",
     [](json& d) {
         d["nodes"][0]["translation"] = {1, 2};
     }},
    {"translation_huge", "nodes[0]",
     [](json& d) {
         d["nodes"][0]["translation"] = {1e30, 0, 0};
     }},
    {"translation_far", "meshes[0].primitives[0]",
     [](json& d) {
         d["nodes"][0]["translation"] = {2e5, 0, 0};
     }},
    {"scale_zero", "nodes[0]",
     [](json& d) {
         d["nodes"][0]["scale"] = {0, 1, 1};
     }},
    {"rotation_zero", "nodes[0].rotation",
     [](json& d) {
         d["nodes"][0]["rotation"] = {0, 0, 0, 0};
     }},
    {"matrix_projective", "nodes[0].matrix",
     [](json& d) { d["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }},
    {"no_position", "meshes[0].primitives[0].attributes.POSITION",
     [](json& d) { d["meshes"][0]["primitives"][0]["attributes"] = json::object(); }},
    {"position_range", "meshes[0].primitives[0].attributes.POSITION",
     [](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 2; }},
    {"position_type", "meshes[0].primitives[0].attributes.POSITION",
     [](json& d) { d["accessors"][0]["type"] = "VEC2"; }},
    {"position_component", "meshes[0].primitives[0].attributes.POSITION",
     [](json& d) { d["accessors"][0]["componentType"] = 5122; }},
    {"normal_count", "meshes[0].primitives[0]",
     [](json& d) {
         d["accessors"].push_back(
             {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
         d["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
     }},
    {"indices_float", "meshes[0].primitives[0].indices",
     [](json& d) { d["accessors"][1]["componentType"] = 5126; }},
    {"index_out_of_range", "meshes[0].primitives[0].indices",
     [](json& d) { d["accessors"][0]["count"] = 3; }},
    {"material_range", "meshes[0].primitives[0].material",
     [](json& d) { d["meshes"][0]["primitives"][0]["material"] = 1; }},
    {"mode", "meshes[0].primitives[0].mode", [](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 9; }},
    {"accessor_beyond_view", "meshes[0].primitives[0].attributes.POSITION",
     [](json& d) { d["accessors"][0]["count"] = 5; }},
    {"accessor_huge", "meshes[0].primitives[0].attributes.POSITION",
     [](json& d) { d["accessors"][0]["count"] = 1 << 30; }},
    {"accessor_count_beyond_limit", "accessors[0].count", [](json& d) { d["accessors"][0]["count"] = 1e18; }},
    {"accessor_offset", "meshes[0].primitives[0].attributes.POSITION",
     [](json& d) { d["accessors"][0]["byteOffset"] = 1000000; }},
    {"accessor_kind", "accessors[0].componentType", [](json& d) { d["accessors"][0]["componentType"] = 1; }},
    {"accessor_name", "accessors[0].type", [](json& d) { d["accessors"][0]["type"] = "VEC9"; }},
    {"accessor_view", "accessors[0].bufferView", [](json& d) { d["accessors"][0]["bufferView"] = 2; }},
    {"accessor_without_view", "meshes[0].primitives[0].attributes.POSITION",
     [](json& d) { d["accessors"][0].erase("bufferView"); }},
    {"accessor_sparse", "meshes[0].primitives[0].attributes.POSITION",
     [](json& d) { d["accessors"][0]["sparse"] = json::object(); }},
    {"view_beyond_buffer", "bufferViews[0]", [](json& d) { d["bufferViews"][0]["byteLength"] = 61; }},
    {"view_offset", "bufferViews[0]", [](json& d) { d["bufferViews"][0]["byteOffset"] = 1 << 30; }},
    {"view_stride", "bufferViews[0].byteStride", [](json& d) { d["bufferViews"][0]["byteStride"] = 13; }},
    {"view_stride_small", "meshes[0].primitives[0].attributes.POSITION",
     [](json& d) { d["bufferViews"][0]["byteStride"] = 4; }},
    {"view_buffer", "bufferViews[0].buffer", [](json& d) { d["bufferViews"][0]["buffer"] = 1; }},
    {"buffer_longer_than_file", "buffers[0].uri", [](json& d) { d["buffers"][0]["byteLength"] = 61; }},
    {"buffer_huge", "buffers[0].byteLength", [](json& d) { d["buffers"][0]["byteLength"] = 1e15; }},
    {"buffer_without_uri", "buffers[0]", [](json& d) { d["buffers"][0].erase("uri"); }},
    {"outside", "buffers[0].uri", [](json& d) { d["buffers"][0]["uri"] = "../mesh.bin"; }},
    {"outside_encoded", "buffers[0].uri", [](json& d) { d["buffers"][0]["uri"] = "%2e%2e/mesh.bin"; }},
    {"absolute", "buffers[0].uri", [](json& d) { d["buffers"][0]["uri"] = "/etc/passwd"; }},
    {"url", "buffers[0].uri", [](json& d) { d["buffers"][0]["uri"] = "file:///etc/passwd"; }},
    {"missing", "buffers[0].uri", [](json& d) { d["buffers"][0]["uri"] = "nothing.bin"; }},
    {"folder", "buffers[0].uri", [](json& d) { d["buffers"][0]["uri"] = "."; }},
    {"scene_key", "scenes[0].extras.sonar.orign",
     [](json& d) { d["scenes"][0]["extras"]["sonar"]["orign"] = 1; }},
    {"origin_key", "scenes[0].extras.sonar.origin.lat",
     [](json& d) { d["scenes"][0]["extras"]["sonar"]["origin"] = {{"lat", 59}, {"longitude", 1}}; }},
    {"origin_missing", "scenes[0].extras.sonar.origin.longitude",
     [](json& d) { d["scenes"][0]["extras"]["sonar"]["origin"] = {{"latitude", 59}}; }},
    {"origin_pole", "scenes[0].extras.sonar.origin.latitude",
     [](json& d) { d["scenes"][0]["extras"]["sonar"]["origin"] = {{"latitude", 90}, {"longitude", 1}}; }},
    {"origin_text", "scenes[0].extras.sonar.origin.longitude",
     [](json& d) { d["scenes"][0]["extras"]["sonar"]["origin"] = {{"latitude", 59}, {"longitude", "1E"}}; }},
    {"sonar_key", "materials[0].extras.sonar.mudb",
     [](json& d) { d["materials"][0]["extras"]["sonar"] = {{"mudb", -20}}; }},
    {"sonar_range", "materials[0].extras.sonar.mu_db",
     [](json& d) { d["materials"][0]["extras"]["sonar"] = {{"mu_db", 3}}; }},
    {"sonar_material", "materials[0].extras.sonar.material",
     [](json& d) { d["materials"][0]["extras"]["sonar"] = {{"material", "cheese"}}; }},
    {"sonar_seabed", "materials[0].extras.sonar.seabed",
     [](json& d) { d["materials"][0]["extras"]["sonar"] = {{"seabed", "cheese"}}; }},
    {"sonar_curve_order", "materials[0].extras.sonar.backscatter_db[1][0]",
     [](json& d) { d["materials"][0]["extras"]["sonar"]["backscatter_db"] = {{20, -30}, {20, -20}}; }},
    {"sonar_curve_level", "materials[0].extras.sonar.backscatter_db[0][1]",
     [](json& d) { d["materials"][0]["extras"]["sonar"]["backscatter_db"] = {{20, 30}, {40, -20}}; }},
    {"sonar_curve_pair", "materials[0].extras.sonar.backscatter_db[0]",
     [](json& d) { d["materials"][0]["extras"]["sonar"]["backscatter_db"] = {{20, -30, 1}}; }},
    {"sonar_curve_empty", "materials[0].extras.sonar.backscatter_db",
     [](json& d) { d["materials"][0]["extras"]["sonar"]["backscatter_db"] = json::array(); }},
    {"sonar_slope", "materials[0].extras.sonar.slope",
     [](json& d) { d["materials"][0]["extras"]["sonar"] = {{"slope", -0.1}}; }},
    {"sonar_energy", "materials[0].extras.sonar",
     [](json& d) { d["materials"][0]["extras"]["sonar"] = {{"mu_db", -6}, {"reflection", 0.7}}; }},
    {"sonar_reflection", "materials[0].extras.sonar.reflection",
     [](json& d) { d["materials"][0]["extras"]["sonar"]["reflection"] = 1.01; }},
    {"sonar_roughness", "materials[0].extras.sonar.roughness",
     [](json& d) { d["materials"][0]["extras"]["sonar"]["roughness"] = -0.1; }},
    {"sonar_type", "materials[0].extras.sonar", [](json& d) { d["materials"][0]["extras"]["sonar"] = 5; }},
    {"extension", "extensionsRequired[0]",
     [](json& d) { d["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }},
    {"lines_only", "meshes", [](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 1; }},
    {"no_nodes", "meshes", [](json& d) { d["scenes"][0]["nodes"] = json::array(); }}};

INSTANTIATE_TEST_SUITE_P(All, BrokenDocument, testing::ValuesIn(broken_documents),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(HostileScene, UnknownSonarKeyNamesTheNearest) {
    const test::TemporaryFolder folder;
    json document = test::embedded(test::rectangle_document(), test::rectangle_bytes());
    document["materials"][0]["extras"]["sonar"] = {{"mu_dB", -20}};
    try {
        Scene::load(folder.write("scene.gltf", document.dump()));
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_EQ(error.remedy(), "did you mean mu_db?");
    }
}

TEST(HostileScene, MissingFolderFifoAndDevice) {
    const test::TemporaryFolder folder;
    EXPECT_EQ(fault_of(folder / "nothing.gltf"), "");
    EXPECT_EQ(fault_of(folder / ""), "");
    EXPECT_EQ(fault_of("/dev/zero"), "");
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(fault_of(folder / "pipe"), "");
    json document = test::rectangle_document();
    document["buffers"][0]["uri"] = "pipe";
    EXPECT_EQ(fault_of(folder.write("scene.gltf", document.dump())), "buffers[0].uri");
}

TEST(HostileScene, LinkThatLeavesTheFolder) {
    const test::TemporaryFolder folder, elsewhere;
    std::filesystem::create_symlink(elsewhere.write("mesh.bin", test::rectangle_bytes()),
                                    folder / "mesh.bin");
    EXPECT_EQ(fault_of(folder.write("scene.gltf", test::rectangle_document().dump())), "buffers[0].uri");
}

TEST(HostileScene, NotJson) {
    const test::TemporaryFolder folder;
    for (const char* text : {"", "{", "[]", "7", "nonsense", "{\"asset\": {\"version\": 1e999}}", "\xff\xfe"})
        fault_of(folder.write("scene.gltf", text));
}

TEST(HostileScene, DeepNestingDoesNotOverflowTheStack) {
    const test::TemporaryFolder folder;
    for (const char* bracket : {"[", "{\"a\":"}) {
        std::string text = R"({"asset": {"version": "2.0"}, "extras": )";
        for (int i = 0; i < 1'000'000; ++i) text += bracket;
        EXPECT_EQ(fault_of(folder.write("scene.gltf", text)), "");
    }
    json document = test::embedded(test::rectangle_document(), test::rectangle_bytes());
    for (int i = 1; i < 5000; ++i) document["nodes"].push_back({{"children", {i - 1}}});
    document["scenes"][0]["nodes"] = {4999};
    fault_of(folder.write("scene.gltf", document.dump()));
}

TEST(HostileScene, PositionsThatAreNotFinite) {
    const test::TemporaryFolder folder;
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        std::string bytes = test::rectangle_bytes();
        bytes.replace(16, 4, reinterpret_cast<const char*>(&bad), 4);
        folder.write("mesh.bin", bytes);
        EXPECT_EQ(fault_of(folder.write("scene.gltf", test::rectangle_document().dump())),
                  "meshes[0].primitives[0].attributes.POSITION");
    }
}

TEST(HostileScene, InstancingCannotExplode) {
    const test::TemporaryFolder folder;
    json document = test::embedded(test::rectangle_document(), test::rectangle_bytes());
    document["nodes"] = json::array();
    document["nodes"].insert(document["nodes"].end(), 100'001, json{{"mesh", 0}});
    EXPECT_EQ(fault_of(folder.write("scene.gltf", document.dump())), "nodes");
}

TEST(HostileScene, EveryTruncationOfAGlb) {
    const test::TemporaryFolder folder;
    const std::string whole = test::as_glb(test::rectangle_document(), test::rectangle_bytes());
    for (std::size_t length = 0; length < whole.size(); length += length < 40 ? 1 : 17)
        fault_of(folder.write("scene.glb", whole.substr(0, length)));
}

TEST(HostileScene, EveryByteOfAGlbDamaged) {
    const test::TemporaryFolder folder;
    const std::string whole = test::as_glb(test::rectangle_document(), test::rectangle_bytes());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x5A);
        try {
            Scene::load(folder.write("scene.glb", damaged));
        } catch (const SceneError&) {
            continue;  // some bytes do not matter; none may crash
        }
    }
}

TEST(HostileMesh, FromMeshesIsChecked) {
    const auto place = [](const Mesh& mesh) -> std::string {
        try {
            Scene::from_meshes(std::vector{mesh});
        } catch (const SceneError& error) {
            return error.place();
        }
        return "loads";
    };
    const Mesh good = test::wall_at(10, 1, -1, 1);
    EXPECT_EQ(place(good), "loads");
    Mesh bad = good;
    bad.indices[2] = 4;
    EXPECT_EQ(place(bad), "meshes[0]");
    bad = good;
    bad.positions[1].x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(place(bad), "meshes[0]");
    bad = good;
    bad.indices.pop_back();
    EXPECT_EQ(place(bad), "meshes[0]");
    bad = good;
    bad.normals.resize(1);
    EXPECT_EQ(place(bad), "meshes[0]");
    bad = good;
    bad.positions.assign(4, {1, 2, 3});  // no area at all
    EXPECT_EQ(place(bad), "meshes");
    EXPECT_THROW(Scene::from_meshes({}), SceneError);
}

}  // namespace
}  // namespace echoloop
