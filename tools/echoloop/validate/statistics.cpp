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

double likeness(const Grid& grid, std::size_t rows, std::size_t columns) {
    const std::size_t count = grid.rows();
    std::vector<double> level(count);
    for (std::size_t i = 0; i < grid.words.size(); ++i)
        level[i / grid.columns] += grid.words[i] / static_cast<double>(grid.columns);
    std::vector<double> here, there;
    for (std::size_t row = 0; row + rows < count; ++row)
        for (std::size_t column = 0; column + columns < grid.columns; ++column) {
            const std::size_t i = row * grid.columns + column;
            here.push_back(grid.words[i] - level[row]);
            there.push_back(grid.words[i + rows * grid.columns + columns] - level[row + rows]);
        }
    return correlation(here, there);
}

}  // namespace echoloop::validation
