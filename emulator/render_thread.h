// The one thread that renders: it owns the renderer with its GL context and serves the pings of all devices
// in the order in which they come. It knows no device and no clock.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "render/echogram.h"
#include "render/situation.h"

namespace echoloop {

class Renderer;

class RenderThread {
  public:
    using Make = std::function<std::unique_ptr<Renderer>()>;
    /// Called on the render thread. `error` is empty if all went well, else the echogram is silence.
    using Done = std::function<void(Echogram echogram, std::string error)>;

    /// Runs `make` on the new thread (a GL context belongs to its thread) and throws what it throws.
    explicit RenderThread(Make make);
    /// Finishes the ping at hand and forgets those that wait.
    ~RenderThread();

    void submit(Shot shot, Situation situation, Done done);

  private:
    struct Job {
        Shot shot;
        Situation situation;
        Done done;
    };

    void serve(std::stop_token stop, Renderer& renderer);

    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::deque<Job> jobs_;
    std::jthread thread_;
};

}  // namespace echoloop
