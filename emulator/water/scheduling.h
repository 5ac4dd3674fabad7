// How the system shares processors between this program's threads, and keeps memory at hand for them. Asks
// for nothing that needs rights; where a system does not know of it, nothing happens.
#pragma once

namespace echoloop {

/// For a thread that computes for others: gives way to those that serve a wire, and among its like the more
/// the greater `nice` (1..19).
void give_way(int nice);

/// Mesa's software rasteriser shares every picture out to threads of its own and waits for them: for pictures
/// as small as a sonar's that saves less time than several contexts do, each on its own thread. Before the
/// first context; a user's own LP_NUM_THREADS counts.
void keep_rasterisers_on_their_threads();

/// Freed memory stays with this process (GNU C library): echograms and messages of megabytes come and go with
/// every ping, and to get their pages anew would take longer than to fill them. Before other threads start.
void keep_freed_memory();

}  // namespace echoloop
