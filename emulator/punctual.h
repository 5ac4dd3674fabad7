// Asks the kernel to wake the calling thread on time. It changes no other thread, and nothing that a ping
// holds.
#pragma once

namespace echoloop {

/// What needs no privilege: timers without slack, and, where the kernel knows it (Linux 6.12), turns so short
/// that a thread which wakes comes before busy ones. What the kernel refuses stays as it is.
void wake_on_time();

/// Before all ordinary threads of the machine (SCHED_FIFO), and no page of the program leaves memory. Throws
/// StartError with the remedy if that is not permitted.
void claim_real_time();

}  // namespace echoloop
