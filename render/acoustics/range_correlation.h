// How echoes and noise correlate with themselves over range, and filters that make white numbers do so. Pure
// functions.
#pragma once

#include "render/acoustics/bin_law.h"
#include "render/acoustics/line_filter.h"
#include "render/acoustics/pulse.h"

namespace echoloop {

/// Of the echo's intensity, of a shot with a pulse: (1 - x / d)^2 for a CW pulse of length d; the square of
/// the spectrum's transform for a compressed chirp; what the receiver's bandwidth leaves of it where that is
/// narrower.
RangeCorrelation echo_correlation(const Shot& shot, double sound_speed);

/// Of the noise's: that of the filter matched to the pulse, or sinc^2(2 B x / c) where the receiver has a
/// bandwidth of its own.
RangeCorrelation noise_correlation(const Shot& shot, double sound_speed);

/// Correlation of normal variables whose values by a law of so many looks correlate by `intensity` (own fit,
/// within 0.007 of sampled ones).
double normal_correlation(double intensity, double looks);

/// Of white normal numbers, one a bin, so that values by the law correlate over bins as means over the bins
/// do, or with BinRule::sample as samples do. The taps' squares add up to 1. Where more than 16 bins
/// correlate, it is a box, whose correlation falls along a straight line.
LineFilter bin_filter(const RangeCorrelation& correlation, BinRule rule, double looks, double bin_length);

/// Of white normal numbers, one a bin, so that they correlate by exp(-2 pi B t), until less than 0.02 is
/// left, as the intensity of noise behind a circuit that is tuned with -3 dB at `bandwidth` Hz; intensities
/// that are made of them correlate by up to 0.05 less (normal_correlation()).
LineFilter tuned_filter(double bandwidth, double sound_speed, double bin_length);

/// Between neighbours of what such a filter makes of white numbers.
double neighbour_correlation(const LineFilter& filter);

}  // namespace echoloop
