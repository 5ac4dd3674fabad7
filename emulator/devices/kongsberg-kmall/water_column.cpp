#include <algorithm>
#include <cmath>

#include "emulator/devices/kongsberg-kmall/messages.h"

namespace echoloop::kongsberg_kmall {
namespace {

constexpr double spreading = 30;         // X of the gain, own choice
constexpr std::uint8_t mwc_version = 2;  // has the fine range of the bottom

/// Gain and reference of every sample, dB.
std::vector<double> offsets(const Settings& settings, const Echogram& echogram, std::size_t samples) {
    std::vector<double> all(samples);
    for (std::size_t i = 0; i < samples; ++i) {
        const double middle = (static_cast<double>(i) + 0.5) * bins_per_sample * echogram.shot.bin_interval;
        all[i] =
            gain(settings, spreading, settings.sound_speed / 2 * middle) - settings.water_column_reference;
    }
    return all;
}

std::vector<std::int8_t> amplitudes(std::span<const float> beam, const std::vector<double>& offset) {
    std::vector<std::int8_t> out(offset.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        float sum = 0;
        for (const float power : beam.subspan(i * bins_per_sample, bins_per_sample)) sum += power;
        const double level = sum > 0 ? level_db(sum / bins_per_sample) + offset[i] : -1000;
        out[i] = static_cast<std::int8_t>(std::lround(std::clamp(2 * level, -128.0, 127.0)));
    }
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
    m.sectors = {{0, f(settings.frequency), f(rad_to_deg(settings.transmit_beam_width)), 0, 0}};
    m.rx.tvg = settings.tvg ? static_cast<std::uint8_t>(spreading) : std::uint8_t{0};
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
