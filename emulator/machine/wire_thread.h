// The thread that serves the wires, for those who wake it where its own processor does not: a virtual
// machine's host gives processors away one at a time, and a timer that waits on one of these rings when it
// comes back.
#pragma once

#include <sched.h>

#include <atomic>
#include <chrono>

#include "emulator/clock/asio.h"

namespace echoloop {

/// Made and destroyed on the thread that runs the io_context, which never runs out of work meanwhile. While
/// it lives, the thread stays on the processor where it is, or to which it was fetched last: the kernel would
/// move it whenever somebody more urgent comes by for a moment, and does not know which processors stand
/// still.
class WireThread {
  public:
    using Steady = std::chrono::steady_clock;

    /// Throws std::system_error without descriptors.
    explicit WireThread(asio::io_context& io);
    ~WireThread();
    WireThread(const WireThread&) = delete;
    WireThread& operator=(const WireThread&) = delete;

    /// On the thread itself: when its next timer rings; max() is never.
    void due(Steady::time_point when) { due_.store(when, std::memory_order_relaxed); }

    /// From any thread.
    Steady::time_point due() const { return due_.load(std::memory_order_relaxed); }
    struct State {
        bool asleep = false;
        int processor = -1;  ///< where it ran last, or waits to run; -1: unknown
    };
    /// From any thread: by the kernel.
    State state() const;
    /// From any thread: it wakes on this processor, where it stays, and all its timers that are due ring
    /// there. Where it runs already, the kernel makes us wait until its processor lets it go.
    void fetch_to(int processor);

  private:
    bool stay_on(int processor) const;
    void listen();
    void ring_timers();

    pid_t thread_;
    cpu_set_t processors_;  ///< on which it might run before
    int stat_;              ///< descriptor of what the kernel says of it
    std::atomic<Steady::time_point> due_{Steady::time_point::max()};
    asio::posix::stream_descriptor bell_;
    asio::steady_timer first_;  ///< before all others
};

}  // namespace echoloop
