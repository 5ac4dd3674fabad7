#include "render/fan/line_sums.h"

namespace echoloop {
namespace {

constexpr bool is_echo(Amount amount) { return amount == Amount::echo || amount == Amount::wanted_echo; }

template <Amount amount>
inline float amount_of(const BinningInput& in, const PixelRow& row, std::size_t i, float middle, float weight) {
    if constexpr (amount == Amount::paper_share) return weight;
    if constexpr (amount == Amount::paper_echo) return weight * cerqueira_sigmoid(row.cosine()[i]);
    // cos(i) is the distance of the surface's plane over R, and was taken at the sample point.
    const float cosine = std::min(row.cosine()[i] * row.range()[i] / middle, 1.0F);
    return weight * in.strength[static_cast<std::size_t>(row.surface()[i]) - 1].at(cosine);
}

/// Calls deposit(i, near, far, amount, slope) for every pixel of the line that shows a surface and has weight.
template <Amount amount, typename Deposit>
void for_each_echo(const BinningInput& in, const BinGain& gain, const LineReader& reader, const float* weight,
                   std::size_t samples, const Deposit& deposit) {
    const auto per_metre = static_cast<float>(1 / in.bin_length),
               start = static_cast<float>(in.first_range / in.bin_length),
               near_limit = static_cast<float>(gain.near_limit());
    const PixelRow& row = reader.row();
    const Extents& extents = reader.extents();
    const float *surface = row.surface(), *near_edge = extents.near.data(), *far_edge = extents.far.data();
    for (std::size_t i = 0; i < samples; ++i) {
        if (surface[i] == 0 || weight[i] == 0) continue;
        if constexpr (amount == Amount::wanted_echo)
            if (in.wanted[static_cast<std::size_t>(surface[i]) - 1] == 0) continue;
        const float middle = extents.middle[i];
        const float near = near_edge[i] * per_metre - start, far = far_edge[i] * per_metre - start;
        float value = amount_of<amount>(in, row, i, middle, weight[i]);
        if (is_echo(amount) && middle < near_limit && far - near < 1) value *= gain.correction(middle);
        // Along a plane seen at grazing incidence the solid angle of a slice of range falls as R^-2, cos(i) as R^-1.
        const float steepest = 1.8F / (far - near);  // beyond, the density at the far end would be negative
        deposit(i, near, far, value, std::max(-3 / (middle * per_metre), -steepest));
    }
}

template <Amount amount>
void add_level(const BinningInput& in, const BinGain& gain, const LineReader& reader, const float* weight,
               std::size_t samples, LineBins& bins) {
    LineBins local = bins;  // its limits stay in registers
    for_each_echo<amount>(in, gain, reader, weight, samples,
                          [&](std::size_t, float near, float far, float value, float slope) {
                              local.deposit(near, far, value, slope);
                          });
    bins = local;
}

}  // namespace

void LineSums::resize(std::size_t lines, std::size_t sectors, std::size_t bins) {
    if (bins == bins_ && lines == lines_.size() && sectors == sectors_.size()) {
        for (auto* rows : {&lines_, &sectors_})
            for (LineBins& row : *rows) row.clear();
        return;
    }
    bins_ = bins;
    values_.assign((lines + sectors) * bins, 0.0F);
    lines_.clear(), sectors_.clear();
    for (std::size_t i = 0; i < lines; ++i) lines_.emplace_back(&values_[i * bins], bins);
    for (std::size_t i = 0; i < sectors; ++i) sectors_.emplace_back(&values_[(lines + i) * bins], bins);
}

void LineReader::read(const BinningInput& in, const View& view, std::size_t line) {
    const std::size_t stride = in.plan.samples, number = view.first_line + line;
    const Pixel* pixels = &in.pixels[number * stride];
    const bool first = line == 0, last = line + 1 == view.lines;
    if (next_ == number) {
        std::swap(rows_[0], rows_[1]);
        std::swap(rows_[1], rows_[2]);
    } else {
        if (!first) rows_[0].load(pixels - stride, view.samples);
        rows_[1].load(pixels, view.samples);
    }
    if (!last) rows_[2].load(pixels + stride, view.samples);
    next_ = last ? no_line : number + 1;
    const float* coverage = &in.plan.coverage[view.first_pixel + line * view.samples];
    find_extents(first ? rows_[1] : rows_[0], rows_[1], last ? rows_[1] : rows_[2], coverage, in.offset, view.samples,
                 number >= in.plan.lines, extents_);
}

void add_level_line(const BinningInput& in, const BinGain& gain, Amount amount, const View& view, std::size_t line,
                    LineReader& reader, LineBins& bins) {
    reader.read(in, view, line);
    const std::size_t first = view.first_pixel + line * view.samples;
    switch (amount) {
        case Amount::echo:
            return add_level<Amount::echo>(in, gain, reader, &in.plan.weight[first], view.samples, bins);
        case Amount::wanted_echo:
            return add_level<Amount::wanted_echo>(in, gain, reader, &in.plan.weight[first], view.samples, bins);
        case Amount::paper_echo:
            return add_level<Amount::paper_echo>(in, gain, reader, &in.plan.coverage[first], view.samples, bins);
        case Amount::paper_share:
            return add_level<Amount::paper_share>(in, gain, reader, &in.plan.coverage[first], view.samples, bins);
    }
}

void add_surround_line(const BinningInput& in, const BinGain& gain, Amount amount, const View& view, std::size_t line,
                       LineReader& reader, LineSums& sums) {
    reader.read(in, view, line);
    const std::size_t first = view.first_pixel + line * view.samples;
    const SectorShare* share = &in.plan.sector[first - in.plan.first_surround_pixel];
    const auto deposit = [&](std::size_t i, float near, float far, float value, float slope) {
        const SectorShare to = share[i];
        if (to.next < 1) sums.sector(to.sector).deposit(near, far, value * (1 - to.next), slope);
        if (to.next > 0) sums.sector(to.sector + 1U).deposit(near, far, value * to.next, slope);
    };
    const float* weight = &in.plan.weight[first];
    if (amount == Amount::wanted_echo)
        for_each_echo<Amount::wanted_echo>(in, gain, reader, weight, view.samples, deposit);
    else
        for_each_echo<Amount::echo>(in, gain, reader, weight, view.samples, deposit);
}

void list_echoes(const BinningInput& in, const BinGain& gain, Amount amount, const View& view, std::size_t line,
                 LineReader& reader, std::vector<PixelEcho>& echoes) {
    reader.read(in, view, line);
    echoes.clear();
    const auto list = [&](std::size_t i, float near, float far, float value, float slope) {
        echoes.push_back({static_cast<std::uint32_t>(i), near, far, value, slope});
    };
    const std::size_t first = view.first_pixel + line * view.samples, count = view.samples;
    const float *weight = &in.plan.weight[first], *coverage = &in.plan.coverage[first];
    switch (amount) {
        case Amount::echo:
            return for_each_echo<Amount::echo>(in, gain, reader, weight, count, list);
        case Amount::wanted_echo:
            return for_each_echo<Amount::wanted_echo>(in, gain, reader, weight, count, list);
        case Amount::paper_echo:
            return for_each_echo<Amount::paper_echo>(in, gain, reader, coverage, count, list);
        case Amount::paper_share:
            return for_each_echo<Amount::paper_share>(in, gain, reader, coverage, count, list);
    }
}

}  // namespace echoloop
