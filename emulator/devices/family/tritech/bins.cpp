#include "emulator/devices/family/tritech/bins.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace echoloop::tritech {
namespace {

/// Half-decibel steps: all values of real heads are floor(255 k / 160), k = 0 to 160 (four recordings of
/// two).
std::uint8_t to_count(double db) {
    constexpr double steps = 2 * full_scale_db;
    if (!(db > 0)) return 0;
    return static_cast<std::uint8_t>(255 * std::min(steps, std::floor(2 * db)) / steps);
}

/// dB that the receiver loses while it opens, which takes bins, whatever their length: our own fit to
/// recordings of 50 and of 100 mm a bin. The second bin is always 0; of the first only what breaks through a
/// long one is left, and how it is divided between the two is our own choice.
double closed_db(std::size_t bin) {
    constexpr std::array<double, 5> lost{40, 2 * full_scale_db, 15.6, 6, 1.5};
    return bin < lost.size() ? lost[bin] : 0;
}

}  // namespace

double shown_db(const Echogram& echogram, std::size_t bin, const Acoustics& acoustics, const Tuning& tuning,
                double gain_db) {
    const float value = echogram.beam(0)[bin];
    if (echogram.rule == EchoRule::cerqueira2016) return full_scale_db * value;
    return level_db(value) + tvg_db(echogram.bin_range(bin), acoustics, tuning) + gain_db -
           acoustics.reference_level;
}

std::vector<std::uint8_t> levels_8bit(const Echogram& echogram, const Acoustics& acoustics,
                                      const Tuning& tuning, std::uint8_t gain) {
    const double gain_db = full_scale_db * std::min<int>(gain, 210) / 210.0;
    std::vector<std::uint8_t> levels(echogram.beam(0).size());
    for (std::size_t bin = 0; bin < levels.size(); ++bin)
        levels[bin] = to_count(shown_db(echogram, bin, acoustics, tuning, gain_db) - closed_db(bin));
    return levels;
}

std::vector<std::uint8_t> pack_4bit(const std::vector<std::uint8_t>& levels, const Packing& packing,
                                    std::uint8_t ad_low, std::uint8_t ad_span) {
    const int scale = packing.span_of_15 ? 17 : 1;
    const int low = ad_low * scale, span = std::max(1, ad_span * scale);
    const auto nibble = [&](std::size_t bin) {
        if (bin >= levels.size()) return 0;
        return std::clamp((levels[bin] - low) * 15 / span, 0, 15);
    };
    std::vector<std::uint8_t> packed((levels.size() + 1) / 2);
    for (std::size_t i = 0; i < packed.size(); ++i) {
        const int first = nibble(2 * i), second = nibble(2 * i + 1);
        packed[i] = static_cast<std::uint8_t>(packing.high_first ? first << 4 | second : second << 4 | first);
    }
    return packed;
}

}  // namespace echoloop::tritech
