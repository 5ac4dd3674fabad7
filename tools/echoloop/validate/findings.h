// What the checks of `echoloop validate` find: rows of a value to meet beside ours, and curves for the
// report. Checks nothing itself and prints nothing.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/draw/plot.h"

namespace echoloop::validation {

enum class Bound {
    within,    ///< |ours - published| <= tolerance
    at_most,   ///< ours <= published
    at_least,  ///< ours >= published
};

/// Where the value to meet is from.
enum class Kind {
    published,    ///< printed by somebody else, with the paper: computed or measured there
    closed_form,  ///< a formula from a textbook or paper, computed apart from the program
    recording,    ///< measured on bytes of a real device
    property,     ///< what has to hold by itself, as that the same ping is the same
};
std::string_view name_of(Kind kind);

/// One row of the table.
struct Quantity {
    std::string id{};    ///< "V7"
    std::string name{};  ///< one of its kind within the id
    std::string unit{};
    std::string source{};  ///< of the value to meet
    Bound bound = Bound::within;
    double published = 0, tolerance = 0, ours = 0;
    Kind kind = Kind::closed_form;
    bool required = true;  ///< else an aim: a miss is shown and counted, and fails nothing

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
    void begin(std::string id) { id_ = std::move(id), required_ = true; }
    /// Where the values that follow are from.
    void source(std::string text, Kind kind = Kind::closed_form) { source_ = std::move(text), kind_ = kind; }
    /// The rows that follow are aims, up to the next begin().
    void aims() { required_ = false; }
    /// Folder of recordings to compare with; empty: none.
    void use_recordings(std::filesystem::path folder) { recordings_ = std::move(folder); }
    const std::filesystem::path& recordings() const { return recordings_; }

    void within(std::string name, std::string unit, double published, double tolerance, double ours);
    void at_most(std::string name, std::string unit, double limit, double ours);
    void at_least(std::string name, std::string unit, double limit, double ours);
    void plot(std::string name, draw::Plot plot) { plots_.push_back({std::move(name), std::move(plot)}); }

    const std::vector<Quantity>& quantities() const { return quantities_; }
    const std::vector<NamedPlot>& plots() const { return plots_; }
    std::size_t failed() const;  ///< of those that are required

  private:
    void add(Quantity quantity);

    std::string id_, source_;
    Kind kind_ = Kind::closed_form;
    bool required_ = true;
    std::filesystem::path recordings_;
    std::vector<Quantity> quantities_;
    std::vector<NamedPlot> plots_;
};

}  // namespace echoloop::validation
