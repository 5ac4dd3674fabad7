#include "render/fan/target_beams.h"

#include <algorithm>
#include <cmath>

#include "render/acoustics/pattern_table.h"
#include "render/fan/plan_parts.h"
#include "render/simd.h"

namespace echoloop {
namespace {

constexpr float least_heard = 1e-8F;  ///< of the axis, two ways

/// Powers one way. `real`, `imaginary`: amplitudes over the sine from -1 on, `per_sine` of them to a unit.
/// `sines`, `cosines`: of the beams' bearings; `sine`, `cosine`: of where the echo comes from.
ECHOLOOP_SIMD
void hear(const float* __restrict real, const float* __restrict imaginary, float per_sine,
          const float* __restrict sines, const float* __restrict cosines, float sine, float cosine, int count,
          float* __restrict out) {
    constexpr auto behind =
        static_cast<float>(AperturePattern::back_amplitude * AperturePattern::back_amplitude);
    for (int i = 0; i < count; ++i) {
        const float beside = sine * cosines[i] - cosine * sines[i];
        const float ahead = cosine * cosines[i] + sine * sines[i];
        const float place = (std::min(std::max(beside, -1.0F), 1.0F) + 1.0F) * per_sine;
        const int cell = static_cast<int>(place);
        const float share = place - static_cast<float>(cell);
        const float re = real[cell] + share * (real[cell + 1] - real[cell]);
        const float im = imaginary[cell] + share * (imaginary[cell + 1] - imaginary[cell]);
        const float power = re * re + im * im;
        out[i] = ahead < 0 ? behind * power : power;
    }
}

}  // namespace

class TargetBeams::Known {
  public:
    explicit Known(const FanPlan& plan)
        : fan_(plan.geometry), edge_(FanLobes(fan_, nullptr).horizontal.edge()) {
        for (const double bearing : fan_.bearings) {
            sines_.push_back(static_cast<float>(std::sin(bearing)));
            cosines_.push_back(static_cast<float>(std::cos(bearing)));
        }
        if (!fan_.patterns) return;
        const AperturePattern aperture = TwoWayPattern(fan_.horizontal, fan_.beam_width).aperture();
        const std::size_t values = pattern_values(aperture.length_in_wavelengths());
        per_sine_ = static_cast<float>(values);
        for (std::size_t i = 0; i <= 2 * values; ++i) {
            const double sine = static_cast<double>(i) / static_cast<double>(values) - 1;
            const std::complex<float> amplitude =
                plan.errors ? plan.errors->at_sine(sine) : static_cast<float>(aperture.at_sine(sine));
            real_.push_back(amplitude.real()), imaginary_.push_back(amplitude.imag());
        }
        real_.push_back(real_.back()), imaginary_.push_back(imaginary_.back());
    }

    bool fits(const FanPlan& plan) const {
        const FanGeometry& g = plan.geometry;
        return fan_.beam_width == g.beam_width && fan_.horizontal == g.horizontal &&
               fan_.patterns == g.patterns && fan_.side_lobes == g.side_lobes && fan_.errors == g.errors &&
               fan_.staves == g.staves && fan_.bearings == g.bearings;
    }

    /// Two-way power by which each beam hears the target.
    void weigh(const TargetEcho& target, float* out) const {
        const std::size_t beams = fan_.bearings.size();
        if (fan_.patterns) {
            hear(target.bearing, out);
            if (fan_.horizontal.ways == 2) {
                static thread_local std::vector<float> sent;
                sent.assign(out, out + beams);
                if (target.turned != 0) hear(target.bearing - target.turned, sent.data());
                for (std::size_t beam = 0; beam < beams; ++beam) out[beam] *= sent[beam];
            }
            if (fan_.side_lobes) return;
        } else {
            std::fill_n(out, beams, 1.0F);
        }
        for (std::size_t beam = 0; beam < beams; ++beam)
            if (std::abs(target.bearing - fan_.bearings[beam]) > edge_) out[beam] = 0;
    }

  private:
    void hear(double bearing, float* out) const {
        echoloop::hear(real_.data(), imaginary_.data(), per_sine_, sines_.data(), cosines_.data(),
                       static_cast<float>(std::sin(bearing)), static_cast<float>(std::cos(bearing)),
                       static_cast<int>(sines_.size()), out);
    }

    FanGeometry fan_;
    double edge_;
    float per_sine_ = 0;
    std::vector<float> real_, imaginary_;  ///< amplitudes one way, over the sine, and one beyond the last
    std::vector<float> sines_, cosines_;   ///< of the beams' bearings
};

TargetBeams::TargetBeams() : known_(16) {}
TargetBeams::~TargetBeams() = default;

std::vector<PointEcho> TargetBeams::points_of(const FanPlan& plan, std::span<const TargetEcho> targets) {
    std::vector<PointEcho> points;
    if (targets.empty()) return points;
    const std::size_t beams = plan.geometry.bearings.size();
    if (beams == 1) {
        for (const TargetEcho& target : targets)
            points.push_back({0, target.range, target.power, target.phase});
        return points;
    }
    const Known& known = known_.get([&](const Known& other) { return other.fits(plan); },
                                    [&] { return std::pair(Known(plan), std::size_t{1}); });
    weights_.resize(targets.size() * beams);
    for (std::size_t i = 0; i < targets.size(); ++i) known.weigh(targets[i], &weights_[i * beams]);
    for (std::size_t beam = 0; beam < beams; ++beam)
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const float weight = weights_[i * beams + beam];
            if (weight > least_heard)
                points.push_back(
                    {beam, targets[i].range, targets[i].power * double{weight}, targets[i].phase});
        }
    return points;
}

}  // namespace echoloop
