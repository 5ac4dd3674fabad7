// When the machine let nothing run on a processor: what no program can mend, such as the host of a virtual
// machine that gives its processors to others. Says which late pings are nobody's fault here, and lets the
// thread that serves the wires sleep through none while another processor runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

namespace echoloop {

class WireThread;

/// A thread on every processor that this process may use, before all others of the run (Turn::watchers),
/// wakes each millisecond, or when something is overdue: where it came later, that processor stood still since
/// the last moment at which it is known to have run. That is up to a millisecond too long: better than to
/// blame somebody else for the rest. 3 % of each processor.
class Standstills {
  public:
    using Steady = std::chrono::steady_clock;
    struct Summary {
        std::uint64_t count = 0;  ///< of all processors together
        Steady::duration longest{};
        std::uint64_t fetched = 0;  ///< how often the thread was brought to another processor
    };

    /// Throws StartError with the remedy if real time is not permitted.
    Standstills();
    ~Standstills();

    /// How long of [from, to] a processor stood still, of the one for which that was longest. Looks back over
    /// the last 64 standstills of each.
    Steady::duration within(Steady::time_point from, Steady::time_point to) const;
    /// How long of [from, to] none of them ran, so that nothing in this machine could have happened.
    Steady::duration of_all_within(Steady::time_point from, Steady::time_point to) const;
    Summary summary() const;

    /// While one lives, the thread is fetched to a processor that runs when something was due a quarter of a
    /// millisecond ago, and it sleeps or its own processor stands still. One at a time.
    class Care {
      public:
        Care(Standstills& standstills, WireThread& thread);
        ~Care();
        Care(const Care&) = delete;
        Care& operator=(const Care&) = delete;

      private:
        Standstills& standstills_;
    };

  private:
    class Watcher;
    bool stands_still(int processor, Steady::time_point now) const;
    void look_after(WireThread* thread);
    std::vector<std::unique_ptr<Watcher>> watchers_;
};

}  // namespace echoloop
