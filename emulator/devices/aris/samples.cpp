#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "emulator/devices/aris/frame.h"

namespace echoloop::aris_device {
namespace {

constexpr double steps_per_db = 255.0 / 80;
constexpr double nominal_sound_speed = 1500;  // m/s, of the time-varied gain

/// Sample steps above 1 uPa^2 by the upper half of a float: exponent and 7 bits, 0.03 dB each.
class StepTable {
  public:
    StepTable() {
        for (std::uint32_t i = 1; i < steps_.size(); ++i) {
            const auto power = std::bit_cast<float>(i << 16 | 0x8000U);
            steps_[i] = static_cast<float>(steps_per_db * 10 * std::log10(static_cast<double>(power)));
        }
        steps_[0] = -1e6F;
    }
    float of(float power) const {
        return power > 0 ? steps_[std::bit_cast<std::uint32_t>(power) >> 16] : steps_[0];
    }

  private:
    std::array<float, 0x7F80> steps_{};  // up to infinity
};

/// Steps that each sample gets beside its level's own.
std::vector<float> offsets(const FrameRecord& frame, const Settings& s) {
    const Acoustics& a = s.acoustics;
    std::vector<float> out(frame.acoustics.samples);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double time =
            frame.acoustics.start_delay + (static_cast<double>(i) + 0.5) * frame.acoustics.sample_period;
        const double range = std::max(1.0, nominal_sound_speed / 2 * 1e-6 * time);
        const double tvg =
            a.tvg_spreading * std::log10(range) + 2 * carrier_of(frame.acoustics, s).tvg_absorption * range;
        const double db = static_cast<double>(frame.acoustics.gain) - a.floor_level +
                          (s.tvg ? std::min(tvg, a.tvg_limit) : 0);
        out[i] = static_cast<float>(steps_per_db * db) + 0.5F;
    }
    return out;
}

void write_beam(std::span<const float> levels, std::span<const float> offset, const StepTable& table,
                std::uint8_t* out, std::size_t stride) {
    for (std::size_t i = 0; i < levels.size(); ++i)
        out[i * stride] =
            static_cast<std::uint8_t>(std::clamp(table.of(levels[i]) + offset[i], 0.0F, 255.0F));
}

/// Shares of full scale, which gains do not touch.
void write_shares(std::span<const float> shares, std::uint8_t* out, std::size_t stride) {
    for (std::size_t i = 0; i < shares.size(); ++i)
        out[i * stride] = static_cast<std::uint8_t>(std::clamp(shares[i] * 255 + 0.5F, 0.0F, 255.0F));
}

}  // namespace

void write_samples(const Echogram& echogram, const FrameRecord& frame, const Settings& settings,
                   std::span<std::uint8_t> out) {
    static const StepTable table;
    const aris::PingMode& mode = *aris::find_ping_mode(frame.acoustics.ping_mode);
    const std::vector<float> offset = offsets(frame, settings);
    const bool paper = echogram.rule == EchoRule::cerqueira2016;
    for (std::size_t ping = 0; ping < mode.pings; ++ping)
        for (std::size_t channel = 0; channel < aris::channels; ++channel) {
            const std::size_t beam = ping + aris::channel_map[channel] * mode.pings;
            const auto levels = echogram.beam(mode.beams - 1 - beam);
            const std::size_t first =
                settings.reordered ? beam : ping * levels.size() * aris::channels + channel;
            const std::size_t stride = settings.reordered ? mode.beams : aris::channels;
            if (paper)
                write_shares(levels, out.data() + first, stride);
            else
                write_beam(levels, offset, table, out.data() + first, stride);
        }
}

}  // namespace echoloop::aris_device
