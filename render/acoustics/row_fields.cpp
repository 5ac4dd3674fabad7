#include "render/acoustics/row_fields.h"

#include <algorithm>
#include <utility>

namespace echoloop {

void RowFields::keep_from(std::uint32_t row) {
    std::erase_if(rows_, [&](Row& old) {
        if (old.number >= row) return false;
        for (auto& [cell, field] : old.of_cells) {
            field.clear();
            spare_.push_back(std::move(field));
        }
        return true;
    });
}

std::vector<float>& RowFields::of(std::uint32_t row, std::uint32_t cell) {
    auto at = std::ranges::find(rows_, row, &Row::number);
    if (at == rows_.end()) at = rows_.insert(at, Row{row, {}});
    const auto [field, is_new] = at->of_cells.try_emplace(cell);
    if (is_new && !spare_.empty()) {
        field->second = std::move(spare_.back());
        spare_.pop_back();
    }
    return field->second;
}

}  // namespace echoloop
