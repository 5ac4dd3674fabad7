// The date and time that a controller sets. Pure function; reads no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace echoloop::aris_device {

/// s since 1970 of "2014-Jan-31 23:58:15" or "2014-Jan-5 23:58:15"; nothing if it is neither, or no date.
std::optional<std::int64_t> read_date_time(std::string text);

}  // namespace echoloop::aris_device
