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

}  // namespace

std::vector<teledyne::Section> profile_of(const Echogram& e, Vec3 motion, const doppler::Attitude& attitude,
                                          double pulse, Time began, const Setup& setup,
                                          const Settings& settings) {
    const auto cells = static_cast<std::size_t>(setup.cells);
    const auto order = doppler::order_of_beams(settings);
    const auto axes = doppler::beam_axes(settings.acoustics.tilt, settings.azimuths);
    const Vec3 own = doppler::turned(motion, -deg_to_rad(0.01 * setup.alignment));
    const double slant = 1 / std::cos(settings.acoustics.tilt), speed = setup.sound_speed;
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
        doppler::BeamSpeeds speeds(teledyne::beams);
        std::size_t good = 0;
        for (std::size_t beam = 0; beam < order.size(); ++beam) {
            const auto power =
                mean_power(e, beam, slant * from, slant * (from + 0.01 * setup.cell_size), speed);
            if (!power) continue;
            const std::size_t id = order[beam];
            const Sample sample = sample_of(*power, e.noise_power, settings);
            correlation.values[4 * cell + id] = sample.correlation;
            intensity.values[4 * cell + id] = sample.intensity;
            if (!sample.good) continue;
            const double closing = dot(own, axes[id]) * speed / e.sound_speed;
            const std::string name = "cell " + std::to_string(cell) + ' ' + std::to_string(id);
            // Ten times as much as of the bottom, whose echo is one of a thin layer: own choice.
            speeds[id] = {settings.sensors.read(name, closing, {.noise = 10 * settings.noise.floor}, began),
                          settings.noise.floor};
            ++good;
        }
        Velocities values;
        if (setup.frame == Frame::beam) {
            for (std::size_t i = 0; i < values.size(); ++i) {
                if (speeds[i]) values[i] = speeds[i]->velocity;
                percent.values[4 * cell + i] = speeds[i] ? 100 : 0;
            }
        } else {
            const auto solution = doppler::solve(axes, speeds);
            const bool three = solution && good == 3 && setup.three_beams, four = solution && good == 4;
            if (three || four)
                values = in_frame(doppler::turned(solution->velocity, deg_to_rad(0.01 * setup.alignment)),
                                  four ? std::optional(solution->error) : std::nullopt, attitude, setup);
            // Of three beams, rejected, of too few, of four.
            percent.values[4 * cell] = three ? 100 : 0;
            percent.values[4 * cell + 2] = three || four ? 0 : 100;
            percent.values[4 * cell + 3] = four ? 100 : 0;
        }
        for (std::size_t i = 0; i < values.size(); ++i)
            velocity.cells[cell].velocity[i] = millimetres(values[i]);
    }
    return {std::move(velocity), std::move(correlation), std::move(intensity), std::move(percent)};
}

}  // namespace echoloop::teledyne_dvl
