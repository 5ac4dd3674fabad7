#include "emulator/devices/teledyne-dvl/ensemble.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulator/devices/family/doppler/moment.h"
#include "protocols/teledyne/codec.h"
#include "protocols/waterlinked/pd4.h"

namespace echoloop::teledyne_dvl {
namespace {

constexpr double decibels_per_count = 0.61;  // Pathfinder guide

template <class T>
T fitted(double value) {
    constexpr double low = std::numeric_limits<T>::min(), high = std::numeric_limits<T>::max();
    return static_cast<T>(std::lround(std::clamp(value, low, high)));
}

std::uint8_t counts(double decibels) { return fitted<std::uint8_t>(decibels / decibels_per_count); }

std::uint8_t frame_bits(const Setup& setup) {
    return static_cast<std::uint8_t>((static_cast<unsigned>(setup.frame) << 3) | (setup.tilts ? 4U : 0U) |
                                     (setup.three_beams ? 2U : 0U) | (setup.bin_mapping ? 1U : 0U));
}

teledyne::FixedLeader fixed_leader(const Report& report, const Setup& setup, const Settings& settings) {
    teledyne::FixedLeader out;
    out.firmware = fitted<std::uint8_t>(settings.series->firmware);
    out.revision = fitted<std::uint8_t>(settings.series->revision);
    constexpr unsigned convex = 1U << 3, head = 1U << 6, janus = 4U << 12, thirty_degrees = 2U << 8;
    out.configuration = static_cast<std::uint16_t>(static_cast<unsigned>(settings.series->frequency_code) |
                                                   convex | head | thirty_degrees | janus);
    const bool profiles = !report.profile.empty();
    out.cells = profiles ? fitted<std::uint8_t>(setup.cells) : 0;
    out.pings = profiles ? 1 : 0;
    out.cell_size = fitted<std::uint16_t>(setup.cell_size);
    out.blank = fitted<std::uint16_t>(setup.blank);
    out.coordinates = frame_bits(setup);
    out.heading_alignment = fitted<std::int16_t>(setup.alignment);
    out.sensors_used = 0x1D;  // ET, ER, EP and EH from sensors; EC, ED and ES as they are set
    out.sensors_there = 0x1D;
    out.pulse = fitted<std::uint16_t>(100 * report.pulse);
    out.first_cell = fitted<std::uint16_t>(setup.blank + (setup.cell_size + out.pulse) / 2.0);
    out.serial_number = settings.serial_number;
    out.more.assign(settings.series->fixed_more, fitted<std::uint8_t>(rad_to_deg(settings.acoustics.tilt)));
    return out;
}

std::vector<std::uint8_t> variable_rest(const doppler::Moment& moment, std::size_t size) {
    std::vector<std::uint8_t> out(size);
    if (size == 8) {  // of a Workhorse: the clock with a century
        const int words[] = {moment.year() / 100, moment.year() % 100, moment.month(),  moment.day(),
                             moment.hour(),       moment.minute(),     moment.second(), moment.hundredth()};
        for (std::size_t i = 0; i < size; ++i) out[i] = static_cast<std::uint8_t>(words[i]);
    }
    if (size == 20) std::fill(out.begin() + 14, out.end(), 0xFF);  // no voltage, current or impedance
    return out;
}

teledyne::VariableLeader variable_leader(const Report& report, const Setup& setup, const Settings& settings) {
    const auto moment = doppler::moment_of(report.unix_us);
    teledyne::VariableLeader out;
    out.number = static_cast<std::uint16_t>(report.number);
    out.number_high = static_cast<std::uint8_t>(report.number >> 16);
    out.year = static_cast<std::uint8_t>(moment.year() % 100);
    out.month = static_cast<std::uint8_t>(moment.month());
    out.day = static_cast<std::uint8_t>(moment.day());
    out.hour = static_cast<std::uint8_t>(moment.hour());
    out.minute = static_cast<std::uint8_t>(moment.minute());
    out.second = static_cast<std::uint8_t>(moment.second());
    out.hundredth = static_cast<std::uint8_t>(moment.hundredth());
    out.sound_speed = fitted<std::uint16_t>(setup.sound_speed);
    out.depth = fitted<std::uint16_t>(setup.depth);
    out.heading = static_cast<std::uint16_t>(std::lround(100 * compass_heading(report.attitude)) % 36000);
    out.pitch = fitted<std::int16_t>(100 * tilt_pitch(report.attitude));
    out.roll = fitted<std::int16_t>(100 * rad_to_deg(report.attitude.roll));
    out.salinity = fitted<std::uint16_t>(setup.salinity);
    out.temperature = fitted<std::int16_t>(100 * report.temperature);
    out.pressure = fitted<std::uint32_t>(100 * pressure_of(setup));
    out.more = variable_rest(moment, settings.series->variable_more);
    return out;
}

teledyne::BottomTrack bottom_track(const Report& report, const Setup& setup, const Settings& settings) {
    teledyne::BottomTrack out;
    const Velocities velocities = bottom_velocities(report, setup);
    for (std::size_t i = 0; i < teledyne::beams; ++i) {
        const doppler::BeamReport& beam = report.measured.beams[i];
        const double range = 100 * vertical_range(beam, settings);
        const auto whole = static_cast<std::uint32_t>(std::lround(range));
        out.range[i] = static_cast<std::uint16_t>(whole);
        out.range_high[i] = static_cast<std::uint8_t>(whole >> 16);
        out.velocity[i] = millimetres(velocities[i]);
        out.correlation[i] = beam.valid ? 250 : 0;  // as a published ensemble has it over a hard bottom
        out.amplitude[i] = beam.valid ? counts(beam.rssi - beam.nsd) : 0;
        out.good[i] = beam.valid ? 100 : 0;
        out.rssi[i] = counts(beam.valid ? beam.rssi : beam.nsd);
    }
    if (report.water) {
        const Velocities of_water = water_velocities(report, setup);
        out.layer_least = fitted<std::uint16_t>(setup.layer_least);
        out.layer_near = fitted<std::uint16_t>(setup.layer_near);
        out.layer_far = fitted<std::uint16_t>(setup.layer_far);
        out.layer_correlation = report.water->correlation;
        out.layer_amplitude = report.water->amplitude;
        for (std::size_t i = 0; i < teledyne::beams; ++i) {
            out.layer_velocity[i] = millimetres(of_water[i]);
            out.layer_good[i] = report.water->measured.beams[i].valid ? 100 : 0;
        }
    }
    out.most_depth = fitted<std::uint16_t>(setup.most_depth);
    out.more.assign(settings.series->bottom_more, 0);
    return out;
}

std::uint8_t block_bits(const Setup& setup, const Settings& settings) {
    return static_cast<std::uint8_t>((static_cast<unsigned>(setup.frame) << 6) |
                                     (setup.tilts ? 1U << 5 : 0U) | (setup.three_beams ? 1U << 4 : 0U) |
                                     static_cast<unsigned>(settings.series->frequency_code));
}

/// Bits 0 to 3: a beam's correlation is low; 4: the bottom is too near.
std::uint8_t layer_status(const WaterLayer& layer) {
    unsigned bits = layer.too_shallow ? 1U << 4 : 0U;
    for (std::size_t i = 0; i < teledyne::beams; ++i)
        if (!layer.measured.beams[i].valid && !layer.too_shallow) bits |= 1U << i;
    return static_cast<std::uint8_t>(bits);
}

/// What PD4 and PD5 have in common.
template <class Block>
Block block_of(const Report& report, const Setup& setup, const Settings& settings) {
    Block out;
    out.configuration = block_bits(setup, settings);
    out.velocity = own_velocities(bottom_velocities(report, setup));
    for (std::size_t i = 0; i < teledyne::beams; ++i) {
        const doppler::BeamReport& beam = report.measured.beams[i];
        out.range[i] = fitted<std::uint16_t>(100 * vertical_range(beam, settings));
        if (!beam.valid)
            out.status = static_cast<std::uint8_t>(out.status | (2U << (2 * i)));  // low amplitude
    }
    out.water = own_velocities(water_velocities(report, setup));
    if (report.water) {
        out.layer_start = fitted<std::uint16_t>(setup.layer_near);
        out.layer_end = fitted<std::uint16_t>(setup.layer_far);
        out.layer_status = layer_status(*report.water);
    }
    const auto moment = doppler::moment_of(report.unix_us);
    out.hour = static_cast<std::uint8_t>(moment.hour());
    out.minute = static_cast<std::uint8_t>(moment.minute());
    out.second = static_cast<std::uint8_t>(moment.second());
    out.hundredth = static_cast<std::uint8_t>(moment.hundredth());
    out.sound_speed = fitted<std::uint16_t>(setup.sound_speed);
    out.temperature = fitted<std::int16_t>(100 * report.temperature);
    return out;
}

}  // namespace

double vertical_range(const doppler::BeamReport& beam, const Settings& settings) {
    return beam.valid && beam.distance > 0 ? beam.distance * std::cos(settings.acoustics.tilt) : 0;
}

/// tan(pitch) / cos(roll): Teledyne's booklet of coordinate transformation turns it back.
double tilt_pitch(const doppler::Attitude& attitude) {
    return rad_to_deg(std::atan2(std::tan(attitude.pitch), std::cos(attitude.roll)));
}

double compass_heading(const doppler::Attitude& attitude) {
    const double heading = rad_to_deg(attitude.heading);
    return heading < 0 ? heading + 360 : heading;
}

std::array<std::int16_t, 4> own_velocities(const Velocities& velocities) {
    std::array<std::int16_t, 4> out{};
    for (std::size_t i = 0; i < out.size(); ++i) {
        const bool turned = i < 3 && velocities[i].has_value();
        out[i] = millimetres(turned ? std::optional(-*velocities[i]) : velocities[i]);
    }
    return out;
}

std::int16_t millimetres(const std::optional<double>& velocity) {
    if (!velocity) return teledyne::bad;
    return static_cast<std::int16_t>(std::lround(std::clamp(1000 * *velocity, -32767.0, 32767.0)));
}

/// The bottom moves against the vehicle: astern of one that goes ahead, up to one that sinks.
Velocities in_frame(Vec3 v, std::optional<double> error, const doppler::Attitude& attitude,
                    const Setup& setup) {
    switch (setup.frame) {
        case Frame::beam:
        case Frame::instrument: {
            const Vec3 own = doppler::turned(v, -deg_to_rad(0.01 * setup.alignment));
            return {-own.y, -own.x, own.z, error};
        }
        case Frame::ship: {
            const Vec3 level = setup.tilts ? doppler::levelled(v, attitude) : v;
            return {-level.y, -level.x, level.z, error};
        }
        case Frame::earth:
            break;
    }
    const doppler::Attitude used =
        setup.tilts ? attitude : doppler::Attitude{.heading = attitude.heading, .pitch = 0, .roll = 0};
    const Vec3 world = doppler::in_world(v, used);
    return {-world.y, -world.x, world.z, error};
}

Velocities velocities_of(const doppler::Measured& m, const doppler::Attitude& attitude, const Setup& setup) {
    if (setup.frame == Frame::beam) {
        Velocities out;
        for (std::size_t i = 0; i < teledyne::beams; ++i)
            if (m.beams[i].valid) out[i] = m.beams[i].velocity;
        return out;
    }
    const bool all = std::ranges::all_of(m.beams, &doppler::BeamReport::valid);
    if (!m.valid || (!all && !setup.three_beams)) return {};
    return in_frame(m.velocity, all ? std::optional(m.error) : std::nullopt, attitude, setup);
}

Velocities bottom_velocities(const Report& report, const Setup& setup) {
    return velocities_of(report.measured, report.attitude, setup);
}

Velocities water_velocities(const Report& report, const Setup& setup) {
    return report.water ? velocities_of(report.water->measured, report.attitude, setup) : Velocities{};
}

Bytes ensemble_bytes(const Report& report, const Setup& setup, const Settings& settings) {
    teledyne::Ensemble out;
    out.sections = {fixed_leader(report, setup, settings), variable_leader(report, setup, settings)};
    out.sections.insert(out.sections.end(), report.profile.begin(), report.profile.end());
    if (setup.bottom_pings > 0) out.sections.emplace_back(bottom_track(report, setup, settings));
    return teledyne::encode(out);
}

Bytes pd4_bytes(const Report& report, const Setup& setup, const Settings& settings) {
    return waterlinked::encode(block_of<waterlinked::Pd4>(report, setup, settings));
}

Bytes pd5_bytes(const Report& report, const Setup& setup, const Settings& settings) {
    const auto leader = variable_leader(report, setup, settings);
    auto out = block_of<teledyne::Pd5>(report, setup, settings);
    out.salinity = fitted<std::uint8_t>(setup.salinity);
    out.depth = leader.depth;
    out.pitch = leader.pitch;
    out.roll = leader.roll;
    out.heading = leader.heading;
    for (std::size_t i = 0; i < teledyne::beams; ++i) {
        out.way[i] = fitted<std::int32_t>(10 * report.way[i]);
        out.way_in_water[i] = fitted<std::int32_t>(10 * report.way_in_water[i]);
    }
    return teledyne::encode(out);
}

}  // namespace echoloop::teledyne_dvl
