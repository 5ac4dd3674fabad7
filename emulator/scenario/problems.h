// Everything that is wrong with a scenario, each with its place. Collects and words; decides nothing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/contract/error.h"
#include "emulator/scenario/value.h"

namespace echoloop {

/// One fault of a scenario.
struct Problem {
    enum class Kind { invalid, missing_file, no_permission };

    Kind kind = Kind::invalid;
    std::string where;  ///< "tank.yaml:12:7", or "--set seed=x"
    int line = 0;       ///< 0: not in the file
    int column = 0;
    std::string message;

    std::string text() const { return where + ": " + message; }
};

/// A scenario that cannot be used. what() has one line per problem. The exit status is that of the problems
/// if they agree (no_input, no_permission), else config.
class ScenarioError : public StartError {
  public:
    explicit ScenarioError(std::vector<Problem> problems);
    const std::vector<Problem>& problems() const { return problems_; }

  private:
    std::vector<Problem> problems_;
};

namespace scenario {

/// Gathers problems up to a number that a person can still read.
class Problems {
  public:
    Problems(std::string file, std::vector<std::string> set_arguments)
        : file_(std::move(file)), set_arguments_(std::move(set_arguments)) {}

    void add(const Place& place, std::string message, Problem::Kind kind = Problem::Kind::invalid);
    /// Those of another file, a device's profile; they come after this file's own.
    void append(const Problems& other);
    bool empty() const { return count() == 0; }
    std::size_t count() const { return problems_.size() + appended_.size(); }
    /// Throws ScenarioError if there is any problem.
    void throw_if_any() const;

  private:
    std::string where(const Place& place) const;
    std::vector<Problem> in_order() const;

    std::string file_;
    std::vector<std::string> set_arguments_;
    std::vector<Problem> problems_, appended_;
};

/// The word of `known` that `word` was probably meant to be; empty if none is near.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& known);

/// "; did you mean 'gain'?", or "; known are: a, b, c".
std::string suggestion(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace scenario
}  // namespace echoloop
