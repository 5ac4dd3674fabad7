// What a service manager (systemd) is told of a run, by its own protocol: sd_notify(3). Without one nothing
// happens.
#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace echoloop {

/// "READY=1", "STOPPING=1", "WATCHDOG=1": a datagram to $NOTIFY_SOCKET. What cannot be sent is lost.
void tell_service_manager(std::string_view state);

/// How often it wants to hear "WATCHDOG=1" from this process: half of $WATCHDOG_USEC.
std::optional<std::chrono::microseconds> watchdog_period();

}  // namespace echoloop
