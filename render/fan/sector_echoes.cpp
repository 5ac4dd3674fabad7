#include "render/fan/sector_echoes.h"

#include "render/fan/line_sums.h"
#include "render/simd.h"

namespace echoloop {
namespace {

ECHOLOOP_SIMD
void share_out(const EchoArrays echoes, std::int32_t first, const std::int32_t* __restrict sector,
               const float* __restrict next, std::size_t count, float* __restrict low, float* __restrict high,
               float* __restrict amount, std::int32_t* __restrict sectors) {
    for (std::size_t i = 0; i < count; ++i) {
        const float later = echoes.amount[i] * next[i];
        low[i] = echoes.low[i], high[i] = echoes.high[i];
        low[i + count] = echoes.low[i], high[i + count] = echoes.high[i];
        amount[i] = echoes.amount[i] - later, amount[i + count] = later;
        sectors[i] = first + sector[i], sectors[i + count] = first + sector[i] + 1;
    }
}

}  // namespace

void SectorEchoes::add(const EchoArrays& echoes, std::size_t first, const std::int32_t* sector,
                       const float* next, std::size_t count) {
    const std::size_t before = sectors_.size(), all = before + 2 * count;
    for (auto* numbers : {&low_, &high_, &amount_}) numbers->resize(all);
    sectors_.resize(all);
    share_out(echoes, static_cast<std::int32_t>(first), sector, next, count, &low_[before], &high_[before],
              &amount_[before], &sectors_[before]);
}

void SectorEchoes::add(const EchoArrays& echoes, std::size_t count) {
    low_.insert(low_.end(), echoes.low, echoes.low + count);
    high_.insert(high_.end(), echoes.high, echoes.high + count);
    amount_.insert(amount_.end(), echoes.amount, echoes.amount + count);
    sectors_.resize(amount_.size(), 0);
}

void SectorEchoes::spread(std::size_t bins, std::size_t stride, float* rows) {
    slope_.resize(sectors_.size(), 0.0F);
    spreader_.spread_over_rows({low_.data(), high_.data(), amount_.data(), slope_.data()}, sectors_.data(),
                               sectors_.size(), bins, stride, rows);
}

void SectorEchoes::clear() {
    for (auto* numbers : {&low_, &high_, &amount_}) numbers->clear();
    sectors_.clear();
}

void SectorEchoes::deposit(LineSums& sums) {
    if (sectors_.empty()) return;
    spread(sums.sector(0).size(), sums.stride(), sums.sector_values(0));
    clear();
}

void SectorEchoes::deposit_in_steps(LineSums& sums) {
    if (sectors_.empty()) return;
    spread(sums.steps(), sums.stride(), sums.sector_steps(0) + sums.steps());
    clear();
}

}  // namespace echoloop
