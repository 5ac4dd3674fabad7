// A lock between threads of different priorities: who holds it runs, while others wait for it, as urgently as
// the most urgent of them. With a plain one the thread of the wires would wait for a render thread that
// itself has to wait for single beams. POSIX only; knows no pings.
#pragma once

#include <pthread.h>
#include <semaphore.h>

#include <cerrno>

namespace echoloop {

/// Who holds it runs, while others wait for it, as urgently as the most urgent of them
/// (PTHREAD_PRIO_INHERIT). With a plain one the thread of the wires would wait for a render thread that
/// itself has to wait for single beams.
class PriorityMutex {
  public:
    PriorityMutex() {
        pthread_mutexattr_t attributes;
        ::pthread_mutexattr_init(&attributes);
        ::pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
        ::pthread_mutex_init(&mutex_, &attributes);
        ::pthread_mutexattr_destroy(&attributes);
    }
    ~PriorityMutex() { ::pthread_mutex_destroy(&mutex_); }
    PriorityMutex(const PriorityMutex&) = delete;
    PriorityMutex& operator=(const PriorityMutex&) = delete;

    void lock() { ::pthread_mutex_lock(&mutex_); }
    void unlock() { ::pthread_mutex_unlock(&mutex_); }

  private:
    pthread_mutex_t mutex_{};
};

/// A thread that sleeps until it is called. To call it never takes long: the caller does not wait for it to
/// run, as who signals a condition variable of the GNU C library does for those that were called before.
class Sleeper {
  public:
    Sleeper() { ::sem_init(&called_, 0, 0); }
    ~Sleeper() { ::sem_destroy(&called_); }
    Sleeper(const Sleeper&) = delete;
    Sleeper& operator=(const Sleeper&) = delete;

    void sleep() {
        while (::sem_wait(&called_) != 0 && errno == EINTR) {
        }
    }
    void call() { ::sem_post(&called_); }

  private:
    sem_t called_{};
};

}  // namespace echoloop
