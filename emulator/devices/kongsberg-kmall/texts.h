// What a K-Controller tells its host of the sounder: texts "$KSSIS,number,...". Pure functions.
#pragma once

#include <optional>

#include "emulator/devices/kongsberg-kmall/settings.h"
#include "protocols/kmall/messages.h"

namespace echoloop::kongsberg_kmall {

/// What they say of the sounder's state.
struct Standing {
    bool started = false;           ///< its host has chosen it
    Address own, data;              ///< where it is, and where its datagrams go
    std::optional<double> depth{};  ///< m, of the bottom below; empty: none is found
};

/// "EM2040_40".
std::string sounder_name(const Settings& settings);

/// 12: sounders found; there is one.
kmall::Command found(const Settings& settings, const Standing& standing);
/// 455: where its datagrams go.
kmall::Command data_address(const Settings& settings, const Standing& standing);
/// 812: its #IPI, at `unix_time` s. Two words of the only one that is published are not understood, and 0
/// here.
kmall::Command unit_found(const Settings& settings, const Standing& standing, double unix_time);
/// 616: how it is.
kmall::Command status(const Settings& settings, const Standing& standing);
/// 401 or 814: what can be set.
kmall::Command values(const Settings& settings);

}  // namespace echoloop::kongsberg_kmall
