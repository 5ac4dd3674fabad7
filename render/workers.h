// A few threads that share out loops, for work too short to start threads for. Results never depend on their
// number: an index is one whole piece of work.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace echoloop {

class Workers {
  public:
    /// `threads` counts the caller's. None is started before the first loop that needs it.
    explicit Workers(std::size_t threads = useful()) : wished_(threads) {}
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// Calls work(i) once for every i below `count`, in any order and on any thread, and returns when all are
    /// done. Throws what one of the calls threw, once all have ended.
    void run(std::size_t count, const std::function<void(std::size_t)>& work);

    /// Threads that may help on this machine, the caller's included: one per processor, four at most.
    static std::size_t useful();

  private:
    void serve(std::stop_token stop);
    void take_pieces();

    std::size_t wished_;
    std::mutex mutex_;
    std::condition_variable_any begin_;
    std::condition_variable end_;
    std::size_t round_ = 0;  ///< of run(), under mutex_
    /// There may be pieces left, under mutex_: a thread that wakes too late is not waited for.
    bool open_ = false;
    std::size_t inside_ = 0;  ///< other threads that work in this round, under mutex_
    const std::function<void(std::size_t)>* work_ = nullptr;
    std::size_t count_ = 0;
    std::atomic<std::size_t> next_{0};
    std::exception_ptr fault_;  ///< the first one, under mutex_
    std::vector<std::jthread> threads_;
};

}  // namespace echoloop
