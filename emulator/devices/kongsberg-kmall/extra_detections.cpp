#include <algorithm>
#include <cmath>
#include <vector>

#include "emulator/devices/kongsberg-kmall/messages.h"
#include "emulator/devices/kongsberg-kmall/soundings.h"

namespace echoloop::kongsberg_kmall {
namespace {

using multibeam::Detection;

constexpr std::size_t skipped_samples = 10;  // at the beginning, as in real water columns

// What a real one tells of them, byte by byte.
constexpr std::uint8_t accepted = 80, lonely_at_bottom = 10, lonely_in_water = 12,
                       weak = 14;  // rejectionInfo2
constexpr std::uint8_t first_class = 100;

/// The strongest of a beam beside its bottom.
struct Echo {
    float power = 0, contrast = 0;  ///< contrast, dB: above the mean of the beam's water
    std::size_t beam = 0, bin = 0;
};

/// What any beam hears in each bin, less 25 dB (own choice): what is below it may be a side lobe of that
/// beam.
std::vector<float> side_lobes(const Echogram& echogram) {
    constexpr float suppression = 3.16e-3F;
    std::vector<float> most(echogram.shot.bins);
    for (std::size_t n = 0; n < echogram.beams(); ++n) {
        const auto power = echogram.beam(n);
        for (std::size_t bin = 0; bin < most.size(); ++bin)
            most[bin] = std::max(most[bin], suppression * power[bin]);
    }
    return most;
}

/// Power 0: there is nothing that stands out.
Echo strongest(const Echogram& echogram, std::size_t beam, const Detection& bottom,
               std::span<const float> lobes) {
    const Shot& shot = echogram.shot;
    const auto power = echogram.beam(beam);
    const double around = bottom.end - bottom.begin;
    Echo echo{0, 0, beam, 0};
    double sum = 0;
    std::size_t bins = 0;
    for (std::size_t bin = skipped_samples * bins_per_sample; bin < shot.bins; ++bin) {
        const double time = shot.first_bin_time + static_cast<double>(bin) * shot.bin_interval;
        if (bottom.found() && time > bottom.begin - around && time < bottom.end + around) continue;
        sum += power[bin];
        ++bins;
        if (power[bin] > echo.power && power[bin] > lobes[bin]) echo.power = power[bin], echo.bin = bin;
    }
    if (!(sum > 0)) return echo;
    echo.contrast = f(10 * std::log10(echo.power * static_cast<double>(bins) / sum));
    // Of so many looks at nothing the strongest is on average this far above their mean: no echo at all.
    constexpr double euler = 0.5772;
    if (echo.contrast < 10 * std::log10(std::log(static_cast<double>(bins)) + euler)) echo.power = 0;
    return echo;
}

/// Whether a beam beside it has its strongest echo at the same time: a thing is seen in more than one beam.
bool has_neighbour(const Echo& echo, std::span<const Echo> of_beams) {
    constexpr std::size_t apart = 2, beams = 2;
    const std::size_t first = echo.beam - std::min(echo.beam, beams);
    const std::size_t last = std::min(echo.beam + beams, of_beams.size() - 1);
    for (std::size_t n = first; n <= last; ++n) {
        const Echo& other = of_beams[n];
        const std::size_t between = std::max(other.bin, echo.bin) - std::min(other.bin, echo.bin);
        if (n != echo.beam && other.power > 0 && between <= apart * bins_per_sample) return true;
    }
    return false;
}

/// As real rejected ones: no method, no quality, no window, only a place.
void reject(kmall::Sounding& one, std::uint8_t why) {
    one.type = 2;
    one.rejection2 = why;
    one.method = 0;
    one.quality = one.vertical_uncertainty = one.horizontal_uncertainty = one.window = one.echo_length = 0;
}

kmall::Sounding sounding_of(const Echo& echo, bool lonely, const kmall::Mrz& m, const Settings& s,
                            const Echogram& echogram, const Surface& surface) {
    const double bearing = echogram.shot.bearings[echo.beam];
    const Vec3 direction = beam_direction(echogram.world_from_sonar, surface, bearing);
    const double time =
        echogram.shot.first_bin_time + (static_cast<double>(echo.bin) + 0.5) * echogram.shot.bin_interval;
    auto one = beam(s, echo.beam, bearing, direction);
    add_bottom(one, {.time = time, .begin = time, .end = time, .method = multibeam::Method::magnitude},
               m.rx.water_column_rate);
    add_place(one, time * s.sound_speed / 2 * direction, surface, s, 3);
    one.type = 1;
    one.rejection2 = accepted;
    one.confidence = static_cast<std::uint8_t>(std::clamp(std::round(echo.contrast), 0.0F, 44.0F));
    const float bottom = m.soundings[echo.beam].time;
    one.range_factor = bottom > 0 ? 100 * one.time / bottom : 0;
    if (echo.contrast < s.detection.margin)
        reject(one, weak);
    else if (lonely)
        reject(one, one.range_factor > 90 ? lonely_at_bottom : lonely_in_water);
    return one;
}

}  // namespace

void add_extra_detections(kmall::Mrz& m, const Settings& s, const Echogram& echogram,
                          std::span<const Detection> detections) {
    if (s.extra_detections == 0) return;
    const std::vector<float> lobes = side_lobes(echogram);
    std::vector<Echo> of_beams;
    for (std::size_t n = 0; n < detections.size(); ++n)
        of_beams.push_back(strongest(echogram, n, detections[n], lobes));
    std::vector<Echo> echoes = of_beams;
    std::erase_if(echoes, [](const Echo& echo) { return !(echo.power > 0); });
    std::ranges::stable_sort(echoes, std::greater(), &Echo::contrast);
    echoes.resize(std::min(echoes.size(), s.extra_detections));
    std::ranges::sort(echoes, {}, &Echo::beam);
    const Surface surface = surface_of(echogram.world_from_sonar);
    for (const Echo& echo : echoes) {
        auto one = sounding_of(echo, !has_neighbour(echo, of_beams), m, s, echogram, surface);
        one.index = static_cast<std::uint16_t>(m.soundings.size());
        m.soundings.push_back(one);
        ++m.rx.extra_detections;
    }
}

void classify_extra_detections(kmall::Mrz& m) {
    m.rx.alarm = 1;  // in 60 of 60 real ones without extra detections
    if (m.rx.extra_detections == 0) return;
    const std::size_t none = extra_classes.size();
    m.classes.assign(none + 1, {});
    for (std::size_t n = m.soundings.size() - m.rx.extra_detections; n < m.soundings.size(); ++n) {
        kmall::Sounding& one = m.soundings[n];
        std::size_t found = none;
        const bool good = one.type == 1 && one.confidence >= least_confidence &&
                          one.reflectivity1 >= least_reflectivity && one.quality <= worst_quality;
        for (std::size_t c = 0; good && c < none; ++c)
            if (one.range_factor >= extra_classes[c].from && one.range_factor < extra_classes[c].to)
                found = c;
        one.detection_class = static_cast<std::uint8_t>(first_class + found);
        ++m.classes[found].detections;
    }
    m.rx.alarm = 0;
    for (kmall::DetectionClass& one : m.classes) {
        one.alarm = one.detections >= detections_of_alarm ? 1 : 0;
        m.rx.alarm = static_cast<std::uint16_t>(m.rx.alarm + one.alarm);
    }
}

}  // namespace echoloop::kongsberg_kmall
