// The echogram of one ping, on its way from the render threads back to the thread of the wires. Knows no
// device and no message.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "emulator/clock/asio.h"
#include "emulator/clock/clock.h"
#include "emulator/water/render_threads.h"

namespace echoloop {

/// Belongs to the thread that runs the clock.
class Rendering {
  public:
    /// Has a ping of sonar `name` rendered; `job.done` is set here. A ping that cannot be rendered is
    /// silence, and the log says why.
    static std::shared_ptr<Rendering> start(RenderThreads& threads, Clock& clock, RenderThreads::Job job,
                                            const std::string& name);
    explicit Rendering(Clock& clock) : clock_(clock), done_(clock) {}

    /// Returns when the echogram is there. The clock waits for it.
    Task<void> ready();
    std::optional<Echogram> echogram;
    Time finished{};  ///< when it was there

  private:
    Clock& clock_;
    Alarm done_;
};

}  // namespace echoloop
