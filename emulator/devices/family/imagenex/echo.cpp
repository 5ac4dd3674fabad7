#include "emulator/devices/family/imagenex/echo.h"

#include <algorithm>
#include <cmath>

namespace echoloop::imagenex_head {
namespace {

using imagenex::Kind;
using imagenex::SwitchCommand;

constexpr std::size_t most_bins = 5000;
constexpr std::uint8_t reply_end = 0xFC;

double range_of(const SwitchCommand& command) { return std::max<int>(command.range, 1); }

/// Gain and time-varied gain in dB at slant range `r`; the latter does nothing nearer than a metre.
double gain_db(double r, const SwitchCommand& command, const Settings& settings) {
    const double start = std::min<int>(command.start_gain, 40);
    if (!settings.acoustics.tvg) return start;
    r = std::max(r, 1.0);
    const double spreading = 10 * (1 + std::min<int>(command.logf, 3));
    return start + spreading * std::log10(r) + 2 * command.absorption / 100.0 * r;
}

/// `fraction` of the scale as a whole number of 0..most; cut, as recordings with many zeros suggest.
unsigned count(double fraction, int most) {
    if (!(fraction > 0)) return 0;
    return static_cast<unsigned>(std::min<double>(most, std::floor(fraction * (most + 1))));
}

std::vector<std::uint8_t> packed(const std::vector<double>& points, const Format& format,
                                 const Settings& settings) {
    std::vector<std::uint8_t> data;
    data.reserve(format.bytes);
    const auto add = [&](unsigned byte) { data.push_back(static_cast<std::uint8_t>(byte)); };
    if (format.bits == 8) {
        for (const double p : points) add(count(p, settings.ceiling));
    } else if (format.bits == 4) {
        for (std::size_t i = 0; i + 1 < points.size(); i += 2)
            add(count(points[i], 15) | count(points[i + 1], 15) << 4);
    } else if (settings.seven_bits_each) {
        for (const double p : points) {
            const imagenex::Packed14 value{std::uint64_t{count(p, 0x3FFF)}};
            add(value.low);
            add(value.high);
        }
    } else {
        for (const double p : points) {
            const unsigned value = count(p, 0xFFFF);
            add(value & 0xFF);
            add(value >> 8);
        }
    }
    return data;
}

/// The share of a point's middle sample in its power; the others have the same each. With `two_looks` the
/// noise has the variance of the mean of two: s^2 + (1 - s)^2 / (n - 1) = 1 / 2.
double middle_share(std::size_t samples, bool two_looks) {
    if (!two_looks || samples < 3) return 1.0 / static_cast<double>(samples);
    const double k = 1.0 / static_cast<double>(samples - 1);
    return (k + std::sqrt(k * k - (1 + k) * (k - 0.5))) / (1 + k);
}

}  // namespace

Format format_of(const SwitchCommand& command, const Settings& settings) {
    constexpr std::size_t igx_4_bit = 252, longest = 500;
    Format f;
    if (command.profile != 0) {
        f.kind = Kind::ipx;
        return f;
    }
    const bool many = command.data_points >= 50;
    f.kind = many ? Kind::igx : Kind::imx;
    f.bits = command.data_bits == 4 || command.data_bits == 16 ? command.data_bits : 8;
    if (f.bits == 16)
        f.bytes = longest;
    else if (f.bits == 4)
        f.bytes = many ? igx_4_bit : 128;
    else
        f.bytes = many ? longest : settings.imx_bytes;
    f.points = f.bytes * 8 / static_cast<std::size_t>(f.bits);
    return f;
}

Sampling sampling_of(const Format& format, double range, double resolution) {
    const double wanted = range / resolution;
    const auto points = std::max<std::size_t>(format.points, 1);
    const auto most = static_cast<double>(most_bins / points);
    const double per_point = std::clamp(std::ceil(wanted / static_cast<double>(points) - 1e-9), 1.0, most);
    Sampling s;
    s.per_point = static_cast<std::size_t>(per_point);
    s.bins = points * s.per_point;
    return s;
}

Shot plain_shot(const SwitchCommand& command, const Format& format, double resolution,
                const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const bool silent = command.mode != 0 && (command.mode & imagenex::mode::transmit) == 0;
    Shot shot;
    shot.bearings = {0.0};
    shot.beam_width = a.beam_width;
    shot.fan_height = a.fan_height;
    shot.bins = sampling_of(format, range_of(command), resolution).bins;
    shot.bin_interval = 2 * range_of(command) / sound_speed / static_cast<double>(shot.bins);
    shot.frequency = a.frequency;
    shot.source_level = silent ? -300 : a.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    return shot;
}

std::vector<double> amplitudes(const Echogram& echogram, const SwitchCommand& command,
                               const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const bool of_paper = echogram.rule == EchoRule::cerqueira2016;
    const auto beam = echogram.beam(0);
    std::vector<double> out(beam.size());
    for (std::size_t bin = 0; bin < beam.size(); ++bin) {
        if (of_paper) {
            out[bin] = beam[bin];
            continue;
        }
        const double r = sound_speed / 2 * (static_cast<double>(bin) + 0.5) * echogram.shot.bin_interval;
        out[bin] =
            std::sqrt(beam[bin]) * std::pow(10.0, (gain_db(r, command, settings) - a.full_scale_level) / 20);
    }
    return out;
}

std::vector<std::uint8_t> echo_data(const std::vector<double>& samples, const Format& format,
                                    const Settings& settings) {
    if (format.points == 0) return {};
    const std::size_t per_point = std::max<std::size_t>(samples.size() / format.points, 1);
    const double middle = middle_share(per_point, settings.two_looks);
    const double others = per_point > 1 ? (1 - middle) / static_cast<double>(per_point - 1) : 0;
    std::vector<double> points(format.points, 0.0);
    for (std::size_t i = 0; i < points.size() && (i + 1) * per_point <= samples.size(); ++i) {
        double power = 0;
        for (std::size_t k = 0; k < per_point; ++k) {
            const double sample = samples[i * per_point + k];
            power += (k == per_point / 2 ? middle : others) * sample * sample;
        }
        points[i] = std::sqrt(power);
    }
    auto data = packed(points, format, settings);
    if (!settings.keep_fc)
        std::replace(data.begin(), data.end(), reply_end, static_cast<std::uint8_t>(reply_end - 1));
    return data;
}

double profile_range(const std::vector<double>& samples, const SwitchCommand& command,
                     const Settings& settings) {
    const double step = range_of(command) / static_cast<double>(std::max<std::size_t>(samples.size(), 1));
    const double from = std::max(settings.acoustics.nearest_range, command.minimum_profile_range / 10.0);
    const auto first = std::min(samples.size(), static_cast<std::size_t>(std::ceil(from / step - 1e-9)));
    const auto found = std::find_if(samples.begin() + static_cast<std::ptrdiff_t>(first), samples.end(),
                                    [&](double s) { return s > settings.profile_threshold; });
    if (found == samples.end()) return 0;
    return static_cast<double>(found - samples.begin()) * step;
}

}  // namespace echoloop::imagenex_head
