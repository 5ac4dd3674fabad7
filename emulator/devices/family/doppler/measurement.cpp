#include "emulator/devices/family/doppler/measurement.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace echoloop::doppler {
namespace {

constexpr double empty_rssi = -37, empty_fom = 2.66;  // of a published sample without a bottom

/// From the program's axes (x forward, y to port, z up) to a DVL's.
Vec3 as_dvl(Vec3 v) { return {v.x, -v.y, -v.z}; }
Quat as_dvl(Quat q) { return {q.w, q.x, -q.y, -q.z}; }

/// Never -0.
double rounded(double value, double step) { return step * std::round(value / step) + 0.0; }
Vec3 rounded(Vec3 v, double step) { return {rounded(v.x, step), rounded(v.y, step), rounded(v.z, step)}; }

}  // namespace

Measured Measurement::nothing(const Settings& settings, double speed_of_sound) {
    Measured report;
    report.fom = empty_fom;
    for (std::size_t i = 0; i < 3; ++i) report.covariance[i][i] = empty_fom * empty_fom;
    report.beams.assign(settings.azimuths.size(), {.rssi = empty_rssi, .nsd = empty_rssi});
    report.speed_of_sound = speed_of_sound;
    return report;
}

Measured Measurement::measure(const Echogram& echogram, const Assumed& assumed, const Plan& plan,
                              Time began) {
    follow_motion(echogram, began);
    follow_attitude(echogram, assumed, began);
    Measured report = nothing(settings_, assumed.speed_of_sound);
    report.water = assumed.water;
    echo_time_ = 0;
    double distances = 0, times = 0;
    std::size_t heard = 0;
    for (std::size_t beam = 0; beam < order_.size(); ++beam) {
        BeamReport& of_beam = report.beams[order_[beam]];
        of_beam = hear(echogram, beam, assumed, began);
        if (!of_beam.valid) continue;
        distances += of_beam.distance;
        times += 2 * of_beam.distance / assumed.speed_of_sound;
        ++heard;
    }
    if (report.water) {
        // Its volume of water moves with the world, so all of its beams hear the vehicle's own motion.
        echo_time_ = (plan.mode.nearest + plan.mode.farthest) / assumed.speed_of_sound;
    } else if (heard >= 3) {
        echo_time_ = times / static_cast<double>(heard);
        const double altitude = distances / static_cast<double>(heard) * std::cos(settings_.acoustics.tilt) -
                                settings_.altitude_offset;
        const Acoustics& a = settings_.acoustics;
        if (altitude < std::max(plan.mode.nearest, a.lowest_altitude) || altitude > plan.mode.farthest) {
            echo_time_ = 0;
            return report;
        }
        report.altitude = altitude;
    }
    finish(report, assumed);
    return report;
}

BeamReport Measurement::hear(const Echogram& echogram, std::size_t beam, const Assumed& assumed,
                             Time began) const {
    const std::size_t id = order_[beam];
    const std::string number = std::to_string(id);
    const Acoustics& a = settings_.acoustics;
    const auto dbm = [&](double level) { return level - a.reference_level; };
    BeamReport out;
    out.rssi = empty_rssi;
    out.nsd = echogram.noise_power > 0 ? dbm(10 * std::log10(echogram.noise_power)) : -104;
    const auto echo = find_bottom_echo(echogram, beam, settings_);
    const bool water = assumed.water;
    if (!echo && !water) return out;
    const auto doppler = water ? std::nullopt : echo->closing;
    const double closing = doppler.value_or(dot(motion_, axes_[id]));
    const double scale = assumed.speed_of_sound / echogram.sound_speed;  // what it believes of a shift
    const double distance = echo ? assumed.speed_of_sound / 2 * echo->time : -1;
    if (echo) out.rssi = dbm(echo->level);
    const double noise = settings_.noise.floor + settings_.noise.by_altitude * std::max(distance, 0.0) +
                         settings_.noise.by_speed * std::abs(closing);
    out.deviation = doppler ? std::hypot(noise, echo->scatter) : noise;
    const Sensors& sensors = settings_.sensors;
    const double own_scale = 1 + sensors.read("scale " + number, 0, {.drift = settings_.noise.scale}, Time{});
    constexpr double resolution = 1e-5;  // m/s, of published samples
    out.velocity = rounded(sensors.read("beam " + number, scale * own_scale * closing,
                                        {.drift = settings_.noise.bias, .noise = noise}, began),
                           resolution);
    out.distance = water ? -1 : distance;
    out.valid = true;
    return out;
}

void Measurement::finish(Measured& report, const Assumed& assumed) const {
    BeamSpeeds speeds;
    for (const BeamReport& beam : report.beams)
        speeds.push_back(beam.valid ? std::optional(BeamSpeed{beam.velocity, beam.deviation}) : std::nullopt);
    const auto solution = solve(axes_, speeds);
    if (!solution || norm(solution->velocity) > settings_.acoustics.fastest) {
        report.altitude = -1;
        return;
    }
    report.velocity = rounded(turned(solution->velocity, assumed.rotation), 1e-8);
    report.covariance = turned(solution->covariance, assumed.rotation);
    for (auto& row : report.covariance)
        for (double& value : row) value = rounded(value, 1e-14);
    report.fom = figure_of_merit(solution->covariance);
    report.error = solution->error;
    report.valid = true;
}

void Measurement::follow_motion(const Echogram& echogram, Time began) {
    const Pose& pose = echogram.world_from_sonar;
    if (last_seen_ && began > last_seen_->time) {
        const Vec3 way = pose.position - last_seen_->pose.position;
        motion_ = as_dvl(rotate(conjugate(pose.orientation), 1 / to_seconds(began - last_seen_->time) * way));
    }
    last_seen_ = Seen{pose, began};
}

double Measurement::gyro_bias(Time now) const {
    return deg_to_rad(settings_.sensors.read("gyro", 0, {.drift = settings_.noise.gyro / 3600}, now));
}

void Measurement::calibrate_gyro(Time now) {
    constexpr double share = 0.9;  // own choice
    gyro_correction_ = share * gyro_bias(now);
}

void Measurement::follow_attitude(const Echogram& echogram, const Assumed& assumed, Time began) {
    if (turned_) yaw_error_ += (gyro_bias(began) - gyro_correction_) * to_seconds(began - *turned_);
    turned_ = began;
    const Quat down = axis_angle({0, 0, 1}, yaw_error_);
    const Quat vehicle = axis_angle({0, 0, 1}, -assumed.rotation);
    attitude_ = down * as_dvl(echogram.world_from_sonar.orientation) * vehicle;
    reckoning_.attitude(attitude_);
}

void Measurement::follow(const Measured& report, Time validity) {
    const double seconds = followed_ ? std::max(to_seconds(validity - *followed_), 0.0) : 0;
    followed_ = validity;
    if (report.valid && !report.water)
        reckoning_.moved(report.velocity, seconds, report.fom);
    else
        reckoning_.unknown(seconds);
}

}  // namespace echoloop::doppler
