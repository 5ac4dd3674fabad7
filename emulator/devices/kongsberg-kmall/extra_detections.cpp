#include <algorithm>
#include <cmath>
#include <vector>

#include "emulator/devices/kongsberg-kmall/messages.h"
#include "emulator/devices/kongsberg-kmall/soundings.h"

namespace echoloop::kongsberg_kmall {
namespace {

using multibeam::Detection;

constexpr std::size_t skipped_samples = 10;  // at the beginning, as in real water columns

struct Echo {
    float power = 0;
    std::size_t beam = 0, bin = 0;
};

/// What is strongest in a beam outside its bottom; power 0: nothing is.
Echo strongest(const Echogram& echogram, std::size_t beam, const Detection& bottom) {
    const Shot& shot = echogram.shot;
    const auto power = echogram.beam(beam);
    Echo echo{0, beam, 0};
    for (std::size_t bin = skipped_samples * bins_per_sample; bin < shot.bins; ++bin) {
        const double time = shot.first_bin_time + static_cast<double>(bin) * shot.bin_interval;
        const double around = bottom.end - bottom.begin;
        const bool in_bottom = bottom.found() && time > bottom.begin - around && time < bottom.end + around;
        if (!in_bottom && power[bin] > echo.power) echo = {power[bin], beam, bin};
    }
    return echo;
}

}  // namespace

void add_extra_detections(kmall::Mrz& m, const Settings& s, const Echogram& echogram,
                          std::span<const Detection> detections) {
    if (s.extra_detections == 0) return;
    std::vector<Echo> echoes;
    for (std::size_t n = 0; n < detections.size(); ++n)
        if (const Echo echo = strongest(echogram, n, detections[n]); echo.power > 0) echoes.push_back(echo);
    std::ranges::stable_sort(echoes, std::greater(), &Echo::power);
    echoes.resize(std::min(echoes.size(), s.extra_detections));
    std::ranges::sort(echoes, {}, &Echo::beam);
    const Surface surface = surface_of(echogram.world_from_sonar);
    const std::size_t bottoms = m.soundings.size();
    for (const Echo& echo : echoes) {
        constexpr std::uint8_t valid = 80, weak = 10;  // rejectionInfo2 of real ones
        constexpr std::uint8_t first_class = 100;
        const double bearing = echogram.shot.bearings[echo.beam];
        const Vec3 direction = beam_direction(echogram.world_from_sonar, surface, bearing);
        const double time =
            echogram.shot.first_bin_time + (static_cast<double>(echo.bin) + 0.5) * echogram.shot.bin_interval;
        const double excess =
            10 * std::log10(echo.power / std::max(echogram.noise_power, 1e-30)) - s.detection.margin;
        auto one = beam(s, echo.beam, bearing, direction);
        add_bottom(one, {.time = time, .begin = time, .end = time, .method = multibeam::Method::magnitude},
                   m.rx.water_column_rate);
        add_place(one, time * s.sound_speed / 2 * direction, surface, s, 3);
        one.index = static_cast<std::uint16_t>(m.soundings.size());
        one.type = excess > 0 ? 1 : 2;
        one.rejection2 = excess > 0 ? valid : weak;
        one.confidence = static_cast<std::uint8_t>(std::clamp(excess, 0.0, 44.0));
        one.detection_class = first_class;
        const float bottom = m.soundings[echo.beam].time;
        if (bottom > 0) one.range_factor = 100 * one.time / bottom;
        m.soundings.push_back(one);
    }
    m.rx.extra_detections = static_cast<std::uint16_t>(m.soundings.size() - bottoms);
    m.classes = {{m.rx.extra_detections, 0, 0}};
}

}  // namespace echoloop::kongsberg_kmall
