#include "emulator/truth/remark.h"

#include <cstdio>

namespace echoloop {

std::string remark_of(const Transmission& transmission, std::uint64_t number, const Surroundings& around) {
    const Vec3 p = transmission.world_from_sonar.position;
    const Quat q = transmission.world_from_sonar.orientation;
    char text[300];
    std::snprintf(text, sizeof text,
                  "ping %llu: t %.6f s, sonar at %.3f %.3f %.3f m, orientation w %.5f x %.5f y %.5f z %.5f",
                  static_cast<unsigned long long>(number), to_seconds(transmission.time), p.x, p.y, p.z, q.w,
                  q.x, q.y, q.z);
    std::string remark = text;
    if (around.place) {
        std::snprintf(text, sizeof text, ", latitude %.9f longitude %.9f", around.place->latitude,
                      around.place->longitude);
        remark += text;
    }
    if (around.altitude) {
        std::snprintf(text, sizeof text, ", %.3f m above the bottom", *around.altitude);
        remark += text;
    }
    return remark;
}

std::optional<Remark> read_remark(const std::string& comment) {
    const std::size_t at = comment.find("ping ");
    if (at == std::string::npos) return std::nullopt;
    const std::string line = comment.substr(at, comment.find('\n', at) - at);
    Remark remark;
    Vec3& p = remark.world_from_sonar.position;
    Quat& q = remark.world_from_sonar.orientation;
    unsigned long long number = 0;
    if (std::sscanf(line.c_str(),
                    "ping %llu: t %lf s, sonar at %lf %lf %lf m, orientation w %lf x %lf y %lf z %lf",
                    &number, &remark.time, &p.x, &p.y, &p.z, &q.w, &q.x, &q.y, &q.z) != 9)
        return std::nullopt;
    if (const auto place = line.find(", latitude "); place != std::string::npos) {
        GeoPlace found;
        if (std::sscanf(line.c_str() + place, ", latitude %lf longitude %lf", &found.latitude,
                        &found.longitude) == 2)
            remark.around.place = found;
    }
    if (const auto end = line.rfind(" m above the bottom"); end != std::string::npos) {
        const auto begin = line.rfind(", ", end);
        double altitude = 0;
        if (begin != std::string::npos && std::sscanf(line.c_str() + begin, ", %lf", &altitude) == 1)
            remark.around.altitude = altitude;
    }
    return remark;
}

}  // namespace echoloop
