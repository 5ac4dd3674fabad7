// The speckle of one beam: cells of it, and what a beam between them hears.
#include <algorithm>

#include "render/acoustics/beam_chain.h"
#include "render/acoustics/chain_kernels.h"

namespace echoloop {

/// Neighbouring beams share cells: the last ones are kept.
const BeamChain::Field& BeamChain::field_of(std::uint32_t cell) {
    Field* oldest = &fields_[0];
    for (Field& field : fields_) {
        if (field.cell == cell) {
            field.used = ++uses_;
            return field;
        }
        if (field.used < oldest->used) oldest = &field;
    }
    Field& field = *oldest;
    make_room(field);
    field.cell = cell;
    field.used = ++uses_;
    if (plan_->fine) {
        fill_field(plan_->field, view_stream(cell, speckle), field);
    } else {
        mean_of_looks(view_stream(cell, speckle), plan_->looks, plan_->bins, field.real.data());
        if (plan_->grid.blends() || plan_->leans())
            random_cosines(view_stream(cell, speckle_blend), plan_->bins, field.imaginary.data());
    }
    return field;
}

const BeamChain::Field& BeamChain::speckle_of(std::size_t beam, const AngularCells& cells,
                                              std::span<const float> means) {
    const std::size_t tile = plan_->leans() ? random_tile : plan_->bins;
    const auto least = static_cast<float>(plan_->noise_power / 10);  // an echo below is not heard
    places_.resize(tile);
    for (std::size_t first = 0; first < plan_->bins; first += tile) {
        const Part part{cells, first, std::min(tile, plan_->bins - first)};
        const std::span places(places_.data(), part.count);
        const bool leans = plan_->leans() && plan_->lean.find(beam, means, least, first, places);
        if (leans && plan_->fine)
            blend_leaning(part, places.data());
        else if (leans)
            interfere_leaning(part, places.data());
        else if (cells.second_weight == 0 && tile == plan_->bins)
            return field_of(cells.first);
        else if (plan_->fine)
            blend(part);
        else
            interfere(part);
    }
    return speckle_;
}

void BeamChain::blend(const Part& part) {
    const AngularCells& cells = part.cells;
    const Field& a = field_of(cells.first);
    const Field& b = cells.second_weight == 0 ? a : field_of(cells.second);
    const float w = cells.first_weight, v = cells.second_weight;
    const std::size_t at = part.first, n = part.count;
    kernels::blend(w, &a.real[at], v, &b.real[at], n, &speckle_.real[at]);
    kernels::blend(w, &a.imaginary[at], v, &b.imaginary[at], n, &speckle_.imaginary[at]);
}

/// `places`: cells beside the beam's axis, overwritten.
void BeamChain::blend_leaning(const Part& part, float* places) {
    const std::size_t at = part.first, n = part.count;
    std::fill_n(&speckle_.real[at], n, 0.0F);
    std::fill_n(&speckle_.imaginary[at], n, 0.0F);
    const auto [first, last] = kernels::shift(part.cells.place, n, places);
    for (int cell = first; cell <= last + 1; ++cell) {
        const Field& field = field_of(plan_->grid.beside(part.cells.first, cell));
        kernels::add_cell(places, static_cast<float>(cell), &field.real[at], n, &speckle_.real[at]);
        kernels::add_cell(places, static_cast<float>(cell), &field.imaginary[at], n, &speckle_.imaginary[at]);
    }
    kernels::even_out(places, n, &speckle_.real[at], &speckle_.imaginary[at]);
}

void BeamChain::interfere(const Part& part) {
    const AngularCells& cells = part.cells;
    const Field& a = field_of(cells.first);
    const std::size_t at = part.first;
    std::copy_n(&a.real[at], part.count, &speckle_.real[at]);
    if (cells.second_weight == 0) return;
    const float w = cells.first_weight, v = cells.second_weight;
    kernels::interfere(w * w, &speckle_.real[at], v * v, &field_of(cells.second).real[at], &a.imaginary[at],
                       static_cast<float>(plan_->looks), part.count);
}

/// `places`: cells beside the beam's axis, overwritten.
void BeamChain::interfere_leaning(const Part& part, float* places) {
    const std::size_t at = part.first, n = part.count;
    const auto [first, last] = kernels::shift(part.cells.place, n, places);
    for (int cell = first; cell <= last; ++cell) {
        const Field& a = field_of(plan_->grid.beside(part.cells.first, cell));
        const Field& b = field_of(plan_->grid.beside(part.cells.first, cell + 1));
        kernels::interfere_between(places, static_cast<float>(cell), &a.real[at], &b.real[at],
                                   &a.imaginary[at], static_cast<float>(plan_->looks), n, &speckle_.real[at]);
    }
}

}  // namespace echoloop
