#include "render/fan/pixel_echoes.h"

#include <algorithm>

#include "render/fan/patches.h"
#include "render/fan/ping_motion.h"
#include "render/fan/pixel_extents.h"

namespace echoloop {
namespace {

template <Amount amount>
inline float amount_of(const BinningInput& in, const PixelRow& row, std::size_t i, float middle,
                       float weight) {
    if constexpr (amount == Amount::paper_share) return weight;
    if constexpr (amount == Amount::paper_echo) return weight * cerqueira_sigmoid(row.cosine()[i]);
    // cos(i) is the distance of the surface's plane over R, and was taken at the sample point.
    const float cosine = std::min(row.cosine()[i] * row.range()[i] / middle, 1.0F);
    return weight * in.strength[static_cast<std::size_t>(row.surface()[i]) - 1]->at(cosine);
}

/// Calls deposit(i, near, far, amount, slope) for every pixel of the line that shows a surface and has
/// weight.
template <Amount amount, typename Deposit>
void for_each_echo(const BinningInput& in, const BinGain& gain, const LineReader& reader,
                   const PixelExtents& extents, const float* weight, const float* focus, std::size_t samples,
                   const Deposit& deposit) {
    const auto per_metre = static_cast<float>(1 / in.bin_length),
               start = static_cast<float>(in.first_range / in.bin_length),
               near_limit = static_cast<float>(gain.near_limit());
    const PixelRow& row = reader.row();

    const float *surface = row.surface(), *near_edge = extents.near.data(), *far_edge = extents.far.data();
    for (std::size_t i = 0; i < samples; ++i) {
        if (surface[i] == 0 || weight[i] == 0) continue;
        if constexpr (amount == Amount::wanted_echo)
            if (const auto index = static_cast<std::size_t>(surface[i]) - 1;
                index >= in.wanted.size() || in.wanted[index] == 0)
                continue;
        const float middle = extents.middle[i];
        const float near = near_edge[i] * per_metre - start, far = far_edge[i] * per_metre - start;
        float value = amount_of<amount>(in, row, i, middle, weight[i]);
        if (is_echo(amount) && middle < near_limit && far - near < 1) value *= gain.correction(middle);
        if (is_echo(amount) && focus != nullptr) value *= focus[i];
        // Along a plane seen at grazing incidence the solid angle of a slice of range falls as R^-2, cos(i)
        // as R^-1.
        const float steepest = 1.8F / (far - near);  // beyond, the density at the far end would be negative
        deposit(i, near, far, value, std::max(-3 / (middle * per_metre), -steepest));
    }
}

}  // namespace

void list_echoes(const BinningInput& in, const BinGain& gain, Amount amount, const View& view,
                 std::size_t line, LineReader& reader, std::vector<PixelEcho>& echoes) {
    reader.read(in, view, line);
    static thread_local PixelExtents extents;
    const std::size_t number = view.first_line + line;
    find_pixel_extents(reader.before(), reader.row(), reader.after(),
                       &in.plan.coverage[view.first_pixel + line * view.samples], in.offset.of(view),
                       view.samples, number >= in.plan.lines, extents);
    echoes.clear();
    const float water = in.water != nullptr ? in.water->surface_number() : -1;
    const float* surface = reader.row().surface();
    const auto list = [&](std::size_t i, float near, float far, float value, float slope) {
        echoes.push_back({static_cast<std::uint32_t>(i), near, far, value, slope, surface[i] == water});
    };
    const std::size_t first = view.first_pixel + line * view.samples, count = view.samples;
    const float *weight = &in.plan.weight[first], *coverage = &in.plan.coverage[first];
    if (is_echo(amount) && in.patches != nullptr && !view.surround &&
        in.patches->weigh(reader.row(), view, line, in.offset.of(view), weight, reader.weights))
        weight = reader.weights.data();
    const float* focus = focus_of(in, view, line);
    switch (amount) {
        case Amount::echo:
            return for_each_echo<Amount::echo>(in, gain, reader, extents, weight, focus, count, list);
        case Amount::wanted_echo:
            return for_each_echo<Amount::wanted_echo>(in, gain, reader, extents, weight, focus, count, list);
        case Amount::paper_echo:
            return for_each_echo<Amount::paper_echo>(in, gain, reader, extents, coverage, focus, count, list);
        case Amount::paper_share:
            return for_each_echo<Amount::paper_share>(in, gain, reader, extents, coverage, focus, count,
                                                      list);
    }
}

void shift_echoes(const BinningInput& in, const View& view, std::size_t line, LineReader& reader,
                  std::vector<PixelEcho>& echoes) {
    if (!in.motion->shifts) return;
    find_closing(*in.motion, view, in.offset.of(view), line, reader.row().surface(), reader.closing);
    const auto first = static_cast<float>(in.first_range), length = static_cast<float>(in.bin_length),
               slowness = static_cast<float>(in.motion->slowness),
               sweep = static_cast<float>(in.motion->sweep);
    for (PixelEcho& echo : echoes) {
        const float range = first + 0.5F * (echo.near + echo.far) * length;
        const float nearer = reader.closing[echo.sample] * (range * slowness + sweep) / length;
        echo.near -= nearer, echo.far -= nearer;
    }
}

}  // namespace echoloop
