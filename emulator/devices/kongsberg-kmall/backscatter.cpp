#include "emulator/devices/kongsberg-kmall/backscatter.h"

#include <algorithm>
#include <cmath>

#include "emulator/devices/kongsberg-kmall/messages.h"
#include "emulator/devices/kongsberg-kmall/soundings.h"

namespace echoloop::kongsberg_kmall {
namespace {

using kmall::Sounding;

constexpr float rejected_level = -100;  // dB, of all rejected real soundings

/// The maker's gain as it fits real datagrams: spreading and absorption, less the lit area, less Lambert's
/// law.
double reflectivity_gain(const Settings& s, double range, double angle) {
    if (!s.tvg) return 0;
    const double sine = std::max(std::abs(std::sin(angle)), 1e-3), cosine = std::max(std::cos(angle), 0.05);
    const double along = s.transmit_beam_width * range;
    const double area =
        std::min(along * s.receive_beam_width * range / cosine, along * s.sound_speed * s.pulse / (2 * sine));
    return gain(s, 40, range) - 10 * std::log10(area) - 20 * std::log10(cosine);
}

/// Bins from `first` sample on.
double sample_power(const Echogram& echogram, std::size_t beam, std::size_t sample) {
    const auto power = echogram.beam(beam).subspan(sample * bins_per_sample, bins_per_sample);
    double sum = 0;
    for (const float p : power) sum += p;
    return sum / bins_per_sample;
}

/// Samples of a sounding's image: half way to its neighbours', 3 at least and 37 at most, as real ones have.
std::size_t image_samples(const std::vector<Sounding>& soundings, std::size_t n, double rate) {
    const std::size_t before = n == 0 ? n : n - 1, after = std::min(n + 1, soundings.size() - 1);
    const double apart = std::abs(double(soundings[after].time) - double(soundings[before].time)) / 2;
    return static_cast<std::size_t>(std::clamp(std::round(apart * rate), 3.0, 37.0));
}

/// The samples around the sounding's time; their mean power is its reflectivity (own choice; real ones lie 0
/// to 1.5 dB above it).
void add_image(kmall::Mrz& m, Sounding& out, std::size_t beam, std::size_t count, const Echogram& echogram) {
    const std::size_t all = echogram.shot.bins / bins_per_sample;
    if (all < count) return;
    const double rate = m.rx.seabed_image_rate;
    const std::size_t centre = (count + 1) / 2;
    const auto at = static_cast<std::size_t>(double(out.time) * rate);
    const std::size_t first = std::min(at - std::min(at, centre - 1), all - count);
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += sample_power(echogram, beam, first + i);
    if (!(sum > 0)) return;
    const double mean = 10 * std::log10(sum / static_cast<double>(count));
    for (std::size_t i = 0; i < count; ++i) {
        const double level = 10 * std::log10(std::max(sample_power(echogram, beam, first + i), 1e-30));
        const double tenths = std::round(10 * (double(out.reflectivity1) + level - mean));
        m.image.push_back(static_cast<std::int16_t>(std::clamp(tenths, -2000.0, 2000.0)));
    }
    constexpr double late = 0.2e-3;  // s, of real starts
    out.image_samples = static_cast<std::uint16_t>(count);
    out.image_centre = static_cast<std::uint16_t>(centre);
    out.image_start =
        static_cast<std::uint16_t>(std::min(static_cast<double>(first) + std::round(late * rate), 65535.0));
}

/// Mean of the reflectivities between two angles from the vertical, deg; 0: there are none.
float mean_between(std::span<const Sounding> soundings, double from, double to) {
    double sum = 0;
    int count = 0;
    for (const Sounding& one : soundings) {
        const double angle = std::abs(one.water_angle);
        if (one.type != 0 || angle < from || angle > to) continue;
        sum += one.reflectivity1;
        ++count;
    }
    return count == 0 ? 0 : f(sum / count);
}

}  // namespace

void add_backscatter(kmall::Mrz& m, const Settings& s, const Echogram& echogram,
                     std::span<const multibeam::Detection> detections) {
    for (std::size_t n = 0; n < m.soundings.size(); ++n) {
        Sounding& out = m.soundings[n];
        const bool bottom = n < detections.size();
        const double angle = deg_to_rad(out.water_angle), range = double(out.time) * s.sound_speed / 2;
        // Real ones are -202 to -184 dB, smooth over the angle; the form is our own choice.
        out.sensitivity = f(-190 + 20 * std::log10(std::max(std::cos(deg_to_rad(out.angle)), 0.1)));
        out.reflectivity1 = out.reflectivity2 = rejected_level;
        if (out.method == 0) continue;
        if (range <= 0) continue;
        const auto sample = std::min<std::size_t>(out.water_range, echogram.shot.bins / bins_per_sample - 1);
        const double power = bottom ? detections[n].mean : sample_power(echogram, out.water_beam, sample);
        out.tvg = f(reflectivity_gain(s, range, angle));
        out.reflectivity1 = f(10 * std::log10(std::max(power, 1e-30))) - out.source_level + out.tvg;
        // 34 dB more at the nadir and 25 dB at 45 deg in an EM 2040P.
        const double part = std::min(std::abs(angle) / deg_to_rad(45), 1.5);
        out.reflectivity2 = out.reflectivity1 + f(34 - 9 * part * part);
        constexpr std::size_t of_extra_detection = 9;
        const std::size_t count =
            bottom ? image_samples(m.soundings, n, m.rx.seabed_image_rate) : of_extra_detection;
        if (s.seabed_image) add_image(m, out, out.water_beam, count, echogram);
    }
    const std::span soundings(m.soundings);
    m.rx.bs_normal = mean_between(soundings, 0, 10);
    m.rx.bs_oblique = mean_between(soundings, 30, 75);
}

}  // namespace echoloop::kongsberg_kmall
