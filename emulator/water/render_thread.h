// The threads that render: each owns a renderer with its GL context. They serve the pings of all devices, the
// one that is needed first first, and those of one device one at a time. They know no device and no
// clock.
#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "emulator/contract/device.h"
#include "emulator/clock/priority_mutex.h"
#include "render/echogram.h"
#include "render/situation.h"

namespace echoloop {

class Renderer;

class RenderThread {
  public:
    /// What a thread takes: all; single beams only, which are rendered in a moment and do not wait behind
    /// fans; or fans that are needed before one that the first ones are at, which they interrupt.
    enum class Lane { every, single_beams, urgent_fans };
    struct Crew {
        std::size_t threads = 1;
        bool single_beams = false;  ///< one thread more, for these
        bool urgent_fans = false;   ///< and one for these
        bool real_time = false;     ///< before all ordinary threads of the machine, but for patient fans
    };
    using Make = std::function<std::unique_ptr<Renderer>(Lane)>;
    /// Called on a render thread. `error` is empty if all went well, else the echogram is silence.
    using Done = std::function<void(Echogram echogram, std::string error)>;

    /// Whose ping it is, and when its echogram is needed.
    struct Claim {
        std::size_t sonar = 0;
        Time needed{};
        bool patient = false;  ///< long before that: other programs may go first
    };

    /// Runs `make` on every new thread (a GL context belongs to its thread), on several at once, and throws
    /// what one of them throws; StartError if real time is not permitted.
    RenderThread(const Make& make, Crew crew);
    /// One thread.
    explicit RenderThread(const Make& make) : RenderThread(make, Crew{}) {}
    /// Finishes the pings at hand and forgets those that wait.
    ~RenderThread() = default;

    /// One of the pings that were submitted.
    using Ticket = std::uint64_t;

    Ticket submit(Claim claim, Shot shot, Situation situation, Done done);
    /// That ping is not patient any more.
    void hurry(Ticket ticket);
    /// Nobody wants that ping any more: it is not rendered if it has not begun, and in no case do others of
    /// its sonar wait for it.
    void withdraw(Ticket ticket);

    /// As many threads as find work with so many sonars on this machine, so many of them with fans.
    static Crew useful(std::size_t sonars, std::size_t fans, bool real_time = false);
    /// For each of their renderers.
    static std::size_t drawing_threads(std::size_t sonars);
    static bool is_single_beam(const Shot& shot) { return shot.bearings.size() == 1; }

  private:
    struct Job {
        Claim claim;
        Shot shot;
        Situation situation;
        Done done;
        Ticket ticket;
    };
    using Jobs = std::list<Job>;

    std::jthread start(const Make& make, Lane lane, std::vector<std::future<void>>& ready);
    void serve(Renderer& renderer, Lane lane, Sleeper& own);
    /// Of who has no work; the lock is given back.
    void call_all(std::unique_lock<PriorityMutex> lock);
    Jobs::iterator most_urgent(Lane lane);
    bool is_for(Lane lane, const Job& job) const;
    void begin(const Job& job, Lane lane);
    void end(Ticket ticket);
    void share_turns() const;
    /// A fan that is not patient waits for a thread.
    bool someone_hurries() const;
    /// Shots with rows of beams take ten times as long as fans: they leave a thread to the others where there
    /// are two.
    bool leaves_a_thread(const Shot& shot) const {
        return shot.rows() == 1 || images_ == 0 || images_ + 1 < every_;
    }

    const bool real_time_, urgent_fans_;
    const std::size_t every_;  ///< threads of that lane
    PriorityMutex mutex_;
    bool ending_ = false;
    std::list<Sleeper> sleepers_;   ///< one for each thread
    std::vector<Sleeper*> asleep_;  ///< those who wait for work
    Jobs jobs_;                     ///< as they are needed, then in the order of submission
    /// Sonars whose ping is being rendered, and which.
    std::map<std::size_t, Ticket> busy_;
    Ticket last_ticket_ = 0;
    /// What the threads for all are at.
    struct UnderWay {
        pthread_t thread;
        Claim claim;
        bool fan;
        Ticket ticket;
    };
    std::vector<UnderWay> under_way_;
    std::size_t images_ = 0;  ///< shots with rows that are being rendered
    std::vector<std::jthread> threads_;
    /// Before the threads are joined, also if one of them could not start.
    struct End {
        RenderThread& crew;
        ~End();
    } end_{*this};
};

}  // namespace echoloop
