// What a Kongsberg multibeam passes on of the sensors around it, in datagrams of their own: position, clock,
// motion and the sound speed at the head. Makes datagrams; sends none.
#pragma once

#include <vector>

#include "emulator/devices/family/survey/motion_unit.h"
#include "emulator/devices/kongsberg-kmall/settings.h"
#include "protocols/kmall/messages.h"

namespace echoloop::kongsberg_kmall {

class ShipSensors {
  public:
    explicit ShipSensors(const Settings& settings);

    /// When something is to be said next; Time::max(): never.
    Time wake() const;
    /// Moments of which the next datagrams tell; none before wake(). A motion sensor's samples are told once
    /// a second, so that they lie behind.
    std::vector<Time> moments(Time now);
    /// The datagrams of the moments that were asked for last.
    std::vector<kmall::Datagram> datagrams(std::span<const Located> places, const Settings& settings);

  private:
    enum class Asked { nothing, fix, motion };
    kmall::Header header(const char* type, std::uint8_t version, Time time, const Settings& settings) const;
    void tell_fix(const survey::Reading& fix, const Settings& settings,
                  std::vector<kmall::Datagram>& out) const;
    kmall::Motion motion(std::span<const Located> places, const Settings& settings);

    survey::MotionUnit fixes_, motions_;
    Time next_fix_, next_motion_;
    Asked asked_ = Asked::nothing;
};

}  // namespace echoloop::kongsberg_kmall
