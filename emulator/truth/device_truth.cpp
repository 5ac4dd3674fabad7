#include "emulator/truth/device_truth.h"

namespace echoloop {

PingTruth DeviceTruth::of(const Transmission& transmission, const Situation& situation, double unix_time,
                          Time due, std::vector<std::string> faults, const Echogram& echogram) const {
    PingTruth truth;
    truth.device = device_;
    truth.transmitted = transmission.time;
    truth.due = due;
    truth.unix_time = unix_time;
    truth.movers = situation.movers;
    truth.sonar = {situation.velocity, situation.turning};
    truth.faults = std::move(faults);
    truth.world_from_body = transmission.world_from_sonar * inverse(body_from_sonar_(transmission.time));
    truth.echo.shot = echogram.shot;
    truth.echo.world_from_sonar = echogram.world_from_sonar;
    truth.echo.sound_speed = echogram.sound_speed;
    truth.echo.noise_power = echogram.noise_power;
    truth.echo.truth = echogram.truth;
    return truth;
}

void DeviceTruth::heard(PingTruth truth, std::vector<std::uint16_t> objects) {
    if (file_ == nullptr) return;
    truth.echo.objects = std::move(objects);
    file_->add(std::move(truth));
}

}  // namespace echoloop
