// What a host has asked for, and the ping that follows from it: rows, times, gain. Pure functions.
#pragma once

#include <optional>

#include "emulator/devices/oculus/settings.h"
#include "render/echogram.h"

namespace echoloop::oculus_device {

/// A fire message that makes sense; v1 has no more than `fire` of it.
struct Request {
    bool v2 = false;
    oculus::FireV2 wish;

    const oculus::Fire& fire() const { return wish.fire; }
    bool high() const { return fire().mode == oculus::Mode::high_frequency; }
    bool standby() const { return fire().rate == oculus::Rate::standby; }
    bool has(std::uint8_t flag) const { return (fire().flags & flag) != 0; }
    /// 0.5 to 1.
    double gamma() const { return fire().gamma == 0 ? 1 : (fire().gamma + 1) / 256.0; }
};

/// Nothing for a mode other than low or high, or a number that is not finite.
std::optional<Request> read_request(const oculus::Fire& fire);
std::optional<Request> read_request(const oculus::FireV2& fire);

const ModeFigures& figures_of(const Request& request, const Acoustics& acoustics);

/// The size and the times of a ping.
struct Plan {
    double sound_speed = 0;  ///< m/s, that the sonar works with
    double range = 0;        ///< m
    double row_time = 0;     ///< s, two-way, of one row
    std::size_t rows = 0;
    std::size_t beams = 0;
    oculus::DataSize data_size = oculus::DataSize::bits8;
    double gain = 0;      ///< %, effective
    double transfer = 0;  ///< s that the network takes for the message
    double period = 0;    ///< s to the next ping
    double due = 0;       ///< s from the transmission until the message can go

    double resolution() const { return sound_speed / 2 * row_time; }  ///< m per row
    std::size_t sample_bytes() const { return static_cast<std::size_t>(data_size) + 1; }
};
/// degC, as its own sensor reads.
double water_temperature(const Settings& settings, Time now);
Plan make_plan(const Request& request, const Settings& settings, Time now);

/// `plan` is the request's.
Shot make_shot(const Request& request, const Plan& plan, const Settings& settings, std::uint32_t ping);

/// m/s, of water near the surface: Medwin 1975. `temperature` in degC, `salinity` in ppt.
double sound_speed(double temperature, double salinity);

/// An address in host byte order as it stands in a message.
oculus::Ipv4 to_ipv4(std::uint32_t ip);

}  // namespace echoloop::oculus_device
