// One line of the ground truth (docs/truth.md) as what a picture and points are made of. Pure functions of
// text from outside.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/pose.h"

namespace echoloop::poses {

/// A stretch of bins in which the same object is heard.
struct ObjectRun {
    std::uint32_t object = 0;  ///< number in the list of objects, from 1
    std::size_t first = 0, bins = 0;
};

struct TruthBeam {
    double bearing = 0;           ///< rad, clockwise, pan included
    Vec3 axis{};                  ///< unit vector in the sonar's coordinates
    std::optional<double> range;  ///< m, the first surface on its axis
    std::vector<ObjectRun> objects;
};

struct TruthPing {
    std::string device;
    double unix_time = 0;  ///< s since 1970
    Pose world_from_sonar;
    double first_range = 0, bin_size = 0;  ///< m, where bin 0 begins, and of each
    std::size_t bins = 0, row_beams = 0;   ///< beams in a row; rows come one after the other
    double beam_width = 0;                 ///< rad
    std::vector<TruthBeam> beams;

    double range() const { return first_range + static_cast<double>(bins) * bin_size; }
};

struct TruthLine {
    bool header = false;  ///< the first line of a file
    std::optional<TruthPing> ping;
    std::string reason;  ///< why it says nothing
};

TruthLine read_truth(std::string_view line);

/// The object that is heard at a range of a beam; 0: none.
std::uint32_t object_at(const TruthPing& ping, const TruthBeam& beam, double range);

}  // namespace echoloop::poses
