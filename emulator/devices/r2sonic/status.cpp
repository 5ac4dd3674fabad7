#include <cmath>

#include "emulator/devices/r2sonic/packets.h"

namespace echoloop::r2sonic_device {
namespace {

using namespace r2sonic;

/// GPS time runs ahead of UTC and counts from 6 January 1980; the leap seconds are those since 2017.
std::pair<std::uint32_t, std::uint32_t> gps_time(double unix_time) {
    constexpr double epoch = 315964800, leap_seconds = 18;
    const double gps = std::max(0.0, unix_time - epoch + leap_seconds);
    const double whole = std::floor(gps);
    return {static_cast<std::uint32_t>(whole), static_cast<std::uint32_t>((gps - whole) * 4294967296.0)};
}

const char* const firmware = "19-Dec-2011-17:19:29";  // the manual's example

constexpr std::uint32_t options = option_bits::truepix_snippets | option_bits::forward_looking |
                                  option_bits::water_column | option_bits::ultra_high_resolution;

/// Motion and sound speed, which head and SIM hear from the same sensors. Angles in rad.
template <class To>
void put_motion(const Settings& settings, const Health& health, To& to) {
    const auto read = settings.sensors.at(health.since_start);
    to.roll = read("roll", health.attitude.roll, deg_to_rad(1) * stray::motion);
    to.pitch = read("pitch", health.attitude.pitch, deg_to_rad(1) * stray::motion);
    to.heave = read("heave", 0, stray::depth);
    to.sound_speed = read("sound speed", settings.sound_speed, stray::sound_speed);
    if (health.motion) {
        to.roll = static_cast<float>(health.motion->roll);
        to.pitch = static_cast<float>(health.motion->pitch);
        to.heave = static_cast<float>(health.motion->heave);
    }
    if (health.sound_speed) to.sound_speed = static_cast<float>(*health.sound_speed);
}

}  // namespace

Sth0 head_status(const Settings& settings, const Health& health) {
    const auto [seconds, fraction] = gps_time(health.unix_time);
    const auto read = settings.sensors.at(health.since_start);
    SenA sensors;
    sensors.gps_seconds = seconds;
    sensors.gps_fraction = fraction;
    put_motion(settings, health, sensors);
    sensors.depth = sensors.depth_uncalibrated = read("depth", health.attitude.depth, stray::depth);
    sensors.fpga_temperature = read("FPGA", 35, stray::board_temperature);
    Sth0 status;
    status.sections = {
        Ser3{settings.serial},
        Prt3{"15000001"},
        Mdl3{settings.model},
        Fwv6{firmware},
        Fwt6{firmware},
        Prj9{settings.serial, "15000002", settings.model},
        Opt1{options},
        sensors,
        Adc3{read("head supply", 48, 48 * stray::supply), read("head current", 0.8, 0.8 * stray::current),
             read("transmitter supply", 60, 60 * stray::supply)},
        Eth6{1000, health.received, health.sent, 0, {0, 0, 0x02, 0, 0, 0, 0, 0x01}},
        Tim2{read("round trip", 1e-4, {.drift = 1e-6, .noise = 3e-6}), 0}};
    return status;
}

Sts0 sim_status(const Settings& settings, const Health& health) {
    const auto [seconds, fraction] = gps_time(health.unix_time);
    const auto read = settings.sensors.at(health.since_start);
    Sen7 sensors;
    sensors.gps_seconds = seconds;
    sensors.gps_fraction = fraction;
    put_motion(settings, health, sensors);
    constexpr std::uint32_t good = 3, off = 0;
    const auto lamp = [&](Input input) {
        return static_cast<std::uint32_t>(health.lamps[static_cast<std::size_t>(input)]);
    };
    const std::uint32_t lamps = lamp(Input::gps) | lamp(Input::motion) << 2 | lamp(Input::svp) << 6 |
                                good << 16 | (health.sync_pulses ? good : off) << 18 |
                                (health.head_on ? good : off)
                                    << 22;  // gps, motion, svp, pps, sync in, head on
    Sts0 status;
    status.sections = {
        Ser3{settings.sim_serial},
        Prt3{"15000003"},
        Mdl3{"SIM"},
        Fwv6{firmware},
        sensors,
        Adc2{read("SIM supply", 48, 48 * stray::supply), read("SIM current", 0.5, 0.5 * stray::current)},
        Eth6{1000, health.received, health.sent, 0, {0, 0, 0x02, 0, 0, 0, 0, 0x02}},
        Led1{lamps}};
    return status;
}

}  // namespace echoloop::r2sonic_device
