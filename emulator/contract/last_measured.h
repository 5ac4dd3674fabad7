// What a sensor that measures now and then still tells, whatever the truth does meanwhile.
#pragma once

#include <cmath>
#include <optional>

#include "emulator/contract/sensors.h"

namespace echoloop {

/// The noise of such a reading stands still by itself (Stray::every); this holds the truth below it.
class LastMeasured {
  public:
    /// The truth as it was when the sensor last measured; the truth itself where sensors are exact.
    double of(double truth, const Sensors& sensors, const Stray& stray, Time now) {
        const double turn = stray.every > 0 ? std::floor(to_seconds(now) / stray.every) : 0;
        const bool holds = sensors.swing(1) > 0 && stray.every > 0 && turn == turn_;
        if (!holds || !value_) value_ = truth;
        turn_ = turn;
        return *value_;
    }

  private:
    std::optional<double> value_;
    double turn_ = -1;
};

}  // namespace echoloop
