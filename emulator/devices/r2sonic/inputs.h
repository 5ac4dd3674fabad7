// The inputs of a SIM: a motion sensor, a satellite receiver and a sound velocity probe, each on a serial
// line or by UDP. Opens nothing and knows no clock.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/contract/device.h"
#include "emulator/contract/endpoint.h"
#include "emulator/devices/r2sonic/sensor_lines.h"
#include "protocols/r2sonic/messages.h"

namespace echoloop::r2sonic_device {

/// In the order of the endpoints behind that of the SIM.
enum class Input : std::size_t { motion, gps, svp };
inline constexpr std::size_t input_count = 3;

/// As LED1 shows them.
enum class Lamp : std::uint32_t { off = 0, bad = 2, good = 3 };

class Inputs {
  public:
    /// What is wired, as the scenario has it: endpoints `first` and so on belong to inputs. One that is not
    /// wired hears what is true, as from a perfect sensor.
    Inputs(const std::vector<Endpoint>& all, std::size_t first);

    std::vector<Port> ports() const;
    std::size_t count() const { return wired_.size(); }
    bool is_wired(Input input) const { return static_cast<std::size_t>(input) < wired_.size(); }

    /// ENx0 switches an input off and on, BDx0 is its baud, PTx0 its UDP port; others change nothing.
    void obey(const r2sonic::Command& command);
    /// `index` of ports(). `unix_time`: the true one, s, on whose whole seconds the receiver's pulses come.
    void received(std::size_t index, ByteView bytes, Time now, double unix_time);
    void reconnected(std::size_t index) { wired_.at(index).pending.clear(); }
    void line_rate(std::size_t index, double rate) { wired_.at(index).rate = rate; }

    /// Wired and said lately.
    std::optional<MotionReading> motion(Time now) const;
    /// m/s, as the probe said last.
    std::optional<double> sound_speed() const { return sound_speed_; }
    /// The SIM's clock, s of Unix time, which its receiver has set; it counts from 1970 before.
    double clock(Time now, double unix_time) const;
    Lamp lamp(Input input, Time now) const;

    DeviceCounters counters() const { return counters_; }

  private:
    struct Line {
        Endpoint endpoint{};
        std::size_t place = 0;  ///< among the device's endpoints
        bool on = true;
        std::uint32_t baud = 0;      ///< as commanded; 0: as the line is
        std::uint32_t udp_port = 0;  ///< as commanded; 0: that of its endpoint
        double rate = 0;             ///< bit/s, as the other end has set it; 0: it has not
        std::string pending{};
        std::optional<Time> last_good{};
    };
    bool hears(const Line& line) const;
    bool take(Input input, std::string_view line, Time now, double unix_time);
    bool take_time(std::string_view line, Time now, double unix_time);

    std::vector<Line> wired_;
    MotionReading motion_;
    std::optional<double> sound_speed_;
    std::optional<double> clock_ahead_;  ///< s before the true time
    std::optional<Time> last_trimble_;
    DeviceCounters counters_;
};

}  // namespace echoloop::r2sonic_device
