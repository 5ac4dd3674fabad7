#include <cstdarg>
#include <cstdio>

#include "emulator/devices/waterlinked-dvl/report.h"
#include "protocols/waterlinked/sentence.h"

namespace echoloop::waterlinked_dvl {
namespace {

/// Longest of all is a wrz of some 170 characters.
[[gnu::format(printf, 1, 2)]] std::string print(const char* format, ...) {
    char text[256];
    va_list values;
    va_start(values, format);
    std::vsnprintf(text, sizeof text, format, values);
    va_end(values);
    return text;
}

/// Two digits, since hosts have short buffers.
std::string numbers(const doppler::Covariance& covariance) {
    std::string text;
    for (const auto& row : covariance)
        for (const double value : row) text += print(text.empty() ? "%.2g" : ";%.2g", value);
    return text;
}

char letter(bool yes) { return yes ? 'y' : 'n'; }

}  // namespace

std::string serial_v2(const VelocityReport& r) {
    const Vec3& v = r.velocity;
    const std::string altitude = r.water ? "" : print("%.2f,", r.altitude);
    std::string text = waterlinked::sentence(
        print("%s,%.3f,%.3f,%.3f,%c,%s%.3f,%s,%lld,%lld,%.2f,%d", r.water ? "wrs" : "wrz", v.x, v.y, v.z,
              letter(r.valid), altitude.c_str(), r.fom, numbers(r.covariance).c_str(),
              static_cast<long long>(r.validity), static_cast<long long>(r.transmission), r.time, r.status));
    for (std::size_t id = 0; id < r.beams.size(); ++id) {
        const doppler::BeamReport& beam = r.beams[id];
        text += waterlinked::sentence(
            print("wru,%zu,%.3f,%.2f,%.0f,%.0f", id, beam.velocity, beam.distance, beam.rssi, beam.nsd));
    }
    return text;
}

std::string serial_v1(const VelocityReport& r) {
    const Vec3& v = r.velocity;
    return waterlinked::sentence(print("wrx,%.2f,%.3f,%.3f,%.3f,%.3f,%.2f,%c,%d", r.time, v.x, v.y, v.z,
                                       r.fom, r.altitude, letter(r.valid), r.status)) +
           waterlinked::sentence(print("wrt,%.2f,%.2f,%.2f,%.2f", r.beams[0].distance, r.beams[1].distance,
                                       r.beams[2].distance, r.beams[3].distance));
}

std::string serial_line(const PositionReport& r) {
    const doppler::LocalPosition& p = r.local;
    return waterlinked::sentence(print("wrp,%.3f,%.2f,%.2f,%.2f,%.1f,%.1f,%.1f,%.1f,%d", r.time, p.position.x,
                                       p.position.y, p.position.z, p.deviation, rad_to_deg(p.roll),
                                       rad_to_deg(p.pitch), rad_to_deg(p.yaw), r.status));
}

}  // namespace echoloop::waterlinked_dvl
