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
    Time transmitted{}, late{}, drawn{}, due{};
    Echogram echogram{};
    std::vector<Pose> movers{};
    double unix_time = 0;
    Pose world_from_body{};
    Motion body{}, sonar{};
    std::vector<std::string> faults{};
};

/// As SeenFault.
struct Fault {
    std::string device{}, port{};
    double unix_time = 0;
    std::string text{};
    bool on_message = false, sent = false;
};

/// Without its echogram.
inline Ping course_of(const SeenPing& ping) {
    Ping course{.device = std::string(ping.device),
                .number = ping.number,
                .transmitted = ping.transmitted,
                .late = ping.late,
                .drawn = ping.drawn,
                .due = ping.due,
                .movers = ping.movers,
                .unix_time = ping.unix_time,
                .world_from_body = ping.world_from_body,
                .body = ping.body,
                .sonar = ping.sonar,
                .faults = ping.faults};
    course.echogram.world_from_sonar = ping.echogram.world_from_sonar;
    return course;
}

inline Ping kept(const SeenPing& ping) {
    return {std::string(ping.device),
            ping.number,
            ping.transmitted,
            ping.late,
            ping.drawn,
            ping.due,
            ping.echogram,
            ping.movers,
            ping.unix_time,
            ping.world_from_body,
            ping.body,
            ping.sonar,
            ping.faults};
}

}  // namespace echoloop::bag
