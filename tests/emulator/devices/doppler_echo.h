// A Doppler log on the bench over a made-up flat bottom.
#pragma once

#include <cmath>
#include <optional>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {

/// What the beams of a log hear.
struct OverBottom {
    double altitude = 5;           ///< m; 0: no bottom
    Vec3 velocity{};               ///< m/s in the world: east, north, up
    Quat orientation{1, 0, 0, 0};  ///< of the log in the world
    std::optional<double> deaf{};  ///< deg, bearing of a beam that hears nothing
    float water = 0;               ///< echo of the water in each bin, times the noise
    double floating = 0;           ///< power of what floats in it, at 1 m; spreads and is absorbed at 1 MHz

    Echogram hear(const Shot& shot, Time began) const {
        Echogram e = echo_of(shot, shot.bins, 0);
        std::fill(e.values.begin(), e.values.end(), 1.0F + water);
        e.noise_power = 1;
        e.world_from_sonar = {to_seconds(began) * velocity, orientation};
        e.velocities.resize(shot.velocities ? e.values.size() : 0);
        constexpr float pulse[] = {0.25F, 0.75F, 1, 1, 0.75F, 0.25F};  // as render/acoustics/pulse.h has it
        for (std::size_t beam = 0; beam < shot.beams(); ++beam) {
            const double bearing = shot.bearings[beam], depression = shot.sides[beam].depression;
            const Vec3 axis{std::cos(depression) * std::cos(bearing),
                            -std::cos(depression) * std::sin(bearing), -std::sin(depression)};
            const Vec3 in_world = rotate(orientation, axis);
            const double time = 2 * altitude / -in_world.z / e.sound_speed;
            const auto first = static_cast<std::size_t>(std::lround(time / shot.bin_interval));
            const bool hears = altitude > 0 && !(deaf && std::abs(rad_to_deg(bearing) - *deaf) < 1);
            constexpr double loss = 0.7171;  // dB per m of range, there and back
            for (std::size_t bin = 0; floating > 0 && bin < shot.bins; ++bin) {
                const double range = e.bin_range(bin);
                e.values[beam * shot.bins + bin] +=
                    static_cast<float>(floating / (range * range) * std::pow(10, -loss * range / 10));
            }
            for (std::size_t bin = 0; bin < std::size(pulse) && first + bin < shot.bins && hears; ++bin) {
                const std::size_t at = beam * shot.bins + first + bin;
                e.values[at] = 1e10F * pulse[bin];
                if (!e.velocities.empty())
                    e.velocities[at] = {static_cast<float>(dot(velocity, in_world)), 0};
            }
        }
        return e;
    }

    /// Lets time pass; each ping hears this bottom.
    void run(Bench& bench, Time end) {
        while (true) {
            if (bench.ping && bench.ping->shot.ping != seen_) {
                seen_ = bench.ping->shot.ping;
                began_ = bench.now;
            }
            const Time due = bench.ping ? bench.ping->due : Time::max();
            const Time next = std::min(bench.wake, due);
            if (next > end) break;
            if (due <= bench.wake) {
                bench.now = std::max(bench.now, due);
                bench.hear(hear(bench.ping->shot, began_));
            } else {
                bench.run_to(next);
            }
        }
        bench.run_to(end);
    }

  private:
    std::uint64_t seen_ = 0;
    Time began_{};
};

}  // namespace echoloop::test
