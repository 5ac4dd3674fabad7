// Bars over one linear axis, one below the other, each made of parts. Knows no sonar and no file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/draw/draw.h"

namespace echoloop::draw {

struct Bar {
    std::string label;
    std::vector<double> parts;     ///< lengths one after the other, none below 0
    std::optional<double> mark{};  ///< a line across the bar
};

struct Bars {
    std::string title, axis;
    std::vector<std::string> parts;  ///< what the parts are called
    std::string mark;                ///< what the marks are called; empty: there are none
    std::vector<Bar> bars;
};

/// As high as the bars need. Throws std::invalid_argument if there is no bar, or none has a length.
Picture bars_picture(const Bars& bars, int width = 1000);

}  // namespace echoloop::draw
