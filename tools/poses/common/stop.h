// Ctrl-C and SIGTERM as a flag that loops look at. Ends nothing itself.
#pragma once

#include <chrono>
#include <thread>

namespace echoloop::poses {

/// From now on these signals only raise the flag.
void catch_signals();
bool stopped();

/// Waits until `ready`, for 5 s at most: a subscriber that has just come may not be known yet.
template <class Ready>
void wait_a_while(Ready ready) {
    using namespace std::chrono;
    for (const auto end = steady_clock::now() + seconds(5);
         !stopped() && !ready() && steady_clock::now() < end;)
        std::this_thread::sleep_for(milliseconds(5));
}

}  // namespace echoloop::poses
