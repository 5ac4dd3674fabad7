#include "emulator/devices/dvl-wayfinder/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "emulator/devices/dvl-wayfinder/commands.h"
#include "emulator/devices/family/doppler/moment.h"

namespace echoloop::dvl_wayfinder {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

float as_word(double value) { return static_cast<float>(value); }

/// m/s: x to starboard, y ahead, z up, error, of a log whose beam 3 looks ahead; or along each beam.
std::array<float, wayfinder::beams> velocities(const doppler::Measured& m, const Settings& settings) {
    std::array<float, wayfinder::beams> out{none, none, none, none};
    if (settings.frame == Frame::beam) {
        for (std::size_t i = 0; i < out.size(); ++i)
            if (m.beams[i].valid) out[i] = as_word(m.beams[i].velocity);
        return out;
    }
    if (!m.valid) return out;
    out = {as_word(m.velocity.y), as_word(m.velocity.x), as_word(-m.velocity.z), none};
    if (std::ranges::all_of(m.beams, &doppler::BeamReport::valid)) out[3] = as_word(m.error);
    return out;
}

void put_ranges(wayfinder::Data& out, const doppler::Measured& m, const Settings& settings) {
    const double share = settings.slant_ranges ? 1 : std::cos(settings.acoustics.tilt);
    double total = 0;
    int heard = 0;
    out.range.fill(none);
    for (std::size_t i = 0; i < out.range.size(); ++i) {
        if (!m.beams[i].valid) continue;
        const double range = share * m.beams[i].distance;
        out.range[i] = as_word(range);
        total += range;
        ++heard;
    }
    out.mean_range = heard > 0 ? as_word(total / heard) : none;
}

}  // namespace

wayfinder::Data report_of(const doppler::Measured& m, std::int64_t unix_us, Time began, const Settings& s) {
    wayfinder::Data out;
    out.firmware = firmware;
    const auto moment = doppler::moment_of(unix_us);
    out.year = static_cast<std::uint8_t>(moment.year() % 100);
    out.month = static_cast<std::uint8_t>(moment.month());
    out.day = static_cast<std::uint8_t>(moment.day());
    out.hour = static_cast<std::uint8_t>(moment.hour());
    out.minute = static_cast<std::uint8_t>(moment.minute());
    out.second = static_cast<std::uint8_t>(moment.second());
    out.millisecond = static_cast<std::uint16_t>(10 * moment.hundredth());
    out.frame = static_cast<std::uint8_t>(s.frame);
    out.velocity = velocities(m, s);
    put_ranges(out, m, s);
    out.sound_speed = as_word(m.speed_of_sound);
    out.voltage = as_word(s.sensors.read("supply", s.voltage, s.voltage * stray::supply, began));
    out.transmit_voltage =
        as_word(s.sensors.read("transmitter", s.transmit_voltage, s.transmit_voltage * stray::supply, began));
    out.current = as_word(s.sensors.read("current", s.current, s.current * stray::current, began));
    char number[8];
    std::snprintf(number, sizeof number, "%06u", static_cast<unsigned>(s.serial_number % 1000000));
    out.serial_number = wire::Text<6>(number);
    return out;
}

}  // namespace echoloop::dvl_wayfinder
