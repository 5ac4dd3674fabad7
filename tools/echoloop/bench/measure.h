// Renders one case of the bench in a process of its own, and measures it. Knows no aims and prints nothing.
#pragma once

#include <filesystem>

#include "tools/echoloop/bench/cases.h"

namespace echoloop::bench {

struct Settings {
    std::size_t pings = 100;
    double pixel_density = 1;
    std::string context = "auto", sampler = "auto";
    std::filesystem::path scene_file{};  ///< empty: a scene of scenes.h
};

/// Of many pings, in ms.
struct Spread {
    double minimum = 0, median = 0, p99 = 0;
};
Spread spread_of(std::vector<double> values);

struct Figures {
    char failure[512] = {};  ///< why there are none; empty: all is well
    char context[160] = {};
    Spread wall, cpu;         ///< ms per ping
    double straight_cpu = 0;  ///< ms, median of the same pings without the profile; 0: there is none
    double cull = 0, draw = 0, read_back = 0, bins = 0, paths = 0, acoustics = 0;  ///< ms, medians
    double start_up = 0;               ///< s: scene, renderer and first ping
    double start_up_cpu = 0;           ///< s that all threads computed meanwhile
    double resident = 0, peak = 0;     ///< MB (1e6 bytes)
    double triangles = 0, pixels = 0;  ///< drawn, medians; a triangle counts in each view that it is in
    double scene_triangles = 0;
};

/// A fresh process per case, so that neither the memory nor the caches of another count.
Figures measure(const Case& the_case, EchoRule rule, const Settings& settings);

}  // namespace echoloop::bench
