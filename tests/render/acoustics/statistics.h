// What can be said of a set of echo intensities, for comparison with theory. Pure functions.
#pragma once

#include <span>
#include <vector>

namespace echoloop {

struct IntensityStatistics {
    double mean = 0;              ///< of the intensity I
    double amplitude_cv = 0;      ///< standard deviation over mean of sqrt(I); Rayleigh: 0.5227
    double scintillation = 0;     ///< var(I) / mean(I)^2; exponential: 1
    double skewness = 0;          ///< of I; exponential: 2
    double db_deviation = 0;      ///< dB, standard deviation of 10 log I; exponential: 5.57
    double db_offset = 0;         ///< dB, mean of dB less dB of mean; exponential: -2.51
    double kolmogorov = 0;        ///< largest distance from the exponential distribution of this mean
    double kolmogorov_limit = 0;  ///< 1.63 / sqrt(N): exceeded by 1 % of exponential samples
};

/// Of positive intensities, at least two.
IntensityStatistics intensity_statistics(std::span<const float> intensities);

/// Pearson's correlation of two samples of one size.
double correlation(std::span<const float> a, std::span<const float> b);

}  // namespace echoloop
