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

}  // namespace echoloop::validation
