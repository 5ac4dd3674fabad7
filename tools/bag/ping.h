// A ping as it is kept until somebody has the time to show it or to write it down.
#pragma once

#include <string>
#include <vector>

#include "emulator/capture/watch.h"

namespace echoloop::bag {

/// As SeenPing.
struct Ping {
    std::string device{};
    std::uint64_t number = 0;
    Time transmitted{}, late{};
    Echogram echogram{};
    std::vector<Pose> movers{};
    double unix_time = 0;
    Pose world_from_body{};
    Motion body{}, sonar{};
    Time due{};
    std::vector<std::string> faults{};
};

inline Ping kept(const SeenPing& ping) {
    return {std::string(ping.device),
            ping.number,
            ping.transmitted,
            ping.late,
            ping.echogram,
            ping.movers,
            ping.unix_time,
            ping.world_from_body,
            ping.body,
            ping.sonar,
            ping.due,
            ping.faults};
}

}  // namespace echoloop::bag
