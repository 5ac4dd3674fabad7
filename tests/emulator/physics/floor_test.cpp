// What every model hears of a flat floor, against the closed form of its own aperture: a profile or a shot
// that is wrong in a unit, a width or a shape gives a picture that looks right and is wrong by tens of
// decibels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/acoustics/chain.h"
#include "render/acoustics/pattern.h"
#include "render/acoustics/range_correlation.h"
#include "tests/emulator/devices/driver.h"
#include "tests/render/acoustics/statistics.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop::test {
namespace {

constexpr double true_speed = 1500;         // m/s
constexpr double grazing = deg_to_rad(30);  // of the middle beam's axis on the floor
constexpr double part = 0.04;               // of the axis' range, to both sides of it
constexpr double strength = -27;            // dB, Lambert, at normal incidence

Effects mean_levels() {
    return Effects::none()
        .set(Effect::spreading)
        .set(Effect::absorption)
        .set(Effect::beam_pattern)
        .set(Effect::side_lobes)
        .set(Effect::pulse);
}

/// A model's plain ping above a floor that the axis of its middle beam meets half way down its window.
struct OverFloor {
    explicit OverFloor(const Model& model) : shot(model.default_shot(make_config(model), 0, 0)) {
        if (!shot.sides.empty()) {  // arrays of one beam each: one stands for all
            shot.bearings = {0};
            shot.source_level = shot.sides[0].source_level;
            shot.sides.clear();
        }
        const double window = shot.first_bin_time + shot.bin_interval * static_cast<double>(shot.bins);
        axis_range = true_speed / 2 * (shot.first_bin_time + window) / 2;
        altitude = axis_range * std::sin(grazing);
        // About y, positive is down: the fan's own tilt and this together look `grazing` down.
        const double pitch = (grazing + shot.tilt) / 2;
        pose.orientation = {std::cos(pitch), 0, std::sin(pitch), 0};
        const auto nearest = [](const std::vector<double>& angles) {
            std::size_t best = 0;
            for (std::size_t i = 1; i < angles.size(); ++i)
                if (std::abs(angles[i]) < std::abs(angles[best])) best = i;
            return best;
        };
        column = nearest(shot.bearings);
        const std::size_t row = shot.elevations.empty() ? 0 : nearest(shot.elevations);
        beam = row * shot.bearings.size() + column;
        elevation = shot.elevations.empty() ? 0 : shot.elevations[row];
        shot.pan = 0;
    }

    /// uPa^2: mean over the bins around axis_range.
    double rendered(Effects effects, std::size_t pings = 4) const {
        RendererOptions options;
        options.effects = effects;
        Renderer renderer(scene_of({floor_at(-altitude, 20 * axis_range, 1, strength)}), water_of(true_speed),
                          options);
        double sum = 0;
        std::size_t count = 0;
        Shot one = shot;
        for (std::size_t ping = 0; ping < pings; ++ping) {
            one.ping = ping;
            Pose place = pose;
            place.position = {0.37 * static_cast<double>(ping), 0.29 * static_cast<double>(ping), 0};
            const Echogram echogram = renderer.render(one, place);
            for (std::size_t bin = 0; bin < shot.bins; ++bin) {
                if (std::abs(echogram.bin_range(bin) / axis_range - 1) > part) continue;
                sum += static_cast<double>(echogram.beam(beam)[bin]);
                ++count;
            }
        }
        return sum / static_cast<double>(count);
    }

    /// uPa^2 by the sonar equation: the ring of the floor at `range`, weighed with the two-way pattern of a
    /// line of beams (cones about the array) and of the fan (elevation), or of a piston by the angle off its
    /// axis.
    double closed_form(double range) const {
        const TwoWayPattern across(shot.horizontal, shot.beam_width), along(shot.vertical, shot.fan_height);
        const bool piston =
            shot.horizontal.shape == ApertureShape::piston && shot.vertical.shape == ApertureShape::piston;
        const double sin_g = altitude / range;
        const double down = std::asin(sin_g);
        constexpr int steps = 8000;
        double ring = 0;
        for (int i = 0; i < steps; ++i) {
            const double azimuth = (i + 0.5) * 2 * std::numbers::pi / steps - std::numbers::pi;
            // In the frame of the fan, which is pitched by `grazing`: x along the axis, y to port, z up.
            const double x0 = std::cos(down) * std::cos(azimuth), y = std::cos(down) * std::sin(azimuth),
                         z0 = -sin_g;
            const double x = x0 * std::cos(grazing) - z0 * std::sin(grazing);
            const double z = x0 * std::sin(grazing) + z0 * std::cos(grazing);
            double power;
            if (piston)
                power = across.power(std::acos(std::clamp(x, -1.0, 1.0)));
            else
                power = x <= 0 ? 0
                               : across.power(std::asin(std::clamp(-y, -1.0, 1.0)) - shot.bearings[column]) *
                                     along.power(std::asin(std::clamp(z, -1.0, 1.0)) - elevation);
            ring += power;
        }
        ring *= 2 * std::numbers::pi / steps;
        const double absorbed = absorption_db_per_km(water_of(true_speed), shot.frequency) / 1000 * range;
        const double level =
            shot.source_level - 40 * std::log10(range) - 2 * absorbed + strength + 20 * std::log10(sin_g);
        return std::pow(10, level / 10) * range * range_resolution(shot, true_speed) * ring;
    }

    /// The same over the bins that rendered() takes.
    double closed_form() const {
        constexpr int ranges = 41;
        double sum = 0;
        for (int i = 0; i < ranges; ++i)
            sum += closed_form(axis_range * (1 + part * (2 * (i + 0.5) / ranges - 1)));
        return sum / ranges;
    }

    Shot shot;
    Pose pose;
    double axis_range = 0, altitude = 0, elevation = 0;
    std::size_t column = 0, beam = 0;
};

class Physics : public testing::TestWithParam<std::string> {};

TEST_P(Physics, FloorHasTheLevelOfTheSonarEquation) {
    const OverFloor over(*find_model(GetParam()));
    const double closed = db(over.closed_form());
    EXPECT_NEAR(db(over.rendered(mean_levels())), closed, 0.5);
    EXPECT_NEAR(db(over.rendered(mean_levels().set(Effect::side_lobes, false))), closed, 0.5)
        << "where the main lobe looks, side lobes add next to nothing";
    const auto looks =
        looks_in(echo_correlation(over.shot, true_speed), true_speed / 2 * over.shot.bin_interval);
    const double kept = db(bin_law(over.shot.receiver.bins, looks).mean);  // bins may keep their peak
    EXPECT_NEAR(db(over.rendered(Effects(), 8)), closed + kept, 2.5)
        << "noise, multipath, clipping and the converter's steps change little of a floor half way down the "
           "window";
}

/// Steps louder than the noise would leave water without echoes at exact zeros, which no real receiver shows.
TEST_P(Physics, StepsOfTheConverterLieBelowTheNoise) {
    const Shot shot = OverFloor(*find_model(GetParam())).shot;
    if (shot.receiver.converter_bits == 0) return;
    EXPECT_LT(db(converter_step(shot)), db(received_noise(shot)));
}

/// A window of water without an echo, as it comes to the device: Rayleigh, and no two words the same.
TEST_P(Physics, TheFarFieldIsNoise) {
    Shot shot = OverFloor(*find_model(GetParam())).shot;
    shot.elevations.clear();
    // Bins so short that each is a sample, so far apart that they are independent.
    shot.bin_interval = 1 / std::max(noise_bandwidth(shot), shot.bandwidth) / 8;
    shot.receiver.bins = BinRule::sample;
    shot.receiver.ring_down = nullptr;  // near the head, and what electronics leave, are tests of their own
    shot.receiver.interference = nullptr;
    shot.bins = 4096;
    std::vector<float> values, apart;
    AcousticChain chain{Effects()};
    while (apart.size() < 8000) {
        ++shot.ping;
        values.assign(shot.bearings.size() * shot.bins, 0.0F);
        chain.apply(shot, {}, true_speed, {}, values);
        for (std::size_t i = 0; i < values.size(); i += 32) apart.push_back(values[i]);
        EXPECT_EQ(std::ranges::count(values, 0.0F), 0);
    }
    EXPECT_NEAR(intensity_statistics(apart).amplitude_cv, 0.5227, 0.02);
    std::vector<float> words(values.begin(), values.begin() + 4096);
    std::ranges::sort(words);
    EXPECT_GT(std::ranges::unique(words).begin() - words.begin(), 4000);
}

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const Model& model : models())
        if (is_sonar(model)) all.push_back(model.name);
    return all;
}

INSTANTIATE_TEST_SUITE_P(EveryModel, Physics, testing::ValuesIn(names()), [](const auto& test) {
    std::string name = test.param;
    for (char& c : name)
        if (c == '-') c = '_';
    return name;
});

}  // namespace
}  // namespace echoloop::test
