// Where a body was and is: poses at times, and the pose between them. Knows no clock and reads nothing.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "emulator/contract/device.h"
#include "render/motion.h"

namespace echoloop {

/// Shortest rotation from `a` to `b`, `part` of the way; unit quaternions.
Quat slerp(Quat a, Quat b, double part);
/// Position on the straight line, orientation by slerp; `part` beyond 0..1 goes on in the same way.
Pose between(const Pose& a, const Pose& b, double part);

/// The steady motion from `a` to `b`. Exactly 0 where that is less than rounding, or too swift for anything.
Motion motion_between(const Pose& a, const Pose& b, double seconds);

/// Where the stretch of a track lies whose change of pose is taken for the motion at a time.
enum class MotionStretch {
    around,  ///< half before, half after: all is known
    before,  ///< it ends at the time: what comes later may not be known yet
    known,   ///< it ends an interval between poses earlier, so that no pose to come corrects it: no steps
};

struct TrackRules {
    double extrapolation = 1.5;  ///< times the last interval: for how long a body is taken to move on
    double steady = 0.5;         ///< s, poses further apart than this do not tell how it moves
    double stale_after = 1;      ///< s without a pose
    double fastest = 20;         ///< m/s; a faster change is a jump, and nothing lies between its ends
    std::size_t most = 100000;   ///< poses that are kept; the oldest go first
    MotionStretch stretch = MotionStretch::known;
};

class Track {
  public:
    explicit Track(TrackRules rules = {}) : rules_(rules) {}

    /// Times must grow: an earlier one than the last begins a new track. Returns false for a jump.
    bool add(Time time, const Pose& pose);

    struct Answer {
        Pose pose;
        bool stale = false;  ///< the last pose is too old to be trusted
    };
    /// At the time of a pose: that pose to the last bit, whether or not a later one is known. Before the
    /// first: the first. After the last: on for a while in the same way, then where it was last. Empty if
    /// there are no poses.
    std::optional<Answer> at(Time time) const;

    /// The mean over a tenth of a second, or over an interval between poses where MotionStretch::known needs
    /// more; never across a jump. Exactly 0 at rest, before the first pose and some time after the last.
    Motion motion(Time time) const;

    void clear() { poses_.clear(); }
    bool empty() const { return poses_.empty(); }
    std::size_t size() const { return poses_.size(); }
    Time first() const { return poses_.front().time; }
    Time last() const { return poses_.back().time; }

  private:
    struct Entry {
        Time time;
        Pose pose;
        bool jumped = false;  ///< from the one before
    };
    using Entries = std::deque<Entry>;
    Answer after_last(Time time) const;
    /// s between this pose and the one before; 0 where there is none, or a jump.
    double interval(Entries::const_iterator pose) const;

    TrackRules rules_;
    Entries poses_;
};

}  // namespace echoloop
