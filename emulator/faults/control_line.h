// One line of the control socket: what somebody asks of a run while it goes on. Reads and checks; does
// nothing. Lines come from outside: whatever they hold, the answer is a request or a reason.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "emulator/scenario/scenario.h"

namespace echoloop {

inline constexpr std::size_t longest_control_line = 4096;  // bytes

struct ControlRequest {
    enum class What {
        fault,   ///< {"fault": {"device": "micron", "kind": "loss", "rate": 0.1, "for": 2}}
        clear,   ///< {"clear": 3}, {"clear": "all"}
        list,    ///< {"list": true}
        status,  ///< {"status": true}
    };
    What what = What::list;
    Fault fault{};
    std::optional<int> id{};  ///< clear: nothing means all
};

struct ControlLine {
    std::optional<ControlRequest> request;
    std::string reason;  ///< why there is none, and the remedy
};

/// A fault without a time of its own begins at `now`.
ControlLine parse_control_line(std::string_view line, std::span<const ScenarioDevice> devices, Time now);

}  // namespace echoloop
