#include "tools/echoloop/validate/statistics.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace echoloop::validation {

Moments moments(std::span<const double> samples) {
    const auto n = static_cast<double>(samples.size());
    Moments m;
    for (const double x : samples) m.mean += x / n;
    double third = 0;
    for (const double x : samples) {
        m.variance += (x - m.mean) * (x - m.mean) / n;
        third += std::pow(x - m.mean, 3) / n;
    }
    m.skewness = third / std::pow(m.variance, 1.5);
    return m;
}

double slope(std::span<const std::pair<double, double>> points) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const auto& [x, y] : points) ++n, sx += x, sy += y, sxx += x * x, sxy += x * y;
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

double correlation(std::span<const double> a, std::span<const double> b) {
    const Moments ma = moments(a), mb = moments(b);
    double covariance = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        covariance += (a[i] - ma.mean) * (b[i] - mb.mean) / static_cast<double>(a.size());
    return covariance / std::sqrt(ma.variance * mb.variance);
}

double distance_from_exponential(std::vector<double> samples) {
    std::sort(samples.begin(), samples.end());
    const auto n = static_cast<double>(samples.size());
    double distance = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double expected = 1 - std::exp(-samples[i]);
        distance = std::max(
            {distance, expected - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - expected});
    }
    return distance;
}

double histogram_distance(std::span<const double> a, std::span<const double> b, double width) {
    std::map<double, std::pair<double, double>> shares;
    for (const double x : a) shares[std::floor(x / width)].first += 1 / static_cast<double>(a.size());
    for (const double x : b) shares[std::floor(x / width)].second += 1 / static_cast<double>(b.size());
    double divergence = 0;
    for (const auto& [place, share] : shares)
        for (const double p : {share.first, share.second})
            if (p > 0) divergence += p * std::log2(p / ((share.first + share.second) / 2)) / 2;
    return std::sqrt(std::max(0.0, divergence));
}

Grid texture(const Grid& grid, std::size_t reach) {
    const std::size_t rows = grid.rows(), columns = grid.columns;
    struct Sum {
        double words = 0, count = 0;
    };
    std::vector<Sum> sums((rows + 1) * (columns + 1));  // of all words above and to the left
    const auto sum = [&](std::size_t row, std::size_t column) -> Sum& {
        return sums[row * (columns + 1) + column];
    };
    for (std::size_t row = 0; row < rows; ++row) {
        Sum line;
        for (std::size_t column = 0; column < columns; ++column) {
            const double word = grid.words[row * columns + column];
            if (!std::isnan(word)) line.words += word, ++line.count;
            const Sum& above = sum(row, column + 1);
            sum(row + 1, column + 1) = {above.words + line.words, above.count + line.count};
        }
    }
    Grid out{columns, std::vector<double>(grid.words.size())};
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t top = row - std::min(row, reach), end = std::min(row + reach + 1, rows);
            const std::size_t left = column - std::min(column, reach),
                              right = std::min(column + reach + 1, columns);
            const auto within = [&](double Sum::*part) {
                return sum(end, right).*part - sum(top, right).*part - sum(end, left).*part +
                       sum(top, left).*part;
            };
            const std::size_t i = row * columns + column;
            out.words[i] = grid.words[i] - within(&Sum::words) / within(&Sum::count);
        }
    return out;
}

double likeness(const Grid& grid, std::size_t rows, std::size_t columns) {
    std::vector<double> here, there;
    for (std::size_t row = 0; row + rows < grid.rows(); ++row)
        for (std::size_t column = 0; column + columns < grid.columns; ++column) {
            const double word = grid.words[row * grid.columns + column],
                         other = grid.words[(row + rows) * grid.columns + column + columns];
            if (std::isnan(word) || std::isnan(other)) continue;
            here.push_back(word);
            there.push_back(other);
        }
    return correlation(here, there);
}

}  // namespace echoloop::validation
