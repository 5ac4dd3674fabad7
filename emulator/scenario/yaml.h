// YAML text to Values, within limits that hostile text cannot exceed. The only user of yaml-cpp.
#pragma once

#include <cstddef>
#include <string>

#include "emulator/scenario/value.h"

namespace echoloop::scenario {

/// What one document may cost. Values reached through aliases are copied and count every time.
struct YamlLimits {
    std::size_t values = 20'000;
    std::size_t text = std::size_t{4} << 20;
    std::size_t depth = 64;
};

/// The text is not YAML, or more than the limits allow; `place` says where.
struct YamlError {
    Place place;
    std::string message;
};

/// One document. Throws YamlError. An empty document is a null Value.
Value parse_yaml(const std::string& text, const YamlLimits& limits = {});

}  // namespace echoloop::scenario
