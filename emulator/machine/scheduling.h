// How the kernel shares its processors and memory between this program and others. What a user may not ask
// for changes nothing, except the real-time priority and the locked memory of --realtime, which are refused
// with the remedy.
#pragma once

namespace echoloop {

/// SCHED_FIFO priorities of a run that goes before all ordinary programs of the machine.
enum class Priority { rendering = 1, wires = 2 };

/// For the calling thread, and for those that it starts from then on; not for those that Priority::wires
/// starts. Throws StartError with the remedy if that is not permitted.
void claim_real_time(Priority priority);

/// No page of the program leaves memory. Throws StartError with the remedy if that is not permitted.
void lock_memory();

/// For a thread that must wake on time: timers without slack and, where the kernel knows it (Linux 6.12),
/// turns so short that it comes before busy threads when it wakes.
void wake_on_time();

/// For a thread that computes: gives way to those that serve a wire, the more the greater `nice` (1 to 19).
void give_way(int nice);

/// Mesa's software rasteriser shares every picture out to threads of its own and waits for them. For pictures
/// as small as a sonar's, several contexts with a thread each are faster. Before the first context; a user's
/// own LP_NUM_THREADS counts.
void keep_rasterisers_on_their_threads();

/// Freed memory stays with this process (GNU C library): echograms and messages of megabytes come and go with
/// every ping, and getting their pages anew takes longer than filling them. Before other threads start.
void keep_freed_memory();

/// What has been freed until now goes back to the system all the same: reading a scene takes several times
/// the memory of what is read.
void return_freed_memory();

}  // namespace echoloop
