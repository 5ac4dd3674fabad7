// The pulse as a filter of power over range bins. Pure functions.
#pragma once

#include "render/acoustics/line_filter.h"
#include "render/acoustics/pulse.h"

namespace echoloop {

/// From power per bin for an infinitely short pulse to the mean intensity over each bin, for power that lies
/// evenly within its bin. The taps add up to pulse.length() / bin_length.
LineFilter power_filter(const PulseShape& pulse, double bin_length);

}  // namespace echoloop
