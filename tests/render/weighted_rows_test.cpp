// Rows of bins are added to several sums as one by one, to the last bin.
#include "render/fan/weighted_rows.h"

#include <gtest/gtest.h>

#include <vector>

namespace echoloop {
namespace {

TEST(WeightedRows, AreAddedWithTheirWeightsToTheLastBin) {
    constexpr std::size_t rows = 5;
    for (const std::size_t bins : {1U, 16U, 37U}) {
        std::vector<float> values(rows * bins), gain(bins), out(3 * bins);
        std::vector<WeightedRow> list;
        for (std::size_t row = 0; row < rows; ++row) {
            const std::size_t begin = std::min(row, bins - 1), end = bins - (row == 2 ? bins / 2 : 0);
            for (std::size_t i = begin; i < end; ++i)
                values[row * bins + i] = static_cast<float>(1 + row * i);
            list.push_back({&values[row * bins],
                            FilledBins::find(&values[row * bins], begin, end, FilledBins::shift_of(bins)),
                            {1, static_cast<float>(row), 0.5F, 9}});
        }
        for (std::size_t i = 0; i < bins; ++i) gain[i] = static_cast<float>(i + 1);
        for (const float* factors :
             {static_cast<const float*>(nullptr), static_cast<const float*>(gain.data())}) {
            sum_rows(list, factors, bins, 3, out.data());
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t i = 0; i < bins; ++i) {
                    float sum = 0;
                    for (std::size_t row = 0; row < rows; ++row)
                        sum += list[row].weights[k] * values[row * bins + i];
                    EXPECT_EQ(out[k * bins + i], factors != nullptr ? sum * factors[i] : sum)
                        << "sum " << k << ", bin " << i << " of " << bins;
                }
        }
    }
}

// A row that holds something in a few bins only counts there, wherever they lie, and of however many rows.
TEST(WeightedRows, CountWhereTheyAreFilled) {
    constexpr std::size_t rows = 150, width = 5;
    for (const std::size_t bins : {40U, 200U, 564U, 1064U, 2100U}) {
        const int shift = FilledBins::shift_of(bins);
        std::vector<float> values(rows * bins), expected(bins), out(bins);
        std::vector<WeightedRow> list;
        for (std::size_t row = 0; row < rows; ++row) {
            const std::size_t begin = (row * 37 + bins - width) % (bins - width + 1);
            for (std::size_t i = begin; i < begin + width; ++i) {
                values[row * bins + i] = static_cast<float>(1 + row);
                expected[i] += static_cast<float>(2 * (1 + row));
            }
            const auto filled = FilledBins::find(&values[row * bins], 0, bins, shift);
            EXPECT_EQ(filled.bits, FilledBins::within(begin, begin + width, shift).bits);
            list.push_back({&values[row * bins], filled, {2, 0, 0, 0}});
        }
        sum_rows(list, nullptr, bins, 1, out.data());
        EXPECT_EQ(out, expected) << bins;
    }
}

}  // namespace
}  // namespace echoloop
