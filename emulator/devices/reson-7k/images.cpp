// The records that hold all samples of all beams. An echogram has a beam's samples together, a record those
// of all beams: blocks of a cache line are turned.
#include <algorithm>
#include <array>
#include <cmath>

#include "emulator/devices/reson-7k/records.h"

namespace echoloop::reson7k_device {
namespace {

constexpr std::size_t bins_at_once = 16;  // floats of a cache line

constexpr float to_f32(double value) { return static_cast<float>(value); }

/// Calls use(bin, powers) for every bin; `powers` are those of all beams, and the outermost once more beyond
/// them.
template <typename Use>
void for_each_bin(const Echogram& echogram, const Use& use) {
    const std::size_t beams = echogram.beams(), bins = echogram.shot.bins, stride = beams + 2;
    std::vector<float> rows(bins_at_once * stride);
    for (std::size_t first = 0; first < bins; first += bins_at_once) {
        const std::size_t count = std::min(bins_at_once, bins - first);
        for (std::size_t beam = 0; beam < beams; ++beam) {
            const float* levels = echogram.beam(beam).data() + first;
            for (std::size_t i = 0; i < count; ++i) rows[i * stride + 1 + beam] = levels[i];
        }
        for (std::size_t i = 0; i < count; ++i) {
            float* row = &rows[i * stride];
            row[0] = row[1], row[beams + 1] = row[beams];
            use(first + i, row + 1);
        }
    }
}

/// Amplitudes 0..1 of full scale of the powers of `beams` beams.
void to_shares(const float* powers, float gain, bool paper, std::size_t beams, float* shares) {
    for (std::size_t i = 0; i < beams; ++i) shares[i] = to_share(powers[i], gain, paper);
}

/// Amplitudes, and in place of the phase where in its beam an echo lies: -1 at the beam to port to 1 at the
/// one to starboard, by the balance of power between them, since an echogram has no phases.
void to_samples(const float* powers, const float* shares, std::size_t beams, std::uint32_t* out) {
    for (std::size_t i = 0; i < beams; ++i) {
        const float port = *(powers + i - 1), starboard = powers[i + 1];
        const float balance = (starboard - port) / (starboard + port + powers[i] + 1e-20F);
        const auto amplitude = static_cast<std::int32_t>(shares[i] * full_scale + 0.5F);
        const auto phase = static_cast<std::int32_t>(32767 * balance);
        out[i] = static_cast<std::uint32_t>(amplitude) | static_cast<std::uint32_t>(phase) << 16;
    }
}

}  // namespace

std::vector<float> gain_curve(const PingRecord& ping, const Settings& settings, const Echogram& echogram) {
    const auto spreading = to_f32(settings.tvg ? ping.controls.spreading : 0);
    const auto per_metre = to_f32(settings.tvg ? 2 * ping.controls.absorption / 1000 : 0);
    const auto constant = to_f32(ping.controls.gain - settings.acoustics.amplitude_reference);
    const float per_bin = to_f32(ping.controls.sound_speed / 2 * echogram.shot.bin_interval);
    std::vector<float> gain(echogram.shot.bins);
    for (std::size_t i = 0; i < gain.size(); ++i) {
        const float r = std::max(per_bin * (to_f32(static_cast<double>(i)) + 0.5F), 1.0F);
        gain[i] = std::pow(10.0F, (constant + spreading * std::log10(r) + per_metre * r) / 10);
    }
    return gain;
}

float to_share(float power, float gain, bool paper) {
    return paper ? power : std::min(1.0F, std::sqrt(power * gain));
}

reson7k::Image make_image(const PingRecord& ping, const Settings& settings, const Echogram& echogram) {
    constexpr std::size_t most_rows = 1024;
    const std::size_t bins = echogram.shot.bins, beams = echogram.beams();
    const std::size_t per_row = (bins + most_rows - 1) / most_rows;
    reson7k::Image image;
    image.ping = ping.number;
    image.width = static_cast<std::uint32_t>(beams);
    image.height = static_cast<std::uint32_t>((bins + per_row - 1) / per_row);
    image.samples = static_cast<std::uint32_t>(bins);
    image.flags = 2;  // beams are not stabilised
    image.pixels.resize(image.height * beams);
    const auto gain = gain_curve(ping, settings, echogram);
    const bool paper = echogram.rule == EchoRule::cerqueira2016;
    std::vector<float> shares(beams), greatest(beams);
    for_each_bin(echogram, [&](std::size_t bin, const float* powers) {
        to_shares(powers, gain[bin], paper, beams, shares.data());
        const bool begins = bin % per_row == 0, ends = bin % per_row + 1 == per_row || bin + 1 == bins;
        for (std::size_t i = 0; i < beams; ++i)
            greatest[i] = begins ? shares[i] : std::max(greatest[i], shares[i]);
        if (!ends) return;
        std::uint8_t* row = &image.pixels[bin / per_row * beams];
        for (std::size_t i = 0; i < beams; ++i) row[i] = static_cast<std::uint8_t>(greatest[i] * 255 + 0.5F);
    });
    return image;
}

reson7k::Beamformed make_beamformed(const PingRecord& ping, const Settings& settings,
                                    const Echogram& echogram) {
    const std::size_t bins = echogram.shot.bins, beams = echogram.beams();
    reson7k::Beamformed record;
    record.serial = settings.serial;
    record.ping = ping.number;
    record.beams = static_cast<std::uint16_t>(beams);
    record.samples = static_cast<std::uint32_t>(bins);
    record.data.resize(bins * beams);
    const auto gain = gain_curve(ping, settings, echogram);
    const bool paper = echogram.rule == EchoRule::cerqueira2016;
    std::vector<float> shares(beams);
    for_each_bin(echogram, [&](std::size_t bin, const float* powers) {
        to_shares(powers, gain[bin], paper, beams, shares.data());
        to_samples(powers, shares.data(), beams, &record.data[bin * beams]);
    });
    return record;
}

}  // namespace echoloop::reson7k_device
