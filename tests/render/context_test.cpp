// The kinds of GL contexts: which there are, that they draw the same, and what is said when one cannot be
// had.
#include "render/gl/context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <latch>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "render/gl/egl.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"
#include "tests/render/software_contexts.h"

namespace echoloop {
namespace {

struct Result {
    std::string description, problem;
    std::vector<float> values;
};

/// One ping, on a thread of its own: two copies of Mesa in one process share what is current on a thread.
Result render_with(const char* context) {
    Result result;
    std::thread([&] {
        RendererOptions options;
        options.context = context;
        try {
            Renderer renderer(test::scene_of({test::floor_at(-5, 60, 40), test::wall_at(25, 20, -5, 3),
                                              test::box("box", {12, 3, -4}, {2, 2, 2}, 0.5),
                                              test::sphere({10, -3, -4}, 0.7, 24)}),
                              test::water_of(1500), options);
            result.description = renderer.context_description();
            Shot shot = test::forward_looking();
            for (shot.ping = 0; shot.ping < 2; ++shot.ping) {
                const Echogram e = renderer.render(shot, {});
                result.values.insert(result.values.end(), e.values.begin(), e.values.end());
            }
        } catch (const std::runtime_error& error) {
            result.problem = error.what();
        }
    }).join();
    return result;
}

class EglContext : public testing::TestWithParam<std::pair<const char*, const char*>> {};

// On a machine with a GPU the device context is that GPU's, and its pixels need not be Mesa's.
TEST_P(EglContext, OfTheSameMesaDrawsTheBytesOfOsMesa) {
    if (const std::string why = test::missing_context("osmesa"); !why.empty()) GTEST_SKIP() << why;
    const Result osmesa = render_with("osmesa"), egl = render_with(GetParam().first);
    ASSERT_EQ(osmesa.problem, "");
    ASSERT_EQ(egl.problem, "");
    EXPECT_NE(osmesa.description.find("OSMesa"), std::string::npos);
    EXPECT_NE(egl.description.find(GetParam().second), std::string::npos) << egl.description;
    const auto version = [](const std::string& text) { return text.substr(text.find(", ") + 2); };
    if (version(osmesa.description) != version(egl.description))
        GTEST_SKIP() << osmesa.description << " is not " << egl.description;
    EXPECT_GT(*std::max_element(osmesa.values.begin(), osmesa.values.end()), 0);
    EXPECT_TRUE(osmesa.values == egl.values);
    EXPECT_TRUE(osmesa.values == render_with("osmesa").values) << "EGL has changed what OSMesa draws";
}

INSTANTIATE_TEST_SUITE_P(All, EglContext,
                         testing::Values(std::pair{"egl-surfaceless", "EGL surfaceless"},
                                         std::pair{"egl-device", "EGL device"}));

TEST(GlContext, WithoutAGpuItSaysWhatToDo) {
    try {
        const auto context = gl::make_gpu_context();
        GTEST_SKIP() << "here is a GPU";
    } catch (const std::runtime_error& error) {
        for (const char* word : {"no GPU", "egl-surfaceless", "apt-get install libegl1"})
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

TEST(GlContext, AutoFindsOne) {
    const Result result = render_with("auto");
    EXPECT_EQ(result.problem, "");
    EXPECT_FALSE(result.values.empty());
}

/// How many instances of a library this process has loaded.
std::size_t instances_of(const char* library) {
    std::ifstream maps("/proc/self/maps");
    std::set<std::string> files;
    for (std::string line; std::getline(maps, line);)
        if (line.find(library) != std::string::npos) {
            std::istringstream words(line);
            std::string addresses, rights, offset, device, inode;
            words >> addresses >> rights >> offset >> device >> inode;
            files.insert(inode);
        }
    return files.size();
}

using test::SoftwareContext;

// One instance draws one picture at a time; on one thread several would share what is current.
TEST_P(SoftwareContext, HasALibraryOfItsOwnOnEachThread) {
    const char* const library = std::string_view(GetParam()) == "osmesa" ? "libOSMesa" : "libEGL_mesa";
    const auto context = gl::make_context(GetParam()), another = gl::make_context(GetParam());
    EXPECT_TRUE(context->draws_beside_others());
    std::size_t most = 0;
    for (int i = 0; i < 3; ++i) {
        std::latch both(2);
        const auto hold = [&] {
            const auto own = gl::make_context(GetParam());
            both.arrive_and_wait();
        };
        std::thread first(hold), second(hold);
        first.join();
        second.join();
        if (i > 0) {
            EXPECT_EQ(instances_of(library), most) << "those of threads that ended serve again";
        }
        most = instances_of(library);
        EXPECT_GE(most, 3U);
    }
}

TEST_P(SoftwareContext, DrawsTheSameOnThreadsAtOnce) {
    const Result alone = render_with(GetParam());
    std::array<Result, 3> results;
    std::vector<std::thread> threads;
    for (Result& result : results) threads.emplace_back([&] { result = render_with(GetParam()); });
    for (auto& thread : threads) thread.join();
    EXPECT_FALSE(alone.values.empty());
    for (const Result& result : results) {
        EXPECT_EQ(result.problem, "");
        EXPECT_TRUE(result.values == alone.values);
    }
}

TEST_P(SoftwareContext, BelongsToTheThreadOfItsRenderer) {
    RendererOptions options = test::boxes();
    options.context = GetParam();
    Renderer renderer(test::scene_of({test::wall_at(10, 5, -5, 5)}), {}, options);
    std::thread([&] { EXPECT_THROW(renderer.render(test::scanning(), {}), std::logic_error); }).join();
}

INSTANTIATE_TEST_SUITE_P(Each, SoftwareContext, test::software_contexts, test::context_test_name);

TEST(GlContext, UnknownNamesListTheKnownOnes) {
    try {
        gl::make_context("glx");
        FAIL();
    } catch (const std::invalid_argument& error) {
        for (const char* name : {"glx", "auto", "osmesa", "egl-surfaceless", "egl-device"})
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace echoloop
