// What the commands of record 7500 do to the settings of a 7k sonar. Pure functions; no subscriptions.
#pragma once

#include <optional>
#include <string>

#include "emulator/devices/reson-7k/settings.h"
#include "protocols/reson7k/messages.h"

namespace echoloop::reson7k_device {

using Refusal = std::optional<reson7k::ErrorCode>;  ///< nothing: taken

namespace command {
inline constexpr std::uint32_t range = 1003, max_rate = 1004, power = 1005, pulse = 1006, pulse_type = 1007,
                               gain = 1008, detection_mask = 1009, detection_filter = 1010, frequency = 1026,
                               request = 1050, subscribe = 1051, end_all = 1052, add_receiver = 1053,
                               delete_receiver = 1054, subscribe_range = 1055, unsubscribe = 1056,
                               start = 1100, stop = 1101, water_column = 7042, sound_speed = 7610;
}  // namespace command

/// Applies a command that changes settings; a refused one leaves them alone. `unknown_command` for others.
Refusal apply(const reson7k::RemoteControl& command, const Acoustics& limits, Controls& controls);

/// Takes a record that sets the time-varied gain; false for another one, and for one out of bounds.
bool apply_record(const reson7k::Message& message, Controls& controls);

/// The u32 at an offset of the parameters, or nothing beyond their end.
std::optional<std::uint32_t> word_at(const reson7k::RemoteControl& command, std::size_t offset);

}  // namespace echoloop::reson7k_device
