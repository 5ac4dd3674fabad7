// What an altimeter's line needs besides the distance. family/sounder/talking_sounder.h has how it pings.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/devices/family/sounder/talking_sounder.h"

namespace echoloop::altimeters {

class Altimeter : public echosounder::TalkingSounder {
  public:
    Altimeter(const echosounder::Sounding& sounding, std::vector<echosounder::Wiring> wiring,
              bool free_running = true)
        : TalkingSounder(
              sounding, std::move(wiring),
              [this](std::optional<double> metres, Time now) { return lines(metres, now); }, free_running) {}

    Actions heard(const Echogram& echogram, Time now) override {
        depth_ = std::max(0.0, -echogram.world_from_sonar.position.z);
        const auto bottom = echosounder::find_bottom(echogram, {.margin = 0});
        above_noise_ = bottom ? std::min(bottom->above_noise, 200.0) : 0;
        return TalkingSounder::heard(echogram, now);
    }

  protected:
    /// What it says of one ping; no distance: no bottom.
    virtual std::vector<std::string> lines(std::optional<double> metres, Time now) = 0;

    double depth_ = 0;        ///< m below the surface, at the last ping
    double above_noise_ = 0;  ///< dB, of its strongest echo
};

}  // namespace echoloop::altimeters
