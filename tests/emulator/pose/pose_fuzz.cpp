// libFuzzer: any text as lines of poses and steps, or as a trajectory. Whatever comes out must be a pose that
// can be rendered.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "emulator/contract/error.h"
#include "emulator/pose/lines.h"
#include "emulator/pose/message.h"
#include "emulator/pose/trajectory_file.h"

namespace {

void require(const echoloop::Pose& pose) {
    const auto q = pose.orientation;
    const bool good = std::isfinite(norm(pose.position)) && norm(pose.position) < 1.1e6 &&
                      std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) < 1e-6;
    if (!good) std::abort();
}

void read_line(std::string_view line) {
    const auto read = echoloop::parse_pose_line(line);
    if (read.message) require({read.message->position.value(), read.message->attitude.value()});
    if (read.now && !(std::abs(*read.now) < 1e10)) std::abort();
    if (!read.reason.empty() && (read.message || read.now)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    if (data[0] % 2 == 0) {
        echoloop::Lines lines;
        const auto each = [](std::string_view line) { read_line(line); };
        const std::size_t part = data[0] / 2 + 1;  // a stream comes in pieces
        for (echoloop::ByteView rest(data + 1, size - 1); !rest.empty();
             rest = rest.subspan(std::min(part, rest.size())))
            lines.feed(rest.first(std::min(part, rest.size())), each);
        read_line(text);
        return 0;
    }
    try {
        const auto track = echoloop::parse_trajectory(text, "fuzz");
        for (const double part : {-0.1, 0.0, 0.3, 0.77, 1.0, 1.1})
            require(track.at(echoloop::from_seconds(part * echoloop::to_seconds(track.last())))->pose);
    } catch (const echoloop::StartError&) {
    }
    return 0;
}
