// The threads that render: each owns a renderer with its GL context. They serve the pings of all devices, the
// one that is needed first first, and those of one device one at a time. They know no device and no clock.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "emulator/contract/device.h"
#include "render/situation.h"

namespace echoloop {

class Renderer;

class RenderThreads {
  public:
    using Make = std::function<std::unique_ptr<Renderer>()>;
    /// Called on a render thread. `error` is empty if all went well, else the echogram is silence.
    using Done = std::function<void(Echogram echogram, std::string error)>;

    /// A ping of a sonar, and when its echogram is needed.
    struct Job {
        std::size_t sonar = 0;
        Time needed{};
        Shot shot;
        Situation situation;
        Done done;
    };

    /// Runs `make` on every new thread (a GL context belongs to its thread), on several at once, and throws
    /// what one of them throws.
    explicit RenderThreads(const Make& make, std::size_t threads = 1);
    /// Finishes the pings at hand and forgets those that wait.
    ~RenderThreads();

    void submit(Job job);

    /// Pings, now.
    struct Load {
        std::size_t threads = 0, drawing = 0, waiting = 0;
    };
    Load load() const;

    /// As many threads as find work with so many sonars on this machine.
    static std::size_t useful(std::size_t sonars);
    /// For each of their renderers.
    static std::size_t drawing_threads(std::size_t sonars);

  private:
    using Jobs = std::list<Job>;

    void serve(Renderer& renderer, const std::stop_token& stop);
    void render(Renderer& renderer, Job& job);
    Jobs::iterator most_urgent();
    /// Shots with rows of beams take ten times as long as fans: they leave a thread to the others where there
    /// are two.
    bool leaves_a_thread(const Shot& shot) const {
        return shot.rows() == 1 || images_ == 0 || images_ + 1 < count_;
    }

    const std::size_t count_;
    mutable std::mutex mutex_;
    std::condition_variable_any changed_;
    Jobs jobs_;                          ///< as they are needed, then in the order of submission
    std::set<std::size_t> busy_;         ///< sonars whose ping is being rendered
    std::size_t images_ = 0;             ///< shots with rows that are being rendered
    std::vector<std::jthread> threads_;  // last: ended first
};

}  // namespace echoloop
