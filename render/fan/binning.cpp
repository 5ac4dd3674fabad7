#include "render/fan/binning.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "render/fan/extent.h"
#include "render/fan/line_bins.h"

namespace echoloop {
namespace {

PixelLine line_of(const BinningInput& in, std::size_t line) {
    const std::size_t samples = in.plan.samples, in_view = line % in.plan.views.front().lines;
    const Pixel* pixels = &in.pixels[line * samples];
    const bool first = in_view == 0, last = in_view + 1 == in.plan.views.front().lines;
    return {samples,
            pixels,
            first ? pixels : pixels - samples,
            last ? pixels : pixels + samples,
            &in.plan.coverage[line * samples],
            in.offset};
}

/// Along a plane seen at grazing incidence the solid angle of a slice of range falls as R^-2, cos(i) as R^-1
/// and the spreading as R^-2: the relative slope of power over range within one footprint, per metre.
float slope_within(float range, float absorption) { return -(5 / range + 4 * absorption); }

/// Deposits amount(pixel, range, weight) for every pixel of the line that shows a surface within the fan.
template <typename Amount>
void bin_line(const BinningInput& in, std::size_t number, const std::vector<float>& weights, LineBins& bins,
              const Amount& amount) {
    const PixelLine line = line_of(in, number);
    const float* weight = &weights[number * line.samples];
    const auto absorption = static_cast<float>(in.absorption),
               per_metre = static_cast<float>(1 / in.bin_length);
    const auto start = static_cast<float>(in.first_range / in.bin_length);
    for (std::size_t i = 0; i < line.samples; ++i) {
        if (line.pixels[i].surface == 0 || weight[i] == 0) continue;
        const Extent extent = extent_of(line, i);
        const float near = extent.near * per_metre - start, far = extent.far * per_metre - start;
        const float steepest = 1.8F / (far - near);  // beyond, the density at the far end would be negative
        const float slope = std::max(slope_within(extent.middle, absorption) / per_metre, -steepest);
        bins.deposit(near, far, amount(line.pixels[i], extent.middle, weight[i]), slope);
    }
}

/// Runs `fill(line, bins)` for every line that feeds one of the beams begin..end, and adds its bins to those.
template <typename Fill>
void gather_beams(const BinningInput& in, std::size_t begin, std::size_t end, std::vector<float>& values,
                  const Fill& fill) {
    LineBins bins(in.bins);
    for (std::size_t line = 0; line < in.plan.lines; ++line) {
        const BeamShare* first = in.plan.shares.data() + in.plan.first_share[line];
        const BeamShare* last = in.plan.shares.data() + in.plan.first_share[line + 1];
        while (first != last && first->beam < begin) ++first;
        while (first != last && (last - 1)->beam >= end) --last;
        if (first == last) continue;
        bins.clear();
        fill(line, bins);
        for (; first != last; ++first) bins.add_to(&values[first->beam * in.bins], first->weight);
    }
}

/// Beams are dealt out to threads; each beam sums its lines in their order, so the number of threads changes
/// nothing.
template <typename Fill>
void gather(const BinningInput& in, std::vector<float>& values, const Fill& fill) {
    constexpr std::size_t pixels_per_thread = 40'000, most_threads = 4;
    const std::size_t useful = std::min<std::size_t>(
        {most_threads, std::thread::hardware_concurrency(), in.beams, in.pixels.size() / pixels_per_thread});
    const std::size_t threads = std::max<std::size_t>(useful, 1);
    std::vector<std::jthread> workers;
    for (std::size_t i = 1; i < threads; ++i)
        workers.emplace_back(
            [&, i] { gather_beams(in, in.beams * i / threads, in.beams * (i + 1) / threads, values, fill); });
    gather_beams(in, 0, in.beams / threads, values, fill);
}

void bin_radiometric(const BinningInput& in, std::vector<float>& values) {
    std::vector<float> strength;  // per surface: SL mu
    for (const float mu : in.mu) strength.push_back(static_cast<float>(in.source_power * mu));
    const auto decay = static_cast<float>(-4 * in.absorption);
    const auto power = [&](const Pixel& pixel, float range, float solid_angle) {
        // cos(i) is the distance of the surface's plane over R, and was taken at the sample point.
        const float spreading = std::exp(decay * range) * pixel.range / (range * range * range);
        return strength[static_cast<std::size_t>(pixel.surface) - 1] * pixel.cosine * solid_angle * spreading;
    };
    gather(in, values,
           [&](std::size_t line, LineBins& bins) { bin_line(in, line, in.plan.solid_angle, bins, power); });
}

void bin_cerqueira(const BinningInput& in, std::vector<float>& values) {
    std::vector<float> pixels(values.size());
    const auto share = [](const Pixel&, float, float coverage) { return coverage; };
    const auto echo = [](const Pixel& pixel, float, float coverage) {
        return coverage * cerqueira_sigmoid(pixel.cosine);
    };
    gather(in, pixels,
           [&](std::size_t line, LineBins& bins) { bin_line(in, line, in.plan.coverage, bins, share); });
    gather(in, values,
           [&](std::size_t line, LineBins& bins) { bin_line(in, line, in.plan.coverage, bins, echo); });
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = pixels[i] > 0 ? values[i] / pixels[i] : 0;
}

}  // namespace

void bin_pixels(const BinningInput& input, std::vector<float>& values) {
    values.assign(input.beams * input.bins, 0.0F);
    input.rule == EchoRule::radiometric ? bin_radiometric(input, values) : bin_cerqueira(input, values);
}

float cerqueira_sigmoid(float cosine) { return 1 / (1 + std::exp(-18 * (cosine - 2.0F / 3))); }

}  // namespace echoloop
