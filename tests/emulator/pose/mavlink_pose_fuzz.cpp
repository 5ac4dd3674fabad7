// libFuzzer: any payloads of MAVLink messages with any times, told to a vehicle as they come. Wherever it is
// said to be must be a pose that can be rendered. The input is records of {message, system, pause in ms,
// length, payload}.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "emulator/pose/input.h"
#include "emulator/pose/mavlink_pose.h"
#include "protocols/mavlink/codec.h"

using namespace echoloop;

namespace {

constexpr mavlink::Id ids[] = {mavlink::Id::attitude,           mavlink::Id::attitude_quaternion,
                               mavlink::Id::local_position_ned, mavlink::Id::global_position_int,
                               mavlink::Id::sim_state,          mavlink::Id::odometry};

void require(const Pose& pose) {
    const auto q = pose.orientation;
    const bool good =
        norm(pose.position) < 1e8 && std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) < 1e-6;
    if (!good) std::abort();
}

mavlink::Frame frame_of(ByteView record) {
    mavlink::Frame frame;
    frame.system = record[1];
    frame.id = static_cast<std::uint32_t>(ids[record[0] % std::size(ids)]);
    const ByteView payload = record.subspan(4, std::min<std::size_t>(record[3], record.size() - 4));
    frame.payload.assign(payload.begin(), payload.end());
    return frame;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    MavlinkPose vehicle;
    SenderClock sender;
    Whereabouts where({}, false);
    Time now{};
    for (ByteView rest(data, size); rest.size() >= 4;) {
        const mavlink::Frame frame = frame_of(rest);
        now += std::chrono::milliseconds(20 * rest[2]);  // beyond what it takes to be forgotten
        rest = rest.subspan(4 + frame.payload.size());
        const auto message = mavlink::parse(frame);
        if (!message) continue;
        const PoseText read = vehicle.add(*message, frame.system, now);
        if (!read.message) continue;
        where.tell(read.message->time ? sender.run_time(*read.message->time, now) : now, *read.message);
        for (const Time at : {Time{}, now, now + std::chrono::milliseconds(20)}) require(where.at(at).pose);
    }
    return 0;
}
