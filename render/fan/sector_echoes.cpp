#include "render/fan/sector_echoes.h"

#include "render/fan/line_sums.h"

namespace echoloop {

std::span<const BinStretch> SectorEchoes::spread(std::size_t bins, std::size_t stride, float* rows) {
    slope_.resize(sectors_.size(), 0.0F);
    return spreader_.spread_over_rows({low_.data(), high_.data(), amount_.data(), slope_.data()},
                                      sectors_.data(), sectors_.size(), bins, stride, rows);
}

void SectorEchoes::clear() {
    for (auto* numbers : {&low_, &high_, &amount_}) numbers->clear();
    sectors_.clear();
}

void SectorEchoes::deposit(LineSums& sums) {
    if (sectors_.empty()) return;
    const auto stretches = spread(sums.sector(0).size(), sums.stride(), sums.sector_values(0));
    for (std::size_t i = 0; i < stretches.size(); ++i)
        if (!stretches[i].empty())
            sums.sector(static_cast<std::size_t>(sectors_[i])).cover(stretches[i].begin, stretches[i].end);
    clear();
}

void SectorEchoes::deposit_in_steps(LineSums& sums) {
    if (sectors_.empty()) return;
    spread(sums.steps(), sums.stride(), sums.sector_steps(0) + sums.steps());
    clear();
}

}  // namespace echoloop
