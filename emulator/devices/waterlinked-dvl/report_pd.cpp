#include <algorithm>
#include <cmath>
#include <cstdio>

#include "emulator/devices/family/doppler/moment.h"
#include "emulator/devices/waterlinked-dvl/report.h"
#include "protocols/waterlinked/pd4.h"

namespace echoloop::waterlinked_dvl {
namespace {

using doppler::Moment, doppler::moment_of;

std::string date_text(const Moment& moment) {
    char text[32];
    std::snprintf(text, sizeof text, "%02d%02d%02d%02d%02d%02d%02d", moment.year() % 100, moment.month(),
                  moment.day(), moment.hour(), moment.minute(), moment.second(), moment.hundredth());
    return text;
}

int millimetres(double metres) {
    return static_cast<int>(std::lround(std::clamp(1000 * metres, -32767.0, 32767.0)));
}

}  // namespace

std::string pd6_lines(const VelocityReport& r, const Settings& settings) {
    const int x = millimetres(r.velocity.x), y = millimetres(r.velocity.y), z = millimetres(r.velocity.z);
    const int error = millimetres(r.error);
    const char valid = r.valid ? 'A' : 'V';
    const bool water = r.water;
    char text[768];
    std::string lines = ":SA, +0.00, +0.00,  0.00\r\n";
    std::snprintf(text, sizeof text, ":TS,%s, 0.0,%+5.1f,   0.0,%6.1f,  0\r\n",
                  date_text(moment_of(r.validity)).c_str(), settings.water_temperature, r.speed_of_sound);
    lines += text;
    const auto velocities = [&](char kind, bool has) {
        std::snprintf(text, sizeof text,
                      ":%cI,%+6d,%+6d,%+6d,%+6d,%c\r\n:%cS,%+6d,%+6d,%+6d,%c\r\n"
                      ":%cE,    +0,    +0,    +0,V\r\n",
                      kind, has ? x : 0, has ? y : 0, has ? z : 0, has ? error : 0, has ? valid : 'V', kind,
                      has ? y : 0, has ? x : 0, has ? z : 0, has ? valid : 'V', kind);
        lines += text;
    };
    velocities('W', water);
    lines += ":WD,       +0.00,       +0.00,       +0.00,   0.00,  0.00\r\n";
    velocities('B', !water);
    std::snprintf(text, sizeof text, ":BD,%+12.2f,%+12.2f,%+12.2f,%7.2f,%6.2f\r\n", 0.0, 0.0, 0.0,
                  std::max(r.altitude, 0.0), 0.0);
    return lines + text;
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
