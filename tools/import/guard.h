// Runs work on files that nobody trusts in a process of its own, with limits, so that neither a crash nor a
// loop of a library harms more than that process.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace echoloop::worlds {

struct Limits {
    std::size_t memory = std::size_t{8}
                         << 30;  ///< bytes of address space; not under a sanitizer, which needs more
    unsigned seconds = 600;      ///< of processor time
};

/// What the work says it is doing, for the message about how it ended.
class Stage {
  public:
    void set(const std::string& what);
    std::string text() const;

  private:
    friend struct StageMemory;
    char* memory_ = nullptr;
};

/// Calls `work` in a child process and returns its result, which becomes the child's exit status. Throws
/// Fault when the child was ended by a signal or a limit. A signal to end (SIGINT, SIGTERM) is passed on, and
/// the result is 128 plus it.
int run_guarded(const Limits& limits, const std::function<int(Stage&)>& work);

}  // namespace echoloop::worlds
