// When the machine let nothing run: what no program can mend, such as the host of a virtual machine that
// gives its processors to others. Says which late pings are nobody's fault here.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

namespace echoloop {

/// A thread on every processor that this process may use, before all others of the run (Turn::watchers),
/// wakes each millisecond: where it came later, that processor stood still. 1.5 % of each processor.
class Standstills {
  public:
    using Steady = std::chrono::steady_clock;
    struct Summary {
        std::uint64_t count = 0;  ///< of all processors together
        Steady::duration longest{};
    };

    /// Throws StartError with the remedy if real time is not permitted.
    Standstills();
    ~Standstills();

    /// How long of [from, to] a processor stood still, of the one for which that was longest. Looks back over
    /// the last 64 standstills of each.
    Steady::duration within(Steady::time_point from, Steady::time_point to) const;
    Summary summary() const;

  private:
    class Watcher;
    std::vector<std::unique_ptr<Watcher>> watchers_;
};

}  // namespace echoloop
