#include <algorithm>
#include <cmath>

#include "emulator/devices/family/doppler/moment.h"
#include "emulator/devices/waterlinked-dvl/report.h"
#include "protocols/waterlinked/pd4.h"
#include "protocols/waterlinked/pd6.h"

namespace echoloop::waterlinked_dvl {
namespace {

using doppler::Moment, doppler::moment_of;

int millimetres(double metres) {
    return static_cast<int>(std::lround(std::clamp(1000 * metres, -32767.0, 32767.0)));
}

}  // namespace

std::string pd6_lines(const VelocityReport& r, const Settings& settings) {
    constexpr int width = 6;  // of pitch and roll
    const int x = millimetres(r.velocity.x), y = millimetres(r.velocity.y), z = millimetres(r.velocity.z);
    waterlinked::Pd6Track nothing, track;
    track.instrument = {x, y, z, millimetres(r.error)};
    track.ship = {y, x, z};
    track.instrument_good = track.ship_good = r.valid;
    waterlinked::Pd6Track bottom = r.water ? nothing : track;
    bottom.range = std::max(r.altitude, 0.0);
    return waterlinked::pd6_attitude(0, 0, 0, width) +
           waterlinked::pd6_time(doppler::compact(moment_of(r.validity)), 0, settings.water_temperature, 0,
                                 r.speed_of_sound, 0) +
           waterlinked::pd6_track('W', r.water ? track : nothing) + waterlinked::pd6_track('B', bottom);
}

Bytes pd4_block(const VelocityReport& r, const Settings& settings) {
    constexpr std::array<std::size_t, 4> transducer_of{2, 0, 3, 1};  // beams 1 to 4
    waterlinked::Pd4 block;
    const std::array<std::int16_t, 4> velocity{static_cast<std::int16_t>(millimetres(r.velocity.x)),
                                               static_cast<std::int16_t>(millimetres(r.velocity.y)),
                                               static_cast<std::int16_t>(millimetres(r.velocity.z)),
                                               static_cast<std::int16_t>(millimetres(r.error))};
    const std::array<std::int16_t, 4> bad{waterlinked::Pd4::bad, waterlinked::Pd4::bad, waterlinked::Pd4::bad,
                                          waterlinked::Pd4::bad};
    block.velocity = r.valid && !r.water ? velocity : bad;
    if (r.water) {
        block.water = r.valid ? velocity : bad;
        block.layer_start = static_cast<std::uint16_t>(std::lround(10 * water_layer.nearest));
        block.layer_end = static_cast<std::uint16_t>(std::lround(10 * water_layer.farthest));
    }
    for (std::size_t i = 0; i < transducer_of.size(); ++i) {
        const double distance = std::clamp(r.beams[transducer_of[i]].distance, 0.0, 655.0);
        block.range[i] = static_cast<std::uint16_t>(std::lround(100 * distance));
    }
    const Moment moment = moment_of(r.validity);
    block.hour = static_cast<std::uint8_t>(moment.hour());
    block.minute = static_cast<std::uint8_t>(moment.minute());
    block.second = static_cast<std::uint8_t>(moment.second());
    block.hundredth = static_cast<std::uint8_t>(moment.hundredth());
    block.sound_speed = static_cast<std::uint16_t>(std::lround(r.speed_of_sound));
    block.temperature = static_cast<std::int16_t>(std::lround(100 * settings.water_temperature));
    return waterlinked::encode(block);
}

}  // namespace echoloop::waterlinked_dvl
