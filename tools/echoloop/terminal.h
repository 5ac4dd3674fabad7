// What a person at the terminal sees besides the results: errors and progress, both on stderr. Colours only
// on a terminal and without NO_COLOR.
#pragma once

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

/// A bar for work of many steps; prints nothing unless stderr is a terminal.
class Progress {
  public:
    Progress(std::string label, std::size_t steps);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void done(std::size_t steps);

  private:
    std::string label_;
    std::size_t steps_;
    std::size_t shown_ = static_cast<std::size_t>(-1);
    bool visible_;
};

}  // namespace echoloop::cli
