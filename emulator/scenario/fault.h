// One fault as it was asked for: what, where, and when. Knows whether it is on at a time; makes nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "emulator/scenario/fault_kinds.h"

namespace echoloop {

/// Of bytes, as the driver sees them.
enum class Towards { to_driver, from_driver, both };
std::string_view name_of(Towards direction);

struct Fault {
    std::string device;
    FaultKind kind = FaultKind::loss;
    std::string port;  ///< name of one port of the device; "": all
    Towards direction = Towards::to_driver;
    Options parameters;         ///< complete
    Time from{};                ///< run time at which it begins
    Time length = Time::max();  ///< how long it lasts
    Time every{};               ///< from the beginning of one time to that of the next; 0: once

    bool at(Towards wanted) const { return direction == Towards::both || direction == wanted; }
    /// The end of the time that holds `now`; nothing if it is off.
    std::optional<Time> on_until(Time now) const;
    /// When it begins or ends next, later than `now`; nothing if never.
    std::optional<Time> next_change(Time now) const;
};

}  // namespace echoloop
