// Renders one case of the bench in a process of its own, and measures it. Knows no aims and prints nothing.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

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

/// Medians of some pings in a row, in ms.
struct Turn {
    double wall = 0, cpu = 0;
};

struct Figures {
    char failure[512] = {};  ///< why there are none; empty: all is well
    char context[160] = {};
    Spread wall, cpu;         ///< ms per ping
    Turn turn;                ///< of the last turn alone
    double straight_cpu = 0;  ///< ms, median of the same pings without the profile; 0: there is none
    double cull = 0, draw = 0, read_back = 0, bins = 0, paths = 0, acoustics = 0;  ///< ms, medians
    double start_up = 0;               ///< s: scene, renderer and first ping
    double start_up_cpu = 0;           ///< s that all threads computed meanwhile
    double resident = 0, peak = 0;     ///< MB (1e6 bytes)
    double triangles = 0, pixels = 0;  ///< drawn, medians; a triangle counts in each view that it is in
    double scene_triangles = 0;
};

/// What came of one case. Cases that were measured in turns have as many turns, the same of each at about
/// the same time.
struct Measured {
    Figures figures;
    std::vector<Turn> turns;
};

/// A fresh process per case, so that neither the memory nor the caches of another count. All of them are
/// there at once, and one renders at a time: several cases take turns of ten pings, since the speed of a
/// machine varies, each after two that do not count, which fill the processor's caches again.
std::vector<Measured> measure_in_turns(std::span<const Case> cases, EchoRule rule, const Settings& settings);

}  // namespace echoloop::bench
