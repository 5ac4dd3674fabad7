// A Tritech Micron Echosounder: the stand-alone altimeter on a serial line of its own. A pure state machine;
// family/talking_sounder.h has how it pings.
#pragma once

#include "emulator/devices/family/sounder/talking_sounder.h"
#include "emulator/devices/micron-echosounder/settings.h"

namespace echoloop::micron_echosounder {

/// The line of one reading; no depth: no echo. Empty where it then says nothing.
std::string reading(const Settings& settings, std::optional<double> depth);

class Echosounder final : public echosounder::TalkingSounder {
  public:
    Echosounder(const Settings& settings, std::vector<echosounder::Wiring> wiring);

    /// 'Z': it stops pinging by itself and says one reading. 'F': it pings by itself.
    Actions received(const Received& data, Time now) override;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::micron_echosounder
