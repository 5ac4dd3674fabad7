// The bench's scenes against those of tools/scenes/bench.py, which were measured with other simulators.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>

#include "tools/echoloop/bench/scenes.h"

namespace echoloop {
namespace {

/// Lines of "v x y z nx ny nz" and "t a b c" for every mesh, each mesh begun by "mesh".
constexpr auto script = R"(
import sys
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
from scenes import bench
for node in bench.nodes(sys.argv[2]):
    for material, mesh in node.parts:
        print("mesh", material)
        for p, n in zip(mesh.positions, mesh.normals):
            print("v", *(repr(float(x)) for x in p + tuple(n)))
        for t in mesh.triangles:
            print("t", *t)
)";

struct Close {
    void operator()(std::FILE* pipe) const { EXPECT_EQ(::pclose(pipe), 0); }
};

/// The meshes as the Python generator makes them.
std::vector<Mesh> python_meshes(const std::string& name) {
    const std::string command =
        std::string("python3 -c '") + script + "' " ECHOLOOP_SOURCE_DIR "/tools " + name;
    const std::unique_ptr<std::FILE, Close> pipe(::popen(command.c_str(), "r"));
    std::vector<Mesh> meshes;
    char line[512], word[64];
    while (std::fgets(line, sizeof line, pipe.get()) != nullptr) {
        Vec3 p, n;
        unsigned a = 0, b = 0, c = 0;
        if (std::sscanf(line, "mesh %63s", word) == 1) {
            meshes.emplace_back().material.name = word;
        } else if (std::sscanf(line, "v %lf %lf %lf %lf %lf %lf", &p.x, &p.y, &p.z, &n.x, &n.y, &n.z) == 6) {
            meshes.back().positions.push_back(p);
            meshes.back().normals.push_back(n);
        } else if (std::sscanf(line, "t %u %u %u", &a, &b, &c) == 3) {
            meshes.back().indices.insert(meshes.back().indices.end(), {a, b, c});
        }
    }
    return meshes;
}

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, norm(a[i] - b[i]));
    return largest;
}

TEST(BenchScenes, AreThoseOfTheScript) {
    for (const char* name : {"simple", "big100k"}) {
        const auto ours = bench::scene_meshes(name), theirs = python_meshes(name);
        ASSERT_EQ(ours.size(), theirs.size());
        for (std::size_t i = 0; i < ours.size(); ++i) {
            EXPECT_EQ(ours[i].material.name, theirs[i].material.name);
            ASSERT_EQ(ours[i].positions.size(), theirs[i].positions.size()) << name;
            EXPECT_LT(distance(ours[i].positions, theirs[i].positions), 1e-6) << name << " mesh " << i;
            EXPECT_LT(distance(ours[i].normals, theirs[i].normals), 1e-6) << name << " mesh " << i;
            EXPECT_EQ(ours[i].indices, theirs[i].indices) << name << " mesh " << i;
        }
    }
}

TEST(BenchScenes, HaveTheSizesThatAreToldOfThem) {
    const std::pair<const char*, std::size_t> sizes[] = {
        {"simple", 1158},   {"big100k", 101508}, {"big2m", 2001156}, {"one1m", 1000854},
        {"one2m", 2001156}, {"terrain", 980000}, {"stones", 451516}};
    ASSERT_EQ(bench::scene_rows().size(), std::size(sizes));
    for (const auto& [name, triangles] : sizes) {
        std::size_t count = 0;
        Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
        for (const Mesh& mesh : bench::scene_meshes(name)) {
            count += mesh.indices.size() / 3;
            for (const Vec3 p : mesh.positions) {
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
        }
        EXPECT_EQ(count, triangles) << name;
        EXPECT_EQ(low.x, -60);
        EXPECT_EQ(high.y, 60);
        if (std::string(name) == "terrain") {
            EXPECT_LT(high.z, -4);
            EXPECT_GT(low.z, -8);
            continue;
        }
        EXPECT_EQ(high.z, 3);    // the walls' tops
        EXPECT_LE(low.z, -6);    // less the waves, 0.25 m x 1.4
        EXPECT_GE(low.z, -6.4);  // a stone's half
    }
    EXPECT_THROW(bench::scene_meshes("huge"), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop
