// The kernel's own threads that carry the bytes of pseudo-terminals and serial ports to their readers.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <thread>

namespace echoloop {

/// Linux hands what is written to a pseudo-terminal, or comes from a serial port, to a worker of its unbound
/// work queue, which takes its turn among ordinary programs. While one of these lives, such workers go before
/// them, and before the rendering of fans (Turn::kernel_workers), also those that the kernel makes meanwhile,
/// a quarter of a second after that; then they are as they were, also those that a killed program's left
/// raised. (Those of one that still lives, it raises again within a quarter of a second.) Needs CAP_SYS_NICE;
/// without it nothing changes and count() is 0.
class KernelWorkers {
  public:
    KernelWorkers();
    ~KernelWorkers();
    KernelWorkers(const KernelWorkers&) = delete;
    KernelWorkers& operator=(const KernelWorkers&) = delete;

    /// How many went first when this was made.
    std::size_t count() const { return count_; }

  private:
    /// How many go first now, by this or by somebody else.
    std::size_t raise_all();

    std::map<pid_t, int> raised_;  ///< by this or by one that did not live to put them back: priority before
    std::size_t count_;
    std::mutex mutex_;
    std::condition_variable_any ended_;
    std::jthread thread_;  // last: ended first
};

}  // namespace echoloop
