#include "emulator/devices/imagenex-831l/echo.h"

#include <algorithm>
#include <cmath>

#include "protocols/imagenex/pipe_ranges.h"

namespace echoloop::imagenex831l {

using imagenex::SwitchCommand;

std::vector<double> amplitudes(const Echogram& echogram, const SwitchCommand& command,
                               const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const auto beam = echogram.beam(0);
    if (echogram.rule == EchoRule::cerqueira2016) return {beam.begin(), beam.end()};
    const double absorption = 2 * command.absorption / 100.0;  // dB/m
    std::vector<double> out(beam.size());
    for (std::size_t i = 0; i < beam.size(); ++i) {
        const double r = sound_speed / 2 * (static_cast<double>(i) + 0.5) * echogram.shot.bin_interval;
        const double tvg = a.tvg ? 20 * std::log10(std::max(r, a.nearest_range)) + absorption * r : 0.0;
        out[i] =
            std::sqrt(double(beam[i])) * std::pow(10.0, (command.start_gain + tvg - a.full_scale_level) / 20);
    }
    return out;
}

std::vector<std::uint8_t> echo_data(const std::vector<double>& samples, const Settings& settings) {
    const std::size_t each = std::max<std::size_t>(samples.size() / points, 1);
    std::vector<std::uint8_t> data(points);
    for (std::size_t i = 0; i < points && (i + 1) * each <= samples.size(); ++i) {
        double power = 0;
        for (std::size_t k = i * each; k < (i + 1) * each; ++k) power += samples[k] * samples[k];
        const double fraction = std::sqrt(power / static_cast<double>(each));
        data[i] = static_cast<std::uint8_t>(
            std::min<double>(settings.ceiling, std::floor(fraction * (settings.ceiling + 1))));
    }
    return data;
}

double profile_range(const std::vector<double>& samples, const SwitchCommand& command,
                     const Settings& settings) {
    if (samples.empty()) return 0;
    const double step = imagenex::pipe_range(command.range).metres / static_cast<double>(samples.size());
    const double from = std::max(settings.acoustics.nearest_range, command.minimum_profile_range / 100.0);
    const auto above = [&](double sample) { return sample > settings.profile_threshold; };
    const auto nearest = std::min(samples.size(), static_cast<std::size_t>(std::ceil(from / step - 1e-9)));
    const auto first =
        std::find_if(samples.begin() + static_cast<std::ptrdiff_t>(nearest), samples.end(), above);
    if (first == samples.end()) return 0;
    const double begin = static_cast<double>(first - samples.begin()) * step;
    if ((command.motion & imagenex::motion::start_of_pulse) != 0) return begin;
    // Speckle leaves gaps in an echo: it ends with the last sample above, within two pulses.
    const double pulse = command.pulse_length * 1e-6 * sound_speed / 2;
    const auto longest = static_cast<std::ptrdiff_t>(std::ceil(2 * pulse / step));
    auto last = first;
    for (auto at = first; at != samples.end() && at - first < longest; ++at)
        if (above(*at)) last = at;
    const double end = static_cast<double>(last - samples.begin() + 1) * step;
    // Of a pulse that falls within half its length (render/acoustics/pulse.h).
    constexpr double middle = 0.75;
    return std::max((begin + end) / 2 - middle * pulse, step);
}

imagenex::Packed14 profile_word(double range, const SwitchCommand& command, const Settings& settings) {
    constexpr long most = 0x3FFF;
    if (!(range > 0)) return {};
    if (settings.subtract_delay) range -= imagenex::pipe_range(command.range).filter_delay;
    const double unit = settings.unit == ProfileUnit::centimetres ? 0.01 : resolution;
    return imagenex::Packed14(static_cast<std::uint64_t>(std::clamp(std::lround(range / unit), 1L, most)));
}

}  // namespace echoloop::imagenex831l
