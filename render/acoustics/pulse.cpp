#include "render/acoustics/pulse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/acoustics/chain.h"
#include "render/acoustics/sinc.h"

namespace echoloop {
namespace {

constexpr double chirp_reach = 6;  ///< resolutions on either side
constexpr int steps_per_resolution = 64;
constexpr double first_null = 2;

/// Amplitude of a compressed pulse with a Hamming window over its band.
double hamming(double u) { return sinc(u) + 0.46 / 1.08 * (sinc(u - 1) + sinc(u + 1)); }

double square_of_positive(double x) { return x > 0 ? x * x : 0; }

}  // namespace

double range_resolution(const Shot& shot, double sound_speed) {
    return sound_speed / 2 * (shot.bandwidth > 0 ? 1 / shot.bandwidth : shot.pulse_length);
}

PulseShape::PulseShape(const Shot& shot, double sound_speed) : length_(range_resolution(shot, sound_speed)) {
    if (shot.bandwidth > 0) {
        make_chirp_table();
        return;
    }
    const double bandwidth = shot.receiver.bandwidth;
    const double resolution = bandwidth > 0 ? sound_speed / 2 / bandwidth : length_;
    edge_ = std::min(resolution / 2, length_);
    end_ = main_end_ = length_ + edge_;
}

void PulseShape::make_chirp_table() {
    const int steps = static_cast<int>(2 * chirp_reach) * steps_per_resolution;
    const double step = 1.0 / steps_per_resolution;
    double sum = 0;
    table_.push_back(0);
    for (int i = 0; i < steps; ++i) {
        const double amplitude = hamming(((i + 0.5) * step - chirp_reach) / chirp_stretch);
        table_.push_back(sum += amplitude * amplitude * step);
    }
    for (double& energy : table_) energy *= length_ / sum;
    end_ = chirp_reach * length_;
    begin_ = -end_;
    main_end_ = first_null * chirp_stretch * length_;
    main_begin_ = -main_end_;
}

double PulseShape::energy_until(double offset) const {
    if (offset <= begin_) return 0;
    if (offset >= end_) return length_;
    if (is_chirp()) {
        const double place = (offset - begin_) / length_ * steps_per_resolution;
        const auto cell = std::min(static_cast<std::size_t>(place), table_.size() - 2);
        return table_[cell] + (place - static_cast<double>(cell)) * (table_[cell + 1] - table_[cell]);
    }
    const double rise = square_of_positive(offset - begin_) - square_of_positive(offset - begin_ - edge_);
    const double fall = square_of_positive(offset - end_ + edge_);
    return (rise - fall) / (2 * edge_);
}

}  // namespace echoloop
