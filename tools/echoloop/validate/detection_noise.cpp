// V39: how far bottom detections scatter. The echoes are made here, of a field that all beams hear, so that a
// line through the directions of its cells is as good as the phase between the halves of an array.
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "emulator/devices/family/multibeam/bottom.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/statistics.h"

namespace echoloop::validation {
namespace {

using Field = std::complex<double>;

struct Ground {
    double beam_width = 0;  ///< rad
    double cell = 0;        ///< m, resolution in range
    double depth = 0;       ///< m
    double snr = 0;         ///< dB
    double bin = 0;         ///< m
    std::vector<double> angles;
};

class Echoes {
  public:
    explicit Echoes(Ground ground) : ground_(std::move(ground)) {
        Shot& shot = echogram_.shot;
        shot.bearings = ground_.angles;
        shot.beam_width = ground_.beam_width;
        shot.fan_height = 1e-4;
        shot.bin_interval = ground_.bin / (c / 2);
        shot.pulse_length = ground_.cell / (c / 2);
        shot.receiver.bandwidth = 1 / shot.pulse_length;
        shot.bins = static_cast<std::size_t>(
            1.1 * ground_.depth / std::cos(ground_.angles.back() + 2 * ground_.beam_width) / ground_.bin);
        echogram_.sound_speed = c;
        echogram_.noise_power = 1;
    }

    /// The ground's amplitudes are drawn anew; what a beam hears is their sum over the pulse, by its Gaussian
    /// pattern.
    const Echogram& next() {
        const std::size_t fine_bins = echogram_.shot.bins * parts,
                          span = static_cast<std::size_t>(std::lround(ground_.cell / fine()));
        std::vector<Field> ground(fine_bins);
        for (std::size_t i = 0; i < fine_bins; ++i)
            if (const double off = angle_at(i); off > 0)
                ground[i] = draw() * std::sqrt(fine() / (range_at(i) * std::tan(off)));
        std::vector<Field> sums(fine_bins + 1);
        echogram_.values.assign(ground_.angles.size() * echogram_.shot.bins, 0);
        for (std::size_t beam = 0; beam < ground_.angles.size(); ++beam) {
            const double angle = ground_.angles[beam];
            for (std::size_t i = 0; i < fine_bins; ++i) {
                const double off = (angle_at(i) - angle) / ground_.beam_width;
                sums[i + 1] =
                    sums[i] +
                    ground[i] * (std::abs(off) < 3 ? std::exp(-2 * std::log(2.0) * off * off) : 0.0);
            }
            const double cell = ground_.cell / (ground_.depth / std::cos(angle) * std::tan(angle));  // rad
            const double gain = std::sqrt(std::pow(10, ground_.snr / 10) / cell);
            for (std::size_t i = 0; i < fine_bins; ++i) {
                const Field heard = gain * (sums[i + 1] - sums[i + 1 - std::min(i + 1, span)]);
                echogram_.values[beam * echogram_.shot.bins + i / parts] +=
                    static_cast<float>(std::norm(heard) / parts);
            }
        }
        for (float& value : echogram_.values)
            value = static_cast<float>(std::norm(std::sqrt(double{value}) + draw()));
        return echogram_;
    }

  private:
    static constexpr double c = 1500;
    static constexpr std::size_t parts = 4;  ///< of a bin
    double fine() const { return ground_.bin / parts; }
    double range_at(std::size_t i) const { return (static_cast<double>(i) + 0.5) * fine(); }
    /// From the nadir; 0: above the ground.
    double angle_at(std::size_t i) const {
        return range_at(i) > ground_.depth ? std::acos(ground_.depth / range_at(i)) : 0.0;
    }
    Field draw() { return {normal_(random_), normal_(random_)}; }

    Ground ground_;
    Echogram echogram_;
    std::mt19937_64 random_{7};
    std::normal_distribution<double> normal_{0, std::sqrt(0.5)};
};

/// Standard deviation of a detection's range, m, as root mean square over the beams within 2.5 deg of `near`.
double scatter(Ground ground, const multibeam::Rule& rule, double near, std::size_t pings) {
    const std::size_t beams = ground.angles.size();
    std::vector<std::vector<double>> ranges(beams);
    const auto angles = ground.angles;
    Echoes echoes(std::move(ground));
    for (std::size_t ping = 0; ping < pings; ++ping) {
        const Echogram& e = echoes.next();
        const std::vector<multibeam::TimeGate> gates(
            beams, {0, static_cast<double>(e.shot.bins) * e.shot.bin_interval});
        const auto found = multibeam::detect(e, gates, rule);
        for (std::size_t n = 0; n < beams; ++n) ranges[n].push_back(found[n].time * 750);
    }
    double variance = 0, count = 0;
    for (std::size_t n = 0; n < beams; ++n)
        if (std::abs(angles[n] - near) < deg_to_rad(2.5)) variance += moments(ranges[n]).variance, ++count;
    return std::sqrt(variance / count);
}

}  // namespace

void check_detection_noise(Findings& find) {
    multibeam::Rule amplitude;
    amplitude.phase_length = 1e9;
    find.source("centre of gravity, sqrt((2/3) d sw / (4 sqrt pi)), d 0.02 m (Lurton & Augustin 2010)");
    for (const auto& [weight, expected] : {std::pair{"0.04", 0.0086}, {"0.1", 0.0137}, {"0.3", 0.0238}}) {
        const double angle = deg_to_rad(40), width = deg_to_rad(1);
        const double range = std::stod(weight) * 2.355 / width / std::tan(angle);
        find.within(
            std::string("amplitude, echo of std ") + weight + " m", "m", expected, 0.1 * expected,
            scatter({width, 0.02, range * std::cos(angle), 50, 0.005, {angle}}, amplitude, angle, 1500));
    }
    Ground fan{deg_to_rad(0.9), 0.0225, 10.75, 20, 750 / 65280.0, {}};
    for (double angle = 40; angle < 60.1; angle += 0.75) fan.angles.push_back(deg_to_rad(angle));
    find.source(
        "phase, N cells at 20 dB: sqrt((1 - y^2) / (2 y^2 N)) tan t / (2 pi 0.443 / b), b 0.9 deg, d 0.0225 "
        "m");
    for (const auto& [angle, expected] : {std::pair{45.0, 0.0174}, {55.0, 0.0187}}) {
        const double t = deg_to_rad(angle), range = fan.depth / std::cos(t);
        find.within("phase, " + std::to_string(static_cast<int>(angle)) + " deg", "% of range", expected,
                    0.1 * expected, 100 * scatter(fan, {}, t, 150) / range);
    }
}

}  // namespace echoloop::validation
