#include "emulator/devices/edgetech-2205/sonar_data.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "protocols/edgetech/codec.h"
#include "protocols/wire/bytes.h"

namespace echoloop::edgetech_2205 {
namespace {

constexpr double full_scale = 32767;    // so that readers that take samples for signed ones are right, too
constexpr double clipping = 10;         // V; own choice: nothing public says what a sample is in uPa
constexpr double turn = 32768.0 / 180;  // of pitch and roll, per deg
constexpr double knot = 1852.0 / 3600;  // m/s
constexpr double arc = 60e4;            // units of position in a degree

std::int16_t short_of(double value) {
    return static_cast<std::int16_t>(std::clamp(std::round(value), -32768.0, 32767.0));
}

}  // namespace

int Weighting::of(double peak) {
    constexpr double room = 8;
    if (!(peak > 0)) return bits_;
    while (bits_ > 0 && std::ldexp(peak, bits_) > full_scale) --bits_;
    if (std::ldexp(peak, bits_) * room < full_scale)
        while (bits_ < most && std::ldexp(peak, bits_ + 1) <= full_scale) ++bits_;
    return bits_;
}

edgetech::SonarData sonar_data(const Echogram& echogram, std::size_t side, const Settings& settings,
                               Weighting& weighting) {
    const auto beam = echogram.beam(side);
    // uPa to V; without acoustics an echo is 0 to 1.
    const double clip = settings.acoustics.receiver.saturation_level;
    const double volts =
        echogram.rule == EchoRule::cerqueira2016 ? clipping : clipping * std::pow(10, -clip / 20);
    const float strongest = beam.empty() ? 0 : std::ranges::max(beam);
    edgetech::SonarData data;
    const int bits = weighting.of(volts * std::sqrt(std::max(0.0, double(strongest))));
    data.weighting = static_cast<std::int16_t>(bits);
    edgetech::set_sample_count(data, beam.size());
    data.data.resize(2 * beam.size());
    const double scale = std::ldexp(volts, bits);
    double peak = 0;
    for (std::size_t i = 0; i < beam.size(); ++i) {
        const double sample =
            std::min(full_scale, std::round(scale * std::sqrt(std::max(0.0, double(beam[i])))));
        peak = std::max(peak, sample);
        wire::store<wire::ByteOrder::little>(static_cast<std::uint16_t>(sample), data.data.data() + 2 * i);
    }
    data.converter_maximum = static_cast<std::uint16_t>(peak);
    return data;
}

void describe_ping(edgetech::SonarData& data, const Subsystem& subsystem, std::size_t band,
                   const Settings& settings) {
    const Band& b = settings.acoustics.bands[band];
    data.ping = subsystem.number;
    data.interval = interval_of(subsystem, settings);
    data.sample_rate = static_cast<std::uint16_t>(std::lround(1e9 / data.interval));
    data.power = 100;
    edgetech::set_frequencies(data, b.frequency - b.bandwidth / 2, b.frequency + b.bandwidth / 2);
    constexpr unsigned sweep_shift = 4, sweep_mask = 0x3FF;
    const auto microseconds = static_cast<unsigned>(std::lround(1e6 * b.pulse_length));
    data.sweep = static_cast<std::uint16_t>(microseconds / 1000);
    data.low_bits_2 = static_cast<std::uint16_t>((microseconds % 1000 & sweep_mask) << sweep_shift);
    data.mixer = static_cast<float>(b.frequency);
    data.pulses_in_water = 1;
    data.spherical_correction = -1;
    data.sound_speed = static_cast<float>(settings.sound_speed);
    data.validity |= edgetech::valid::sound_speed;
    data.software = "echolp";
}

void stamp(edgetech::SonarData& data, double time) {
    constexpr std::int64_t day = 86'400'000;
    const auto milliseconds = static_cast<std::int64_t>(std::floor(1e3 * time));
    const std::time_t seconds = milliseconds / 1000;
    std::tm at{};
    ::gmtime_r(&seconds, &at);
    data.seconds = static_cast<std::int32_t>(seconds);
    data.milliseconds = static_cast<std::uint32_t>(milliseconds % day);
    data.year = data.fix_year = static_cast<std::int16_t>(at.tm_year + 1900);
    data.day = data.fix_day = static_cast<std::int16_t>(at.tm_yday + 1);
    data.hour = data.fix_hour = static_cast<std::int16_t>(at.tm_hour);
    data.minute = data.fix_minute = static_cast<std::int16_t>(at.tm_min);
    data.second = data.fix_second = static_cast<std::int16_t>(at.tm_sec);
}

void tell_place(edgetech::SonarData& data, const survey::Reading& reading, double depth, bool has_position) {
    namespace valid = edgetech::valid;
    data.heading = static_cast<std::uint16_t>(std::lround(100 * reading.heading) % 36000);
    data.pitch = short_of(turn * reading.pitch);
    data.roll = short_of(turn * reading.roll);
    data.depth = static_cast<std::int32_t>(std::lround(1e3 * std::max(0.0, depth)));
    data.course = short_of(reading.course);
    data.speed = short_of(10 * reading.speed / knot);
    data.validity |= valid::heading | valid::pitch_roll | valid::depth | valid::course | valid::speed;
    if (!has_position) return;
    data.position_units = 2;
    data.x = static_cast<std::int32_t>(std::lround(arc * reading.place.longitude));
    data.y = static_cast<std::int32_t>(std::lround(arc * reading.place.latitude));
    // A known reader takes a position that equals these bytes for an obsolete header.
    if (data.x == 0 && data.y == 0) data.x = 1;
    data.validity |= valid::position;
}

}  // namespace echoloop::edgetech_2205
