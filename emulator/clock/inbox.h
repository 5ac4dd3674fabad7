// What other threads hand to the thread that runs an io_context. Knows nothing of what it is.
#pragma once

#include <functional>
#include <list>

#include "emulator/clock/asio.h"
#include "emulator/clock/priority_mutex.h"

namespace echoloop {

/// As asio::post(), but no thread that hands something over ever holds up the one that serves the wires:
/// asio::post() wakes that while it holds a plain lock, which it then waits for; and while it does, threads
/// of middling urgency run before the one that holds it.
class Inbox {
  public:
    /// From now on the io_context never runs out of work. Throws std::system_error without descriptors.
    explicit Inbox(asio::io_context& io);
    ~Inbox() = default;
    Inbox(const Inbox&) = delete;
    Inbox& operator=(const Inbox&) = delete;

    /// From any thread: `event` happens on the one that runs the io_context, in the order of these calls.
    void post(std::function<void()> event);

  private:
    void listen();
    void take_out();

    PriorityMutex mutex_;
    std::list<std::function<void()>> waiting_;
    asio::posix::stream_descriptor bell_;  ///< readable when something came into an empty box
};

}  // namespace echoloop
