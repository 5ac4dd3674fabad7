// Asks the kernel to wake the calling thread on time, and its memory to stay. Changes nothing that a ping
// holds.
#pragma once

#include <pthread.h>

namespace echoloop {

/// What needs no privilege: timers without slack, and, where the kernel knows it (Linux 6.12), turns so short
/// that a thread which wakes comes before busy ones. What the kernel refuses stays as it is.
void wake_on_time();

/// Who goes before whom in a run that was asked to be on time: SCHED_FIFO priorities.
enum class Turn {
    ordinary = 0,  ///< among all other programs
    less_urgent_fans = 3,
    fans = 4,
    urgent_fans = 5,
    listeners = 6,
    kernel_workers = 7,  ///< which carry the bytes of lines: behind none that takes many milliseconds
    single_beams = 8,
    wires = 9,
    watchers = 10
};

/// The calling thread goes before all ordinary threads of the machine, and so do those that it starts from
/// then on (not those of Turn::wires: none of them serves a wire). Throws StartError with the remedy if that
/// is not permitted.
void claim_real_time(Turn turn);

/// The same for another thread of a run that has been permitted it.
void give_turn(pthread_t thread, Turn turn);

/// No page of the program leaves memory. Throws StartError with the remedy if that is not permitted.
void lock_memory();

}  // namespace echoloop
