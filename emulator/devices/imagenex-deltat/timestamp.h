// Date and time of day in the words of an 83P. Knows no clock.
#pragma once

#include "protocols/imagenex/delta_t_messages.h"

namespace echoloop::delta_t {

/// UTC of `time`, s since 1970, cut to milliseconds; `upper_month`: "NOV", else "Nov".
void put_time(imagenex::Profile83P& profile, double time, bool upper_month);

}  // namespace echoloop::delta_t
