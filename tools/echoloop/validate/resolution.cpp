// V4: what a pulse can tell apart, and that levels do not depend on the bins.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr double usual_speed = 1500;
constexpr double resolution_bin = 0.75e-3;  // m
constexpr double deepest = 60;              // dB; silence between two echoes counts as that

Shot fine_shot(double pulse_length, double bandwidth) {
    Shot shot = fan(1, 1, 1, 2000, 2000 * resolution_bin);
    shot.pulse_length = pulse_length;
    shot.bandwidth = bandwidth;
    return shot;
}

/// Mean over relative phases, so that neither constructive nor destructive interference decides.
std::vector<double> echoes(const Shot& shot, double near, double far) {
    constexpr int phases = 16;
    AcousticChain chain(only({Effect::pulse}));
    std::vector<double> mean(shot.bins);
    for (int k = 0; k < phases; ++k) {
        const PointEcho points[] = {{0, near, 1, 0}, {0, far, 1, 2 * std::numbers::pi * k / phases}};
        std::vector<float> values(shot.bins);
        chain.apply(shot, {}, usual_speed, points, values);
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += values[i] / phases;
    }
    return mean;
}

/// How far the level falls between two echoes `distance` m apart, in dB below the lower of the two.
double dip(const Shot& shot, double distance) {
    const double near = 0.5, far = near + distance, resolution = range_resolution(shot, usual_speed);
    const auto mean = echoes(shot, near, far);
    // A CW pulse's echo begins at its target's range and lasts; that of a compressed one is centred there.
    const double middle = shot.bandwidth > 0 ? 0 : resolution / 2;
    const auto at = [&](double r) { return mean.begin() + std::lround((r + middle) / resolution_bin); };
    const double between = *std::min_element(at(near), at(far));
    return std::min(deepest, db(std::min(*at(near), *at(far)) / between));
}

/// m: the area of one echo of a diffuse scatterer over its height, the insonified length.
double insonified_length(const Shot& shot) {
    std::vector<float> values(shot.bins);
    values[shot.bins / 2] = 1;
    AcousticChain(only({Effect::pulse})).apply(shot, {}, usual_speed, {}, values);
    return total(values) / peak(values) * resolution_bin;
}

double floor_level(std::size_t bins) {
    Shot shot = fan(20, 30, 4, bins, 30);
    shot.tilt = deg_to_rad(-20);
    shot.pulse_length = 200e-6;
    Renderer renderer(scene_of({floor_at(-5, 100)}), water_of(usual_speed),
                      with(only({Effect::spreading, Effect::pulse})));
    const auto values = mean_values(renderer, shot, 8);
    double sum = 0;
    for (std::size_t i = bins / 2; i < bins * 5 / 6; ++i) sum += values[i] / static_cast<double>(bins);
    return db(sum);
}

}  // namespace

void check_resolution(Findings& find) {
    const struct {
        const char* name;
        double pulse, bandwidth, published;
    } pulses[] = {
        {"CW 25 us", 25e-6, 0, 18.75}, {"CW 100 us", 100e-6, 0, 75}, {"chirp of 20 kHz", 2e-3, 20e3, 37.5}};
    for (const auto& p : pulses) {
        const Shot shot = fine_shot(p.pulse, p.bandwidth);
        const double resolution = p.published / 1e3;
        find.source("c tau / 2, c / (2 B); c 1500 m/s");
        find.within(std::string(p.name) + ": insonified length", "mm", p.published, 0.02 * p.published,
                    1e3 * insonified_length(shot));
        find.source("two equal points");
        find.at_least(std::string(p.name) + ": dip between points 1.5 lengths apart", "dB", 3,
                      dip(shot, 1.5 * resolution));
        find.at_most(std::string(p.name) + ": dip between points 0.5 lengths apart", "dB", 0.1,
                     dip(shot, 0.5 * resolution));
    }
    find.source("levels belong to the pulse, not to the bins", Kind::property);
    find.within("level of a floor with four times as many bins", "dB", 0, 0.1,
                floor_level(2400) - floor_level(600));
}

}  // namespace echoloop::validation
