// A few threads that share out loops, for work too short to start threads for. Results never depend on their
// number: an index is one whole piece of work.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

namespace echoloop {

/// Belongs to one thread, the caller: only that one calls what is not said to be for others.
class Workers {
  public:
    /// `threads` counts the caller's. None is started before the first work that needs it.
    explicit Workers(std::size_t threads = useful()) : wished_(threads) {}
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    static constexpr std::size_t all = std::numeric_limits<std::size_t>::max();

    /// Calls work(i) once for every i below `count`, in any order and on any thread, the lowest first, and
    /// returns when all are done. No more than `most` threads take part, the caller's among them. Throws what
    /// one of the calls threw, once all have ended.
    void run(std::size_t count, const std::function<void(std::size_t)>& work, std::size_t most = all);

    /// Work that another thread may do beside what the caller does meanwhile, run() included. One at a time.
    class Aside {
      public:
        Aside(Workers& workers, std::function<void()> work);
        /// Unless wait() has returned: what was not begun is dropped, what was is waited for.
        ~Aside();
        Aside(const Aside&) = delete;
        Aside& operator=(const Aside&) = delete;
        /// Returns when it is done, by the caller if nobody has begun it. Throws what it threw.
        void wait();

      private:
        friend class Workers;
        enum class State { waiting, begun, done };

        Workers& workers_;
        std::function<void()> work_;
        std::atomic<State> state_{State::waiting};  ///< changed under the workers' mutex
        std::exception_ptr fault_;
        bool waited_for_ = false;
    };

    /// While there is one, more work is to come within microseconds: threads look for it for a moment before
    /// they sleep, because it takes longer to wake one. How long depends on whether that helped of late.
    class Burst {
      public:
        explicit Burst(Workers& workers) : workers_(workers) { workers_.burst_ = true; }
        ~Burst() { workers_.burst_ = false; }
        Burst(const Burst&) = delete;
        Burst& operator=(const Burst&) = delete;

      private:
        Workers& workers_;
    };

    /// Calls work(number()) on every thread that was started, one at a time, but not on the caller's, and
    /// returns when all are done. For what belongs to a thread; `work` does not throw.
    void visit(const std::function<void(std::size_t)>& work);

    /// Of the thread that asks, for any: 0 for the caller's, else 1..threads - 1.
    static std::size_t number();

    /// Threads that may help on this machine, the caller's included: one per processor, four at most.
    static std::size_t useful();

  private:
    /// How long a thread looks before it sleeps.
    class Patience {
      public:
        /// Returns whether `ready` has become true.
        template <typename Ready>
        bool wait(const Ready& ready);

      private:
        static constexpr int least = 16, most = 128;  ///< 5 and 40 microseconds or so
        int looks_ = most;
    };

    void start_threads();
    void serve(const std::stop_token& stop, std::size_t number);
    void visit_if_due(std::size_t number);
    void begin_aside();
    void do_aside(std::unique_lock<std::mutex>& lock, Aside& aside);
    void take_pieces();

    std::size_t wished_;
    std::mutex mutex_;
    std::condition_variable_any begin_;
    std::condition_variable end_;
    /// Greater with everything that there is to be done. Changed under mutex_, as all of these are.
    std::atomic<std::size_t> round_{0};
    /// There may be pieces left: a thread that wakes too late is not waited for.
    bool open_ = false;
    std::atomic<std::size_t> inside_{0};  ///< other threads that work in this round
    const std::function<void(std::size_t)>* work_ = nullptr;
    std::size_t count_ = 0, most_ = all;
    std::atomic<std::size_t> next_{0};
    std::exception_ptr fault_;  ///< the first one
    Aside* aside_ = nullptr;
    const std::function<void(std::size_t)>* visit_ = nullptr;
    std::vector<bool> to_visit_;  ///< by number
    std::atomic<bool> burst_{false};
    Patience patience_;  ///< the caller's
    std::vector<std::jthread> threads_;
};

}  // namespace echoloop
