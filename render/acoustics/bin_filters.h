// The pulse as filters over range bins: of power, of the speckle's field and of the noise's. Pure functions.
#pragma once

#include "render/acoustics/line_filter.h"
#include "render/acoustics/pulse.h"

namespace echoloop {

/// From power per bin for an infinitely short pulse to the mean intensity over each bin, for power that lies
/// evenly within its bin. The taps add up to pulse.length() / bin_length.
LineFilter power_filter(const PulseShape& pulse, double bin_length);

/// Of a white complex field, so that it correlates over the pulse's length; the taps' squares add up to 1.
/// For bins shorter than the pulse.
LineFilter field_filter(const PulseShape& pulse, double bin_length);

/// Of white noise that a receiver of `bandwidth` Hz lets through, in bins of `interval` s; the taps' squares
/// add up to 1.
LineFilter noise_filter(double bandwidth, double interval);

}  // namespace echoloop
