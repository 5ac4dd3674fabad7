// What the bench found, beside what was to be reached: verdicts and the text of a terminal. Measures nothing.
#pragma once

#include <string>
#include <vector>

#include "tools/echoloop/bench/measure.h"

namespace echoloop::bench {

struct Row {
    Case the_case;
    EchoRule rule;
    Figures figures;
    std::vector<Turn> turns{};
};

/// A figure to reach that is not the time of one case.
struct Limit {
    std::string what;
    double ours = 0, most = 0;
    std::string unit;
    bool met() const { return ours <= most; }
};

struct Report {
    Settings settings;
    std::vector<Row> rows;
};

/// "aim", "least" or "no" for the median wall time; empty without a target.
std::string reached(const Row& row);

/// Start-up, memory, how the time grows with the triangles, and what bent rays add; only what the rows tell.
/// Growth is the median of what turns of two cases at about the same time have for each other.
std::vector<Limit> limits_of(const Report& report);

std::string rule_name(EchoRule rule);
std::string text_of(const Report& report);

}  // namespace echoloop::bench
