// The lines of Tritech, Benthos and Imagenex.
#include <algorithm>
#include <cmath>

#include "emulator/devices/altimeters/altimeters.h"
#include "emulator/devices/family/tritech/padbt.h"

namespace echoloop::altimeters {
namespace {

constexpr int patience = 5;  // missed pings, until the previous distance is told no more

}  // namespace

TritechPa::TritechPa(const Tritech& settings, Wiring wiring)
    : Altimeter(settings.sounding, std::move(wiring), settings.free_running()), settings_(settings) {}

/// A '#' or a line end before or behind the letter does no harm.
Actions TritechPa::received(const Received& data, Time now) {
    const char letter = settings_.addressed() ? settings_.letter() : 'Z';
    for (const std::uint8_t byte : data.bytes) {
        const bool asks = byte == letter, frees = byte == 'F' && !settings_.addressed();
        ++(asks || frees ? counters_.messages : counters_.skipped_bytes);
        if (asks) ask(now);
        if (frees) run_freely(now);
    }
    return take_actions();
}

std::vector<std::string> TritechPa::lines(std::optional<double> metres, Time) {
    const double told = metres.value_or(settings_.maximum() ? settings_.sounding.range : 0);
    if (settings_.nmea()) return {tritech::padbt(told)};
    return {
        altimeter::write_line({.format = settings_.format(), .metres = told, .letter = settings_.letter()})};
}

BenthosPsa916::BenthosPsa916(const Benthos& settings, Wiring wiring)
    : Altimeter(settings.sounding, std::move(wiring)), settings_(settings), missed_(patience) {}

std::vector<std::string> BenthosPsa916::lines(std::optional<double> metres, Time) {
    altimeter::Reading reading{.format = altimeter::Format::benthos, .metres = 99.99, .mark = 'E'};
    if (metres) {
        missed_ = 0;
        last_ = *metres;
        reading.mark = *metres < settings_.nearest ? '<' : '\0';
    } else if (missed_ < patience) {
        ++missed_;
    }
    if (metres || (settings_.previous && missed_ < patience)) reading.metres = last_;
    return {altimeter::write_line(reading)};
}

std::vector<std::string> Imagenex863::lines(std::optional<double> metres, Time) {
    altimeter::Reading reading{.format = altimeter::Format::time};
    if (metres) {
        const double time = 2e6 * *metres / settings_.sounding.sound_speed;
        reading.microseconds = static_cast<std::uint16_t>(std::lround(std::min(time, 65535.0)));
        reading.level = static_cast<std::uint8_t>(std::lround(std::clamp(2 * above_noise_, 0.0, 255.0)));
    }
    return {altimeter::write_line(reading)};
}

}  // namespace echoloop::altimeters
