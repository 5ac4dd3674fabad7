#include "emulator/devices/sonar-3d-15/imu.h"

#include <cmath>

#include "protocols/sonar3d/layouts.h"
#include "protocols/wire/protobuf.h"

namespace echoloop::sonar_3d_15 {
namespace {

namespace protobuf = wire::protobuf;

constexpr double gravity = 9.81;  // m/s^2

/// From forward, left, up to forward, right, down.
Vec3 right_down(Vec3 v) { return {v.x, -v.y, -v.z}; }

void put_key(std::uint32_t number, wire::Bytes& out) {
    protobuf::put_varint(number << 3 | protobuf::block, out);
}

wire::Bytes packed(const std::vector<ImuSample>& samples, Vec3 ImuSample::*member) {
    wire::Bytes out;
    for (const ImuSample& sample : samples)
        for (const double part : {(sample.*member).x, (sample.*member).y, (sample.*member).z})
            protobuf::put_float(static_cast<float>(part), out);
    return out;
}

}  // namespace

wire::Bytes imu_batch(std::uint32_t number, const std::vector<ImuSample>& samples) {
    wire::Bytes out;
    protobuf::put_varint(1 << 3 | protobuf::varint, out);
    protobuf::put_varint(number, out);
    protobuf::put_varint(2 << 3 | protobuf::varint, out);
    protobuf::put_varint(samples.size(), out);
    for (const ImuSample& sample : samples) {
        put_key(3, out);
        protobuf::put_block(protobuf::write(sample.time), out);
    }
    put_key(4, out);
    protobuf::put_block(packed(samples, &ImuSample::specific_force), out);
    put_key(5, out);
    protobuf::put_block(packed(samples, &ImuSample::rate_of_turn), out);
    return out;
}

void Imu::turned(const Quat& world_from_sonar, Time at) {
    const Quat back = conjugate(world_from_sonar);
    force_ = right_down(rotate(back, {0, 0, gravity}));
    rate_ = {};
    const double time = to_seconds(at - at_);
    if (attitude_ && time > 0) {
        Quat turn = conjugate(*attitude_) * world_from_sonar;
        if (turn.w < 0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
        const double sine = norm({turn.x, turn.y, turn.z});
        const double scale = sine > 0 ? 2 * std::atan2(sine, turn.w) / sine / time : 0;
        rate_ = right_down({turn.x * scale, turn.y * scale, turn.z * scale});
    }
    attitude_ = world_from_sonar;
    at_ = at;
}

}  // namespace echoloop::sonar_3d_15
