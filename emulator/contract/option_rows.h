// Short ways to write the rows of a model's option table. Rows only; reads no value.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "emulator/contract/model.h"

namespace echoloop {

inline Option flag_row(std::string name, bool value, std::string help, std::string source) {
    return {std::move(name), "", value, std::move(help), std::move(source), {}};
}

/// `low` and `high` are inclusive.
inline Option integer_row(std::string name, std::string unit, std::int64_t value, double low, double high,
                          std::string help, std::string source) {
    return {std::move(name), std::move(unit), value, std::move(help), std::move(source), {}, low, high};
}

/// `low` and `high` are inclusive.
inline Option number_row(std::string name, std::string unit, double value, double low, double high,
                         std::string help, std::string source) {
    return {std::move(name), std::move(unit), value, std::move(help), std::move(source), {}, low, high};
}

/// The first choice is the default.
inline Option choice_row(std::string name, std::vector<std::string> choices, std::string help,
                         std::string source) {
    std::string first = choices.front();
    return {std::move(name), "", std::move(first), std::move(help), std::move(source), std::move(choices)};
}

inline Option text_row(std::string name, std::string value, std::string help, std::string source) {
    return {std::move(name), "", std::move(value), std::move(help), std::move(source), {}};
}

}  // namespace echoloop
