#include "emulator/devices/teledyne-dvl/profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulator/devices/family/doppler/echo.h"

namespace echoloop::teledyne_dvl {
namespace {

/// Mean power of a beam between two slant ranges; nothing: it did not listen there.
std::optional<double> mean_power(const Echogram& e, std::size_t beam, double from, double to, double speed) {
    const auto bin_of = [&](double range) {
        return (2 * range / speed - e.shot.first_bin_time) / e.shot.bin_interval;
    };
    const double last = std::ceil(bin_of(to));
    if (bin_of(from) < 0 || last > static_cast<double>(e.shot.bins)) return std::nullopt;
    const auto first = static_cast<std::size_t>(bin_of(from));
    const auto powers = e.beam(beam).subspan(first, static_cast<std::size_t>(last) - first);
    if (powers.empty()) return std::nullopt;
    double sum = 0;
    for (const float power : powers) sum += static_cast<double>(power);
    return sum / static_cast<double>(powers.size());
}

/// One cell of a beam.
struct Sample {
    std::uint8_t intensity = 0, correlation = 0;
    bool good = false;
};

Sample sample_of(double power, double noise, const Settings& settings) {
    constexpr double best = 128, least = 64;    // Workhorse's: correlation of a good echo, WC064
    constexpr double decibels_per_step = 0.61;  // Pathfinder guide
    Sample out;
    if (power <= 0) return out;
    const double level = 10 * std::log10(power) - settings.acoustics.reference_level;
    out.intensity = static_cast<std::uint8_t>(std::lround(std::clamp(level / decibels_per_step, 0.0, 255.0)));
    const double correlation = best * std::max(power - noise, 0.0) / power;
    out.correlation = static_cast<std::uint8_t>(std::lround(correlation));
    out.good = correlation >= least;
    return out;
}

/// What the four beams hear of water between two ranges.
struct Water {
    doppler::BeamSpeeds speeds{teledyne::beams};  ///< of what is good
    std::array<Sample, teledyne::beams> samples{};
    std::size_t good = 0;
};

/// `from`, `to`: m, vertical. `name`: of its noise, which is `noise` m/s of each beam.
Water hear_water(const WaterPing& ping, double from, double to, const std::string& name, double noise,
                 const Setup& setup, const Settings& settings) {
    const Echogram& e = ping.echogram;
    const auto order = doppler::order_of_beams(settings);
    const auto axes = doppler::beam_axes(settings.acoustics.tilt, settings.azimuths);
    const Vec3 own = doppler::turned(ping.motion, -deg_to_rad(0.01 * setup.alignment));
    const double slant = 1 / std::cos(settings.acoustics.tilt), speed = setup.sound_speed;
    Water out;
    for (std::size_t beam = 0; beam < order.size(); ++beam) {
        const auto power = mean_power(e, beam, slant * from, slant * to, speed);
        if (!power) continue;
        const std::size_t id = order[beam];
        out.samples[id] = sample_of(*power, e.noise_power, settings);
        if (!out.samples[id].good) continue;
        const double closing = dot(own, axes[id]) * speed / e.sound_speed;
        const std::string sensor = name + ' ' + std::to_string(id);
        out.speeds[id] = {settings.sensors.read(sensor, closing, {.noise = noise}, ping.began),
                          settings.noise.floor};
        ++out.good;
    }
    return out;
}

/// The vehicle's velocity against that water, in its own axes; nothing of too few beams.
std::optional<doppler::Solution> velocity_of(const Water& water, const Setup& setup,
                                             const Settings& settings) {
    const std::size_t least = setup.three_beams ? teledyne::beams - 1 : teledyne::beams;
    if (water.good < least) return std::nullopt;
    const auto axes = doppler::beam_axes(settings.acoustics.tilt, settings.azimuths);
    auto solution = doppler::solve(axes, water.speeds);
    if (solution)
        solution->velocity = doppler::turned(solution->velocity, deg_to_rad(0.01 * setup.alignment));
    return solution;
}

/// Own choice: ten times as much as of the bottom, whose echo is one of a thin layer.
double water_noise(const Settings& settings) { return 10 * settings.noise.floor; }

}  // namespace

std::vector<teledyne::Section> profile_of(const WaterPing& ping, const doppler::Attitude& attitude,
                                          double pulse, const Setup& setup, const Settings& settings) {
    const auto cells = static_cast<std::size_t>(setup.cells);
    teledyne::Velocity velocity;
    teledyne::Correlation correlation;
    teledyne::Intensity intensity;
    teledyne::PercentGood percent;
    velocity.cells.resize(cells);
    correlation.values.resize(4 * cells);
    intensity.values.resize(4 * cells);
    percent.values.resize(4 * cells);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const double from = 0.01 * (setup.blank + static_cast<double>(cell) * setup.cell_size) + pulse / 2;
        const Water water =
            hear_water(ping, from, from + 0.01 * setup.cell_size, "cell " + std::to_string(cell),
                       water_noise(settings), setup, settings);
        Velocities values;
        for (std::size_t i = 0; i < values.size(); ++i) {
            correlation.values[4 * cell + i] = water.samples[i].correlation;
            intensity.values[4 * cell + i] = water.samples[i].intensity;
        }
        if (setup.frame == Frame::beam) {
            for (std::size_t i = 0; i < values.size(); ++i) {
                if (water.speeds[i]) values[i] = water.speeds[i]->velocity;
                percent.values[4 * cell + i] = water.speeds[i] ? 100 : 0;
            }
        } else {
            const auto solution = velocity_of(water, setup, settings);
            const bool three = solution && water.good == 3, four = solution && water.good == 4;
            if (solution)
                values = in_frame(solution->velocity, four ? std::optional(solution->error) : std::nullopt,
                                  attitude, setup);
            // Of three beams, rejected, of too few, of four.
            percent.values[4 * cell] = three ? 100 : 0;
            percent.values[4 * cell + 2] = solution ? 0 : 100;
            percent.values[4 * cell + 3] = four ? 100 : 0;
        }
        for (std::size_t i = 0; i < values.size(); ++i)
            velocity.cells[cell].velocity[i] = millimetres(values[i]);
    }
    return {std::move(velocity), std::move(correlation), std::move(intensity), std::move(percent)};
}

WaterLayer layer_of(const WaterPing& ping, double nearest_bottom, const Setup& setup,
                    const Settings& settings) {
    constexpr double share = 0.8;  // of the way to the bottom that a layer may reach to: guide
    constexpr double decimetre = 0.1;
    WaterLayer out;
    const double near = decimetre * setup.layer_near, least = decimetre * setup.layer_least;
    double far = decimetre * setup.layer_far;
    if (nearest_bottom > 0) far = std::min(far, share * nearest_bottom);
    out.middle = (near + far) / 2;
    out.too_shallow = far < near + least;
    out.measured.beams.resize(teledyne::beams);
    if (out.too_shallow) return out;
    const Water water = hear_water(ping, near, far, "layer", water_noise(settings), setup, settings);
    for (std::size_t i = 0; i < teledyne::beams; ++i) {
        out.correlation[i] = water.samples[i].correlation;
        out.amplitude[i] = water.samples[i].intensity;
        if (!water.speeds[i]) continue;
        out.measured.beams[i].valid = true;
        out.measured.beams[i].velocity = water.speeds[i]->velocity;
    }
    const auto solution = velocity_of(water, setup, settings);
    out.measured.valid = solution.has_value();
    if (!solution) return out;
    out.measured.velocity = solution->velocity;
    out.measured.error = solution->error;
    return out;
}

}  // namespace echoloop::teledyne_dvl
