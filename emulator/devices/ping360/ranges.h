// What a Ping360 takes. Pure functions.
#pragma once

#include <optional>
#include <string_view>

#include "protocols/ping/messages.h"

namespace echoloop::ping360 {

/// The sentence of a nack if a value lies outside the documented ranges; angle 400 is taken for 0.
std::optional<std::string_view> out_of_range(const ping::Transducer& command);
std::optional<std::string_view> out_of_range(const ping::AutoTransmit& command);

}  // namespace echoloop::ping360
