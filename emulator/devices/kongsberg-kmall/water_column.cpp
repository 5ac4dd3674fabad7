#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "emulator/devices/kongsberg-kmall/messages.h"

namespace echoloop::kongsberg_kmall {
namespace {

constexpr double spreading = 30;           // X of the gain, in all real ones
constexpr std::int8_t constant_gain = 30;  // dB, the same
constexpr std::size_t silent_samples = 6;  // that read the least; 4 to 10 in real ones
constexpr std::uint8_t mwc_version = 2;    // has the fine range of the bottom

/// Gain and reference of every sample, in the wire's half decibels.
std::vector<float> offsets(const Settings& settings, const Echogram& echogram, std::size_t samples) {
    std::vector<float> all(samples);
    for (std::size_t i = 0; i < samples; ++i) {
        const double middle = (static_cast<double>(i) + 0.5) * bins_per_sample * echogram.shot.bin_interval;
        const double db = gain(settings, spreading, settings.sound_speed / 2 * middle) +
                          (settings.tvg ? constant_gain : 0) - settings.water_column_reference;
        all[i] = static_cast<float>(2 * db);
    }
    return all;
}

/// 20 log10 of a normal float > 0, within 3e-5: octaves, and of the rest m the series of artanh((m - 1) / (m
/// + 1)). The compiler makes vectors of it, which it cannot of the C library's.
inline float half_decibels(float power) {
    constexpr float per_octave = 6.0205999F, per_neper = 17.371779F;  // 20 log10(2), 40 / ln(10)
    const auto bits = std::bit_cast<std::int32_t>(power);
    const std::int32_t octaves = (bits - 0x3F3504F3) >> 23;  // from sqrt(1/2) to sqrt(2)
    const float m = std::bit_cast<float>(bits - octaves * (1 << 23));
    const float t = (m - 1) / (m + 1), square = t * t;
    const float series =
        t * (1 + square * (1.0F / 3 + square * (1.0F / 5 + square * (1.0F / 7 + square * (1.0F / 9)))));
    return per_octave * static_cast<float>(octaves) + per_neper * series;
}

/// Means over the bins of each sample, in half decibels.
std::vector<std::int8_t> amplitudes(std::span<const float> beam, const std::vector<float>& offset) {
    constexpr float least = std::numeric_limits<float>::min();
    std::vector<std::int8_t> out(offset.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        float sum = 0;
        for (std::size_t k = 0; k < bins_per_sample; ++k) sum += beam[i * bins_per_sample + k];
        const float level = half_decibels(std::max(sum / bins_per_sample, least)) + offset[i];
        const float cut = std::min(std::max(level, -128.0F), 127.0F);
        out[i] = static_cast<std::int8_t>(static_cast<std::int32_t>(cut + std::copysign(0.5F, cut)));
    }
    std::fill_n(out.begin(), std::min(silent_samples, out.size()), std::int8_t{-128});
    return out;
}

}  // namespace

kmall::Mwc make_mwc(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
                    std::span<const multibeam::Detection> detections) {
    const auto f = [](double value) { return static_cast<float>(value); };
    const double sample = bins_per_sample * echogram.shot.bin_interval;
    const Surface surface = surface_of(echogram.world_from_sonar);
    const auto offset = offsets(settings, echogram, echogram.shot.bins / bins_per_sample);
    kmall::Mwc m;
    m.header = make_header(ping, settings, "#MWC", mwc_version);
    m.body = make_body(ping);
    const auto read = settings.sensors.at(from_seconds(ping.time - settings.unix_start));
    m.tx.heave = read("heave", ping.heave, stray::depth);
    m.sectors = {{0, f(settings.frequency), f(rad_to_deg(settings.transmit_beam_width)), 0, 0}};
    m.rx.tvg = settings.tvg ? static_cast<std::uint8_t>(spreading) : std::uint8_t{0};
    m.rx.tvg_offset = settings.tvg ? constant_gain : std::int8_t{0};
    m.rx.sample_rate = f(1 / sample);
    m.rx.sound_speed = f(settings.sound_speed);
    for (std::size_t n = 0; n < detections.size(); ++n) {
        const Vec3 direction = beam_direction(echogram.world_from_sonar, surface, echogram.shot.bearings[n]);
        kmall::WaterBeam beam;
        beam.info.angle = f(rad_to_deg(std::atan2(-direction.y, direction.z)));
        beam.info.detected_fine = f(detections[n].time / sample);
        beam.info.detected = static_cast<std::uint16_t>(std::min(beam.info.detected_fine, 65535.0F));
        beam.amplitude = amplitudes(echogram.beam(n), offset);
        m.beams.push_back(std::move(beam));
    }
    return m;
}

}  // namespace echoloop::kongsberg_kmall
