// What the checks of `echoloop validate` find: rows of a published value beside ours, and curves for the
// report. Checks nothing itself and prints nothing.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/draw/plot.h"

namespace echoloop::validation {

enum class Bound {
    within,    ///< |ours - published| <= tolerance
    at_most,   ///< ours <= published
    at_least,  ///< ours >= published
};

/// One row of the table.
struct Quantity {
    std::string id;    ///< "V7"
    std::string name;  ///< one of its kind within the id
    std::string unit;
    std::string source;  ///< of the published value
    Bound bound = Bound::within;
    double published = 0, tolerance = 0, ours = 0;

    bool passed() const;
};

using draw::Curve;

/// A picture for the report.
struct NamedPlot {
    std::string name;  ///< of its file, without ending
    draw::Plot plot;
};

class Findings {
  public:
    /// The rows that follow belong to `id`.
    void begin(std::string id) { id_ = std::move(id); }
    /// Where the published values that follow are from.
    void source(std::string text) { source_ = std::move(text); }

    void within(std::string name, std::string unit, double published, double tolerance, double ours);
    void at_most(std::string name, std::string unit, double limit, double ours);
    void at_least(std::string name, std::string unit, double limit, double ours);
    void plot(std::string name, draw::Plot plot) { plots_.push_back({std::move(name), std::move(plot)}); }

    const std::vector<Quantity>& quantities() const { return quantities_; }
    const std::vector<NamedPlot>& plots() const { return plots_; }
    std::size_t failed() const;

  private:
    std::string id_, source_;
    std::vector<Quantity> quantities_;
    std::vector<NamedPlot> plots_;
};

}  // namespace echoloop::validation
