#include "emulator/capture/remark.h"

#include <cstdio>

namespace echoloop {

std::string remark_of(const Transmission& transmission, std::uint64_t number) {
    const Vec3 p = transmission.world_from_sonar.position;
    const Quat q = transmission.world_from_sonar.orientation;
    char text[200];
    std::snprintf(text, sizeof text,
                  "ping %llu: t %.6f s, sonar at %.3f %.3f %.3f m, orientation w %.5f x %.5f y %.5f z %.5f",
                  static_cast<unsigned long long>(number), to_seconds(transmission.time), p.x, p.y, p.z, q.w,
                  q.x, q.y, q.z);
    return text;
}

}  // namespace echoloop
