// The normal numbers of one beam, of its speckle and its noise: white ones of angular cells, filtered over
// range and over directions.
#include <algorithm>
#include <cmath>
#include <optional>

#include "render/acoustics/beam_chain.h"
#include "render/acoustics/chain_kernels.h"
#include "render/acoustics/lean_kernels.h"

namespace echoloop {
namespace {

constexpr std::size_t part_size = 128;  ///< bins that are looked at together

}  // namespace

/// Neighbouring beams share cells: the last ones are kept.
const float* BeamChain::field_of(Kind kind, std::uint32_t cell) {
    auto& fields = fields_[kind].of_cells;
    Field* oldest = &fields[0];
    for (Field& field : fields) {
        if (field.cell == cell) {
            field.used = ++uses_;
            return field.values.data();
        }
        if (field.used < oldest->used) oldest = &field;
    }
    oldest->cell = cell;
    oldest->used = ++uses_;
    fill(kind, cell, oldest->values);
    return oldest->values.data();
}

void BeamChain::fill(Kind kind, std::uint32_t cell, std::vector<float>& out) {
    if (ping_.rows.empty())
        fill_from(ping_.view, ping_.key, kind, cell, out);
    else
        mix_rows(kind, cell, out);
}

/// What a row of beams hears of the rows of cells around it.
void BeamChain::mix_rows(Kind kind, std::uint32_t cell, std::vector<float>& out) {
    HeardCells rows;
    for (const CellRow& row : ping_.rows) {
        const float weight = kind == noise ? row.noise : row.echo;
        if (weight == 0) continue;
        std::vector<float>& field = of_rows_[kind].of(row.share.row, cell);
        if (field.empty()) fill_from(row.view, row.share.key, kind, cell, field);
        rows.fields[rows.count] = field.data();
        rows.weights[rows.count++] = weight;
    }
    out.resize(plan_->bins);
    kernels::weighted_sum(rows.fields.data(), rows.weights.data(), rows.count, plan_->bins, out.data());
}

void BeamChain::fill_from(const ScattererView& view, std::uint64_t key, Kind kind, std::uint32_t cell,
                          std::vector<float>& out) {
    out.resize(plan_->bins);
    if (kind == noise || kind == fresh_speckle) {
        const LineFilter& filter = (kind == noise ? plan_->noise : plan_->echo).bins;
        white_.resize(normals_room(filter.room(plan_->bins)));
        filter_white(filter,
                     normals({key, ping_.ping, cell, kind}, 0, filter.before() + plan_->bins, white_.data()),
                     out);
    } else {
        fill_from_layers(view, key, kind, cell, out);
    }
}

/// From the white numbers that begin at `at`.
void BeamChain::filter_white(const LineFilter& filter, std::size_t at, std::vector<float>& out) {
    const auto white = std::span(white_).subspan(at, filter.room(plan_->bins));
    if (filter.is_identity())
        std::copy_n(white.begin(), plan_->bins, out.begin());
    else
        filter.apply(white, plan_->bins, out.data(), scratch_);
}

/// From white numbers at ranges fixed to the world, between two layers of them.
void BeamChain::fill_from_layers(const ScattererView& sonar, std::uint64_t key, Kind kind, std::uint32_t cell,
                                 std::vector<float>& out) {
    const CellView view = sonar.of(cell, cell * plan_->grid.cell_width());
    const double place = (plan_->first_range + view.shift) / plan_->bin_length;
    const double whole = std::floor(place), share = place - whole, rest = 1 - share;
    const LineFilter filter = plan_->echo.bins.moved(static_cast<float>(share));
    const auto first = static_cast<std::int64_t>(whole) - static_cast<std::int64_t>(filter.before());
    const auto layer = [&](std::uint64_t number) {
        return RandomStream{key, mix(sonar.key(), number), cell, kind};
    };
    // What lies between two bins keeps its variance.
    const double scale =
        1 / std::sqrt(rest * rest + share * share + 2 * rest * share * plan_->echo.neighbours);
    white_.resize(normals_room(filter.room(plan_->bins)));
    const std::size_t at =
        mixed_normals({layer(view.layer), layer(view.layer + 1)},
                      {static_cast<float>(scale * view.weight), static_cast<float>(scale * view.next_weight)},
                      first, filter.before() + plan_->bins + filter.after(), white_.data());
    filter_white(filter, at, out);
}

/// Of the speckle of the beam under way, at whose place `cell` is. The field stays where it is for as long.
const float* BeamChain::speckle_beside(std::uint32_t cell, int step) {
    const float*& field = beside_[static_cast<std::size_t>(step + static_cast<int>(kept / 2))];
    if (field == nullptr) field = field_of(speckle, plan_->grid.beside(cell, step));
    return field;
}

/// What a beam hears at a place of the cells.
BeamChain::HeardCells BeamChain::cells_at(Kind kind, double place) {
    const BeamKernel& kernel = (kind == noise ? plan_->noise : plan_->echo).kernel;
    const double whole = std::floor(place);
    const auto cell = static_cast<std::uint32_t>(whole);
    const int cells = kernel.cells();
    HeardCells out;
    double weights[HeardCells::most], energy = 0;
    for (int step = 1 - cells; step <= cells; ++step) {
        const double weight = kernel.weight(place - whole - step);
        if (weight == 0) continue;
        out.fields[out.count] =
            kind == speckle ? speckle_beside(cell, step) : field_of(kind, plan_->grid.beside(cell, step));
        weights[out.count++] = weight;
        energy += weight * weight;
    }
    for (std::size_t i = 0; i < out.count; ++i)
        out.weights[i] = static_cast<float>(weights[i] / std::sqrt(energy));
    return out;
}

/// Into fields_[kind].heard.
void BeamChain::hear(Kind kind, const HeardCells& cells, Part part) {
    std::array<const float*, HeardCells::most> fields;
    for (std::size_t i = 0; i < cells.count; ++i) fields[i] = cells.fields[i] + part.first;
    kernels::weighted_sum(fields.data(), cells.weights.data(), cells.count, part.count,
                          &fields_[kind].heard[part.first]);
}

/// The same for speckle, where each bin is heard beside the beam's axis: by as many cells as places_ says.
void BeamChain::hear_leaning(double place, Part part) {
    const BeamKernel& kernel = plan_->echo.kernel;
    const double whole = std::floor(place);
    float* out = &fields_[speckle].heard[part.first];
    const auto [first, last] = kernels::shift(static_cast<float>(place - whole), part.count, places_.data());
    const auto per_reach = static_cast<float>(1 / (kernel.reach * kernel.reach));
    std::array<const float*, kept> fields;
    constexpr int most = kept / 2;
    const int nearest = std::max(first + 1 - kernel.cells(), -most),
              farthest = std::clamp(last + kernel.cells(), nearest, most - 1);
    std::size_t count = 0;
    for (int step = nearest; step <= farthest; ++step)
        fields[count++] = speckle_beside(static_cast<std::uint32_t>(whole), step) + part.first;
    kernels::hear_cells(
        {fields.data(), count, nearest, kernel.cells(), per_reach, static_cast<float>(kernel.middle)},
        places_.data(), part.count, energies_.data(), out);
}

const float* BeamChain::speckle_of(std::size_t beam, double place) {
    beside_.fill(nullptr);
    const HeardCells on_axis = cells_at(speckle, place);
    if (!plan_->leans()) {
        hear(speckle, on_axis, {0, plan_->bins});
        return fields_[speckle].heard.data();
    }
    const auto least = static_cast<float>(plan_->noise_power / 10);  // an echo below is not heard
    places_.resize(part_size), energies_.resize(part_size);
    plan_->lean.cut(beam, means_, least, plan_->bins, part_size, stretches_);
    for (const auto& [first, count, leans] : stretches_) {
        if (leans) {
            plan_->lean.find(beam, means_, first, std::span(places_.data(), count));
            hear_leaning(place, {first, count});
        } else {
            hear(speckle, on_axis, {first, count});
        }
    }
    return fields_[speckle].heard.data();
}

/// What floats in the water is elsewhere at every ping: the numbers of that share of the echo are new. Mostly
/// it is heard right before the array only.
void BeamChain::renew_speckle(std::size_t beam, const FreshPower& fresh, std::span<const float> means) {
    constexpr float least = 0.05F;  // of all power; what is less is not seen to stay
    spread_steps(fresh);
    std::optional<HeardCells> cells;
    for (std::size_t first = 0; first < plan_->bins; first += part_size) {
        const std::size_t count = std::min(part_size, plan_->bins - first);
        if (!kernels::is_part(&fresh_[first], &means[first], least, static_cast<float>(plan_->noise_power),
                              count))
            continue;
        if (!cells) cells = cells_at(fresh_speckle, plan_->grid.place_of(ping_.bearings[beam]));
        hear(fresh_speckle, *cells, {first, count});
        kernels::renew(&fresh_[first], &means[first], &fields_[fresh_speckle].heard[first], count,
                       &fields_[speckle].heard[first]);
    }
}

/// Noise knows no world: its cells turn with the sonar.
const float* BeamChain::noise_of(std::size_t beam) {
    if (!plan_->shares_noise) return field_of(noise, static_cast<std::uint32_t>(beam));
    hear(noise, cells_at(noise, plan_->grid.place_of(ping_.bearings[beam])), {0, plan_->bins});
    return fields_[noise].heard.data();
}

}  // namespace echoloop
