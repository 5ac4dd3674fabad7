// The records of the sensors around a 7k sonar, for those who have subscribed to them: position, motion,
// heading and sound speed. Makes records; sends none.
#pragma once

#include <vector>

#include "emulator/devices/family/survey/motion_unit.h"
#include "emulator/devices/reson-7k/settings.h"
#include "protocols/reson7k/messages.h"

namespace echoloop::reson7k_device {

/// Types of the records that it makes.
std::span<const std::uint32_t> motion_records();

/// A record, and its time, s since 1970.
struct SensorRecord {
    reson7k::Message message;
    double time = 0;
};

class ShipSensors {
  public:
    /// `origin`: of the scene.
    ShipSensors(const Sensors& sensors, const GeoPlace& origin) : unit_(sensors, origin) {}

    /// Somebody wants them, after a time when nobody did.
    void start(Time now) { next_ = now; }
    /// When there is something to ask for.
    Time wake() const { return next_; }
    /// Moments since the last call, 50 a second; of a longer pause those of the last second.
    std::vector<Time> moments(Time now);
    /// All records of these moments.
    std::vector<SensorRecord> records(std::span<const Located> places, double unix_start);

  private:
    survey::MotionUnit unit_;
    Time next_{};
    std::uint64_t ticks_ = 0;
    double attitude_from_ = 0;  ///< s since 1970, of the first sample of attitude_
    reson7k::Attitude attitude_;
};

}  // namespace echoloop::reson7k_device
