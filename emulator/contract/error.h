// An error that ends the program before or at start-up, with the exit status that it deserves (sysexits).
#pragma once

#include <stdexcept>
#include <string>

namespace echoloop {

/// Exit statuses of BSD's sysexits that the program uses.
enum class Exit : int {
    ok = 0,
    usage = 64,
    data = 65,
    no_input = 66,
    unavailable = 69,
    software = 70,
    os_error = 71,  ///< memory ran out
    cannot_create = 73,
    io = 74,
    late = 75,  ///< EX_TEMPFAIL: a deadline was missed; a less busy machine may meet it
    no_permission = 77,
    config = 78,
};

/// The text names the place, the reason and the remedy.
class StartError : public std::runtime_error {
  public:
    StartError(Exit exit, const std::string& text) : std::runtime_error(text), exit_(exit) {}
    Exit exit() const { return exit_; }

  private:
    Exit exit_;
};

}  // namespace echoloop
