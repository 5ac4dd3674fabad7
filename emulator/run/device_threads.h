// Threads on which devices make bytes of large echograms, so that the wires of others do not wait.
#pragma once

#include <functional>
#include <list>
#include <thread>
#include <vector>

#include "emulator/clock/priority_mutex.h"

namespace echoloop {

/// How much a run asks of the machine to be on time: what anybody may ask, or what needs rights.
enum class Punctuality { ordinary, real_time };

/// Two of them. Who hands them something never waits for one that waits for its turn itself.
class Listeners {
  public:
    /// Throws StartError with the remedy if real time is asked for and not permitted.
    explicit Listeners(Punctuality punctuality);
    ~Listeners() { join(); }
    Listeners(const Listeners&) = delete;
    Listeners& operator=(const Listeners&) = delete;

    /// One of them does `work`, which must not throw, when one is free; in the order of these calls.
    void post(std::function<void()> work);
    /// Returns when all is done and they have ended. Nothing must be posted afterwards.
    void join();

  private:
    void serve();

    PriorityMutex mutex_;
    std::list<std::function<void()>> waiting_;
    bool ending_ = false;
    Sleeper called_;  ///< once for everything that was posted
    std::vector<std::jthread> threads_;
};

}  // namespace echoloop
