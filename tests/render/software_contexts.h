// The contexts that draw in memory, of which a machine may lack one: Mesa 25.1 has no more OSMesa.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "render/gl/context.h"

namespace echoloop::test {

/// Why a context cannot be made; empty if it can. In CI none may be missing.
inline std::string missing_context(const char* name) {
    const char* const ci = std::getenv("CI");
    if (ci != nullptr && std::string_view(ci) == "true") return {};
    try {
        gl::make_context(name);
        return {};
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

/// Tests that each of them has to pass.
class SoftwareContext : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        if (const std::string why = missing_context(GetParam()); !why.empty()) GTEST_SKIP() << why;
    }
};

inline const auto software_contexts = testing::Values("osmesa", "egl-surfaceless");

/// "osmesa" is OsMesa and "egl-surfaceless" EglSurfaceless in the name of a test.
inline std::string context_test_name(const testing::TestParamInfo<const char*>& info) {
    return std::string_view(info.param) == "osmesa" ? "OsMesa" : "EglSurfaceless";
}

}  // namespace echoloop::test
