// Animations play as glTF 2.0 has them.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <limits>

#include "render/scene/scene.h"
#include "tests/render/gltf_files.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using namespace test;
using nlohmann::json;

/// rectangle_document() with a node above it, and an animation of `path` over `times` with `values`.
struct AnimatedFile {
    json document = rectangle_document();
    std::string bytes = rectangle_bytes();

    std::size_t accessor(const std::vector<float>& numbers, const char* type, std::size_t parts) {
        while (bytes.size() % 4 != 0) bytes += '\0';
        const std::size_t size = numbers.size() * sizeof(float);
        document["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
        bytes.append(reinterpret_cast<const char*>(numbers.data()), size);
        document["buffers"][0]["byteLength"] = bytes.size();
        document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                         {"componentType", 5126},
                                         {"count", numbers.size() / parts},
                                         {"type", type}});
        return document["accessors"].size() - 1;
    }

    void animate(const char* path, const std::vector<float>& times, const std::vector<float>& values,
                 const char* interpolation = "LINEAR", std::size_t node = 0) {
        const bool turns = std::string(path) == "rotation";
        const auto input = accessor(times, "SCALAR", 1);
        const auto output = accessor(values, turns ? "VEC4" : "VEC3", turns ? 4 : 3);
        json& animation = document["animations"][0];
        animation["samplers"].push_back(
            {{"input", input}, {"output", output}, {"interpolation", interpolation}});
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
    }

    std::shared_ptr<const Scene> load(const SceneOptions& options = {.animations = true}) const {
        const TemporaryFolder folder;
        folder.write("mesh.bin", bytes);
        return Scene::load(folder.write("scene.gltf", document.dump()), options);
    }
};

Pose pose_at(const Scene& scene, double seconds, Playback playback = Playback::loop) {
    return mover_poses(scene.movers(), seconds, playback).at(0);
}

void expect_near(Vec3 a, Vec3 b, double tolerance = 1e-6) {
    EXPECT_LT(norm(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Animation, MovesLinearlyAndLoops) {
    AnimatedFile file;
    file.animate("translation", {0, 2, 4}, {0, 0, 0, 2, 0, 0, 2, 0, -4});
    const auto scene = file.load();
    ASSERT_EQ(scene->movers().size(), 1);
    expect_near(pose_at(*scene, 1).position, {1, 0, 0});
    expect_near(pose_at(*scene, 3).position, {2, 2, 0});  // glTF's -z is ENU's y
    expect_near(pose_at(*scene, 5).position, {1, 0, 0});
    expect_near(pose_at(*scene, 5, Playback::once).position, {2, 4, 0});
}

TEST(Animation, StepsAndSplines) {
    AnimatedFile steps;
    steps.animate("translation", {0, 1}, {0, 0, 0, 5, 0, 0}, "STEP");
    expect_near(pose_at(*steps.load(), 0.9).position, {0, 0, 0});
    AnimatedFile spline;  // no tangents: 3 p^2 - 2 p^3
    spline.animate("translation", {0, 2}, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 0, 0, 0, 0},
                   "CUBICSPLINE");
    expect_near(pose_at(*spline.load(), 0.5).position, {8 * (3.0 / 16 - 2.0 / 64), 0, 0});
    AnimatedFile tangent;  // out-tangent 4 m/s from rest to rest: dt (p^3 - 2 p^2 + p) 4
    tangent.animate("translation", {0, 2}, {0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
                    "CUBICSPLINE");
    expect_near(pose_at(*tangent.load(), 1).position, {2 * 4 * (0.125 - 0.5 + 0.5), 0, 0});
}

TEST(Animation, TurnsByTheShortestWay) {
    AnimatedFile file;  // about glTF's y, which is up: from 0 to 90 degrees, written with the opposite sign
    const auto half = static_cast<float>(std::sqrt(0.5));
    file.animate("rotation", {0, 1}, {0, 0, 0, 1, 0, -half, 0, -half});
    const Quat q = pose_at(*file.load(), 0.5).orientation;
    expect_near(rotate(q, {1, 0, 0}), {std::sqrt(0.5), std::sqrt(0.5), 0});
}

TEST(Animation, IsTheSameAsANodePlacedByHand) {
    AnimatedFile animated;
    animated.document["nodes"][0]["scale"] = {2, 2, 2};
    animated.animate("translation", {0, 2}, {0, 0, 0, 0, 0, -12});
    animated.animate("rotation", {0, 2}, {0, 0, 0, 1, 0, 1, 0, 0});  // half a turn about up
    AnimatedFile placed = animated;
    placed.document.erase("animations");
    const double half = std::sqrt(0.5);
    placed.document["nodes"][0]["translation"] = {0, 0, -6};
    placed.document["nodes"][0]["rotation"] = {0, half, 0, half};
    const auto moving = animated.load(), still = placed.load();
    const Shot shot = fan(90, 40, 45, 400, 20);
    Renderer a(moving, water_of(1500), boxes()), b(still, water_of(1500), boxes());
    for (const double yaw : {0.5, 1.5, 2.5}) {
        Situation situation(Pose{{0, 0, 0.3}, from_rpy(0, 0, yaw)});
        situation.movers = mover_poses(moving->movers(), 1, Playback::loop);
        const Echogram x = a.render(shot, situation), y = b.render(shot, situation.world_from_sonar);
        double difference = 0;
        for (std::size_t i = 0; i < x.values.size(); ++i)
            difference += std::abs(static_cast<double>(x.values[i]) - static_cast<double>(y.values[i]));
        EXPECT_LE(difference, 0.01 * total_power(y)) << yaw;
    }
    EXPECT_GT(moving->movers()[0].bounds.max[0], 1.5F) << "the node's own scale is kept";
}

TEST(Animation, CarriesWhatHangsOnTheNode) {
    AnimatedFile file;
    file.document["nodes"].push_back({{"name", "arm"}, {"children", {0}}, {"translation", {1, 0, 0}}});
    file.document["scenes"][0]["nodes"] = {1};
    file.document["nodes"][0]["translation"] = {0, 0, -3};
    file.animate("translation", {0, 1}, {1, 0, 0, 5, 0, 0}, "LINEAR", 1);
    const auto scene = file.load();
    ASSERT_EQ(scene->movers().size(), 1);
    EXPECT_EQ(scene->movers()[0].name, "arm");
    expect_near(pose_at(*scene, 0.5).position, {3, 0, 0});
    EXPECT_NEAR(scene->movers()[0].bounds.min[1], 3, 1e-6) << "the rectangle is 3 m to the north of the arm";
    const auto movable = file.load({.movable = {file.document["nodes"][0]["name"]}, .animations = true});
    ASSERT_EQ(movable->movers().size(), 2);
    expect_near(mover_poses(movable->movers(), 0.5, Playback::loop)[1].position, {3, 3, 0});
    const std::optional<Pose> told[] = {std::nullopt, Pose{{7, 8, 9}, {}}};
    expect_near(mover_poses(movable->movers(), 0.5, Playback::loop, told)[1].position, {7, 8, 9});
}

TEST(Animation, IsNotThereUnlessAskedFor) {
    AnimatedFile file;
    file.animate("translation", {0, 1}, {0, 0, 0, 5, 0, 0});
    EXPECT_TRUE(file.load({})->movers().empty());
    EXPECT_EQ(file.load({})->still_nodes(), file.load({})->nodes().size());
}

TEST(Animation, WithoutOneASceneIsTheSameWhoeverAsks) {
    const std::filesystem::path tank = std::filesystem::path(ECHOLOOP_SOURCE_DIR) / "config/scenes/tank.glb";
    const auto asked = Scene::load(tank, {.animations = true}), plain = Scene::load(tank);
    const auto same = [](auto a, auto b) {
        return a.size_bytes() == b.size_bytes() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
    };
    EXPECT_TRUE(same(asked->vertices(), plain->vertices()) && same(asked->indices(), plain->indices()));
    EXPECT_TRUE(same(asked->nodes(), plain->nodes()));
    Renderer a(asked, water_of(1500)), b(plain, water_of(1500));
    Situation situation(Pose{{0, 0, -2}, {}});
    const auto plain_values = b.render(scanning(), situation).values;
    situation.movers = mover_poses(asked->movers(), 3, Playback::loop);
    EXPECT_EQ(a.render(scanning(), situation).values, plain_values);
}

TEST(Animation, SaysWhatItLeavesOut) {
    AnimatedFile file;
    file.animate("scale", {0, 1}, {1, 1, 1, 2, 2, 2});
    const auto scene = file.load();
    EXPECT_TRUE(scene->movers().empty());
    ASSERT_EQ(scene->notes().size(), 1);
    EXPECT_NE(scene->notes()[0].find("scale"), std::string::npos);
}

std::string fault_of(const AnimatedFile& file) {
    try {
        file.load();
    } catch (const SceneError& error) {
        return error.place();
    }
    return "loads";
}

TEST(Animation, RefusesWhatCannotBePlayed) {
    const std::string sampler = "animations[0].samplers[0]";
    const auto broken = [](const std::vector<float>& times, const std::vector<float>& values,
                           const char* path, const std::function<void(json&)>& damage = {}) {
        AnimatedFile file;
        file.animate(path, times, values);
        if (damage) damage(file.document);
        return fault_of(file);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(broken({0, 0}, {0, 0, 0, 1, 0, 0}, "translation"), sampler + ".input");
    EXPECT_EQ(broken({1, 0}, {0, 0, 0, 1, 0, 0}, "translation"), sampler + ".input");
    EXPECT_EQ(broken({-1, 0}, {0, 0, 0, 1, 0, 0}, "translation"), sampler + ".input");
    EXPECT_EQ(broken({0, nan}, {0, 0, 0, 1, 0, 0}, "translation"), sampler + ".input");
    EXPECT_EQ(broken({0, 1}, {0, 0, 0, nan, 0, 0}, "translation"), sampler + ".output");
    EXPECT_EQ(broken({0, 1}, {0, 0, 0, 1e9F, 0, 0}, "translation"), sampler + ".output");
    EXPECT_EQ(broken({0, 1}, {0, 0, 0}, "translation"), sampler + ".output");
    EXPECT_EQ(broken({0, 1}, {0, 0, 0, 1, 0, 0, 0, 3}, "rotation"), sampler + ".output");
    const std::vector<float> good{0, 0, 0, 1, 0, 0};
    EXPECT_EQ(
        broken({0, 1}, good, "translation", [](json& d) { d["animations"][0]["samplers"][0]["input"] = 99; }),
        sampler + ".input");
    EXPECT_EQ(broken({0, 1}, good, "translation",
                     [](json& d) { d["animations"][0]["samplers"][0]["output"] = 0; }) != "loads",
              true);
    EXPECT_EQ(broken({0, 1}, good, "translation",
                     [](json& d) { d["animations"][0]["samplers"][0]["interpolation"] = "BEZIER"; }),
              sampler + ".interpolation");
    EXPECT_EQ(broken({0, 1}, good, "translation",
                     [](json& d) { d["animations"][0]["channels"][0]["sampler"] = 1; }),
              "animations[0].channels[0].sampler");
    EXPECT_EQ(broken({0, 1}, good, "translation",
                     [](json& d) { d["animations"][0]["channels"][0]["target"]["node"] = 7; }),
              "animations[0].channels[0].target.node");
    EXPECT_EQ(broken({0, 1}, good, "translation", [](json& d) { d["animations"][0]["channels"] = "x"; }),
              "animations[0].channels");
    EXPECT_EQ(
        broken({0, 1}, good, "translation",
               [](json& d) { d["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }),
        "nodes[0].matrix");
}

}  // namespace
}  // namespace echoloop
