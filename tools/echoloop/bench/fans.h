// How `echoloop run` serves several multibeams at once, and single beams beside them: how many pings a
// second, how late, and what they are spared where it is too many.
#pragma once

#include <cstddef>
#include <filesystem>

namespace echoloop::bench {

struct FansFigures {
    char failure[512] = {};
    std::size_t fans = 0, heads = 0;
    double seconds = 0;          ///< s, of the run
    double cpu = 0;              ///< s that all its threads computed meanwhile, start-up left out
    double pings = 0, late = 0;  ///< of all sonars together
    double head_pings = 0, late_head_pings = 0;   ///< of those, the single beams'
    double spared = 0, coarse = 0;                ///< pings, as SessionSummary has them
    double p99_lateness = 0, worst_lateness = 0;  ///< s, of the sonar that has the largest
    double pings_a_second() const { return pings / seconds; }
    double processors() const { return cpu / seconds; }                ///< that were busy with it
    double cpu_a_ping() const { return pings > 0 ? cpu / pings : 0; }  ///< s; a coarse one takes less
};

/// `fans` multibeams of 256 beams with bathymetry and image at 10 Hz, in front of the manifold, each at a
/// loopback address of its own; and `heads` single beams all around at 10 Hz, which need no host:
/// echosounders of 40 m. `example`: a file beside whose scenes/manifold.glb it could lie.
FansFigures measure_fans(std::size_t fans, std::size_t heads, double seconds,
                         const std::filesystem::path& example);

}  // namespace echoloop::bench
