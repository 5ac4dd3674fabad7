#include "render/fan/binning.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/fan/line_bins.h"

namespace echoloop {
namespace {

/// The pixels of one line with their weights and the lines on both sides (at a view's edge the line itself).
struct Line {
    std::size_t samples;
    const Pixel *pixels, *before, *after;
    const float* weights;
};

Line line_of(const BinningInput& in, std::size_t line, const std::vector<float>& weights) {
    const std::size_t samples = in.plan.samples, in_view = line % in.plan.views.front().lines;
    const Pixel* pixels = &in.pixels[line * samples];
    return {samples, pixels, in_view == 0 ? pixels : pixels - samples,
            in_view + 1 == in.plan.views.front().lines ? pixels : pixels + samples, &weights[line * samples]};
}

/// Distance in range to a neighbour; none when the neighbour shows nothing or is the pixel itself.
float step_to(const Pixel& pixel, const Pixel& neighbour) {
    constexpr float none = std::numeric_limits<float>::infinity();
    return neighbour.surface == 0 || &neighbour == &pixel ? none : std::abs(neighbour.range - pixel.range);
}

/// The plane of a facet may reach much farther than the facet, as on the crest of a ripple. So a footprint
/// goes at most half as far again as the nearer of the two neighbours; on a smooth surface that never binds.
float footprint_of(const Line& line, std::size_t i) {
    const Pixel& pixel = line.pixels[i];
    if (pixel.footprint < 0)
        return std::min(-pixel.footprint,
                        1.5F * std::min(step_to(pixel, line.before[i]), step_to(pixel, line.after[i])));
    const Pixel& upper = line.pixels[i > 0 ? i - 1 : i];
    const Pixel& lower = line.pixels[i + 1 < line.samples ? i + 1 : i];
    return std::min(pixel.footprint, 1.5F * std::min(step_to(pixel, upper), step_to(pixel, lower)));
}

/// Deposits amount(pixel, weight) for every pixel of the line that shows a surface within the fan.
template <typename Amount>
void bin_line(const BinningInput& in, const Line& line, LineBins& bins, const Amount& amount) {
    const auto per_metre = static_cast<float>(1 / in.bin_length);
    const auto start = static_cast<float>(in.first_range / in.bin_length);
    for (std::size_t i = 0; i < line.samples; ++i) {
        const Pixel& pixel = line.pixels[i];
        if (pixel.surface == 0 || line.weights[i] == 0) continue;
        const float centre = pixel.range * per_metre - start, half = 0.5F * footprint_of(line, i) * per_metre;
        bins.deposit(centre - half, centre + half, amount(pixel, line.weights[i]));
    }
}

/// Runs `fill(line, bins)` for every line and adds its bins to the beams that it belongs to, in the order of
/// lines.
template <typename Fill>
void gather(const BinningInput& in, std::vector<float>& values, const Fill& fill) {
    LineBins bins(in.bins);
    for (std::size_t line = 0; line < in.plan.lines; ++line) {
        const std::uint32_t first = in.plan.first_share[line], last = in.plan.first_share[line + 1];
        if (first == last) continue;
        bins.clear();
        fill(line, bins);
        for (std::uint32_t i = first; i < last; ++i)
            bins.add_to(&values[in.plan.shares[i].beam * in.bins], in.plan.shares[i].weight);
    }
}

void bin_radiometric(const BinningInput& in, std::vector<float>& values) {
    std::vector<float> strength;  // per surface: SL mu
    for (const float mu : in.mu) strength.push_back(static_cast<float>(in.source_power * mu));
    const auto decay = static_cast<float>(-4 * in.absorption);
    const auto power = [&](const Pixel& pixel, float solid_angle) {
        const float spreading = std::exp(decay * pixel.range) / (pixel.range * pixel.range);
        return strength[static_cast<std::size_t>(pixel.surface) - 1] * pixel.cosine * solid_angle * spreading;
    };
    gather(in, values, [&](std::size_t line, LineBins& bins) {
        bin_line(in, line_of(in, line, in.plan.solid_angle), bins, power);
    });
}

void bin_cerqueira(const BinningInput& in, std::vector<float>& values) {
    std::vector<float> pixels(values.size());
    const auto share = [](const Pixel&, float coverage) { return coverage; };
    const auto echo = [](const Pixel& pixel, float coverage) {
        return coverage * cerqueira_sigmoid(pixel.cosine);
    };
    gather(in, pixels, [&](std::size_t line, LineBins& bins) {
        bin_line(in, line_of(in, line, in.plan.coverage), bins, share);
    });
    gather(in, values, [&](std::size_t line, LineBins& bins) {
        bin_line(in, line_of(in, line, in.plan.coverage), bins, echo);
    });
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = pixels[i] > 0 ? values[i] / pixels[i] : 0;
}

}  // namespace

void bin_pixels(const BinningInput& input, std::vector<float>& values) {
    values.assign(input.beams * input.bins, 0.0F);
    input.rule == EchoRule::radiometric ? bin_radiometric(input, values) : bin_cerqueira(input, values);
}

float cerqueira_sigmoid(float cosine) { return 1 / (1 + std::exp(-18 * (cosine - 2.0F / 3))); }

}  // namespace echoloop
