// Which device `auto` draws on, with a GPU, a broken GPU and none, by a test double of EGL (double_egl.cpp):
// real GPUs are not to be had on every machine that runs the tests. By hand, `virtual_machine` has one.
#include <gtest/gtest.h>

#include <cstdlib>

#include "render/gl/context.h"
#include "render/gl/egl.h"

namespace echoloop {
namespace {

/// The kind of context that can be bound, where the machine has these devices.
std::string chosen(const char* devices, bool may_have_gpu) {
    ::setenv("ECHOLOOP_DOUBLE_EGL", devices, 1);
    const auto context = gl::make_auto_context(may_have_gpu);
    context->make_current();
    return std::string(context->kind());
}

/// What draws in memory here: OSMesa, or EGL where that is missing or hidden.
std::string in_memory() {
    static const std::string kind{[] {
        try {
            return gl::make_context("osmesa")->kind();
        } catch (const std::runtime_error&) {
            return gl::make_context("egl-surfaceless")->kind();
        }
    }()};
    return kind;
}

TEST(GpuChoice, AutoPrefersAGpu) { EXPECT_EQ(chosen("gpu", true), "EGL device"); }

TEST(GpuChoice, TheFirstGpuThatWorksIsTaken) {
    ::setenv("ECHOLOOP_DOUBLE_EGL", "broken", 1);
    EXPECT_EQ(gl::make_egl_device_context()->kind(), "EGL device");
}

TEST(GpuChoice, AutoDoesWithoutAGpuThatIsBroken) { EXPECT_EQ(chosen("broken", true), in_memory()); }
TEST(GpuChoice, AutoDoesWithoutAGpuThatDrawsWrongly) { EXPECT_EQ(chosen("wrong", true), in_memory()); }

TEST(GpuChoice, AGpuThatDrawsWronglyIsNamedWithWhatItDrew) {
    ::setenv("ECHOLOOP_DOUBLE_EGL", "wrong", 1);
    try {
        gl::make_context("egl-device");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("EGL device: it draws a known picture wrongly: range"),
                  std::string::npos)
            << error.what();
    }
}

TEST(GpuChoice, ASoftwareDeviceIsNoGpu) { EXPECT_EQ(chosen("software", true), in_memory()); }
TEST(GpuChoice, WhereTheKernelOffersNoneNothingIsLookedFor) { EXPECT_EQ(chosen("gpu", false), in_memory()); }

TEST(GpuChoice, AFaultNamesTheBrokenGpu) {
    ::setenv("ECHOLOOP_DOUBLE_EGL", "broken", 1);
    try {
        gl::make_gpu_context();
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("no display"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace echoloop
