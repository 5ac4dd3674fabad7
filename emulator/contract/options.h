// Typed access to the options of a device. The scenario loader has checked them against the model's table
// before.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "emulator/contract/model.h"

namespace echoloop {

/// The value of an option; std::invalid_argument if the table of the model has no such option of this type.
template <class T>
const T& option(const Options& options, std::string_view name) {
    const auto found = options.find(name);
    if (found == options.end() || !std::holds_alternative<T>(found->second))
        throw std::invalid_argument("option '" + std::string(name) + "' is missing or has another type");
    return std::get<T>(found->second);
}

inline bool flag(const Options& options, std::string_view name) { return option<bool>(options, name); }
inline double number(const Options& options, std::string_view name) { return option<double>(options, name); }
inline std::int64_t integer(const Options& options, std::string_view name) {
    return option<std::int64_t>(options, name);
}
inline const std::string& text(const Options& options, std::string_view name) {
    return option<std::string>(options, name);
}

/// All options of a model at their defaults.
inline Options default_options(const Model& model) {
    Options options;
    for (const Option& o : model.options) options.emplace(o.name, o.default_value);
    return options;
}

}  // namespace echoloop
