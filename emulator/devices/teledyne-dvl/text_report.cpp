#include <algorithm>
#include <cmath>
#include <span>

#include "emulator/devices/family/doppler/moment.h"
#include "emulator/devices/teledyne-dvl/ensemble.h"
#include "protocols/waterlinked/pd6.h"

namespace echoloop::teledyne_dvl {
namespace {

using VelocitiesOf = Velocities (*)(const Report&, const Setup&);

/// mm/s in that frame, and whether they are good.
bool put_velocities(std::span<int> out, Frame frame, VelocitiesOf velocities, const Report& report,
                    Setup setup) {
    setup.frame = frame;
    const auto own = own_velocities(velocities(report, setup));
    std::copy_n(own.begin(), out.size(), out.begin());
    return own[0] != teledyne::bad;
}

waterlinked::Pd6Track track_of(VelocitiesOf velocities, const Report& report, const Setup& setup) {
    waterlinked::Pd6Track track;
    track.instrument_good = put_velocities(track.instrument, Frame::instrument, velocities, report, setup);
    track.ship_good = put_velocities(track.ship, Frame::ship, velocities, report, setup);
    track.earth_good = put_velocities(track.earth, Frame::earth, velocities, report, setup);
    return track;
}

std::string bottom_lines(const Report& report, const Setup& setup) {
    waterlinked::Pd6Track track = track_of(bottom_velocities, report, setup);
    std::copy_n(report.way.begin(), track.way.size(), track.way.begin());
    track.range = std::max(report.measured.altitude, 0.0);
    track.since = report.since;
    return waterlinked::pd6_track('B', track);
}

std::string water_lines(const Report& report, const Setup& setup) {
    if (!report.water) return "";
    waterlinked::Pd6Track track = track_of(water_velocities, report, setup);
    std::copy_n(report.way_in_water.begin(), track.way.size(), track.way.begin());
    track.range = report.water->middle;
    track.since = report.since_in_water;
    return waterlinked::pd6_track('W', track);
}

/// Leaks, counts, V, A and ohm of a published sample: no leak, the second sensor is not connected.
std::string health_line(const Settings& settings) {
    return settings.series->health ? ":HM,G,D,0e8b,0ffe,*10.842,*1.974,*5.493\r\n" : "";
}

/// `ranges`: the line that PD13 has besides.
Bytes lines_of(const Report& report, const Setup& setup, const Settings& settings,
               const std::string& ranges) {
    constexpr int width = 8;  // of pitch and roll in a published sample
    const double heading = std::fmod(std::round(100 * compass_heading(report.attitude)) / 100, 360);
    const std::string text =
        waterlinked::pd6_attitude(tilt_pitch(report.attitude), rad_to_deg(report.attitude.roll), heading,
                                  width) +
        waterlinked::pd6_time(doppler::compact(doppler::moment_of(report.unix_us)), setup.salinity,
                              report.temperature, 0.1 * setup.depth, setup.sound_speed, 0) +
        ranges + water_lines(report, setup) + bottom_lines(report, setup) + health_line(settings);
    return {text.begin(), text.end()};
}

}  // namespace

Bytes pd6_bytes(const Report& report, const Setup& setup, const Settings& settings) {
    return lines_of(report, setup, settings, "");
}

Bytes pd13_bytes(const Report& report, const Setup& setup, const Settings& settings) {
    std::array<double, teledyne::beams> ranges{};  // dm
    for (std::size_t i = 0; i < ranges.size(); ++i)
        ranges[i] = 10 * vertical_range(report.measured.beams[i], settings);
    return lines_of(report, setup, settings, waterlinked::pd13_ranges(pressure_of(setup), ranges));
}

Bytes report_bytes(const Report& report, const Setup& setup, const Settings& settings) {
    switch (setup.format) {
        case Format::pd4:
            return pd4_bytes(report, setup, settings);
        case Format::pd5:
            return pd5_bytes(report, setup, settings);
        case Format::pd6:
            return pd6_bytes(report, setup, settings);
        case Format::pd13:
            return pd13_bytes(report, setup, settings);
        case Format::pd0:
            break;
    }
    return ensemble_bytes(report, setup, settings);
}

}  // namespace echoloop::teledyne_dvl
