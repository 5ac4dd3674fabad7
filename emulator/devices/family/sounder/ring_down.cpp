#include "emulator/devices/family/sounder/ring_down.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace echoloop::echosounder {

double ring_down_power(const RingDown& ring, const Shot& shot, std::size_t bin) {
    const double from = shot.first_bin_time + static_cast<double>(bin) * shot.bin_interval;
    const double to = from + shot.bin_interval, end = ring.start + std::max(shot.pulse_length, ring.hold);
    const double rate = ring.decay * std::numbers::ln10 / 10;  // 1/s, of the power
    const auto left = [&](double time) { return std::exp(-rate * (std::max(time, end) - end)); };
    const double sent = std::max(0.0, std::min(to, end) - std::max(from, ring.start));
    const double ringing = (left(from) - left(to)) / rate;
    return std::pow(10.0, ring.level / 10) * (sent + ringing) / (to - from);
}

Echogram with_ring_down(Echogram echogram, const RingDown& ring) {
    if (echogram.rule == EchoRule::cerqueira2016) return echogram;
    const std::size_t bins = echogram.shot.bins;
    for (std::size_t bin = 0; bin < bins; ++bin) {
        const auto power = static_cast<float>(ring_down_power(ring, echogram.shot, bin));
        if (!(power > 0)) break;
        for (std::size_t at = bin; at < echogram.values.size(); at += bins) echogram.values[at] += power;
    }
    return echogram;
}

}  // namespace echoloop::echosounder
