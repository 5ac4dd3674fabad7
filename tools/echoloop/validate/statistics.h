// Moments, slopes and distances of samples. Pure functions; knows no sonar.
#pragma once

#include <span>
#include <utility>
#include <vector>

namespace echoloop::validation {

struct Moments {
    double mean = 0, variance = 0, skewness = 0;
};
Moments moments(std::span<const double> samples);

/// Slope of the least-squares line through (x, y).
double slope(std::span<const std::pair<double, double>> points);

/// Pearson's; of two series of one length.
double correlation(std::span<const double> a, std::span<const double> b);

/// Kolmogorov-Smirnov distance of samples from the exponential distribution of mean 1.
double distance_from_exponential(std::vector<double> samples);

/// Root of the Jensen-Shannon divergence in bits of two histograms with classes of that width: 0 for equal
/// ones, 1 for two that share nothing. tests/hosts/words.py computes the same.
double histogram_distance(std::span<const double> a, std::span<const double> b, double width);

/// Words of several rows of one length, row by row; NaN: there is none.
struct Grid {
    std::size_t columns = 0;
    std::vector<double> words;
    std::size_t rows() const { return columns > 0 ? words.size() / columns : 0; }
};
/// Each word less the mean of those within so many rows and columns, so that a gain over range or a lit patch
/// is no likeness.
Grid texture(const Grid& grid, std::size_t reach = 10);
/// Correlation of words so many rows and columns apart, where both are there.
double likeness(const Grid& grid, std::size_t rows, std::size_t columns);

}  // namespace echoloop::validation
