// A navigation unit of a survey vessel: a satellite receiver, a compass and a motion sensor in one box. It
// sends no sound; what it feels comes from where the device is. A pure state machine.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "emulator/contract/model.h"
#include "emulator/devices/family/talker/wiring.h"
#include "emulator/devices/nmea-ins/settings.h"

namespace echoloop::nmea_ins {

class NavigationUnit final : public Device {
  public:
    NavigationUnit(const Settings& settings, std::vector<talker::Wiring> wiring);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    /// It listens to nobody: what comes is counted.
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram&, Time) override { return {}; }
    /// Asks where it was at the moments whose words are due.
    Actions woken(Time now) override;
    Actions located(std::span<const Located> places, Time now) override;
    void reconnected(std::size_t) override {}
    DeviceCounters counters() const override { return counters_; }

  private:
    /// Whole parts of UTC: of the whole second in which the run began, and whole periods behind it.
    Time moment(std::size_t word) const;
    Time next_wake() const;
    /// Accelerations in m/s^2, the vertical one upwards.
    Bytes said(Word word, const survey::Reading& reading, double horizontal, double vertical) const;

    Settings settings_;
    std::vector<talker::Wiring> wiring_;
    survey::MotionUnit unit_;
    Time before_{};                                      ///< from that whole second to the start of the run
    std::array<std::int64_t, words.size()> next_{};      ///< number of the next moment of each word
    std::vector<std::array<bool, words.size()>> due_{};  ///< what is said of the moments asked for
    Located last_{};
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::nmea_ins
