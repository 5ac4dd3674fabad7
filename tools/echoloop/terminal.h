// What a person at the terminal sees besides the results: errors and progress, both on stderr. Colours only
// on a terminal and without NO_COLOR.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace echoloop::cli {

/// Whether what goes to this file descriptor may have colours.
bool coloured(int descriptor);

/// "echoloop: error: ..." for every line of `text`.
void print_error(std::string_view text);
/// "echoloop: warning: ..." for every line of `text`.
void print_warning(std::string_view text);

/// A bar for work of many steps, with the time that the rest will take; prints nothing unless stderr is a
/// terminal. Whoever writes to stderr meanwhile writes behind the bar.
class Progress {
  public:
    /// `label`: what is done, as in "rendering". Shows nothing while `steps` is below 2.
    explicit Progress(std::string label, std::size_t steps = 0);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// How many are done; more than there were counts as all.
    void done(std::size_t steps);
    /// The same for who learns only now how many there are.
    void done(std::size_t steps, std::size_t of);
    /// Takes the bar away for something else to be printed; done() draws it again.
    void clear();

  private:
    std::string rest(std::size_t steps) const;

    std::string label_;
    std::size_t steps_;
    std::string shown_;
    int terminal_;  ///< a descriptor of its own, for who turns stderr away; -1: there is none
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now(), last_{};
};

}  // namespace echoloop::cli
