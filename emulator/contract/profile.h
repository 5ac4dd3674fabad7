// The acoustic figures of a sonar, each with its source, and typed access to them. Data only; reads no file.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace echoloop {

/// A figure that every profile of a model must give, and what it may be.
struct FigureRow {
    std::string name;
    std::string unit;  ///< the profile must repeat it; "" if there is none
    std::string help;
    double minimum = -1e300;             ///< inclusive
    double maximum = 1e300;              ///< inclusive
    bool whole = false;                  ///< a whole number
    std::vector<std::string> choices{};  ///< legal words; empty: a number
    /// Where it is a text with a notation of its own: throws std::invalid_argument with what is wrong and how
    /// to write it.
    void (*check)(std::string_view) = nullptr;
};

struct Figure {
    std::variant<double, std::string> value;
    std::string source;  ///< a document, or "own choice" and "own estimate" with the reason
};

/// Complete: every row of the model has a figure.
using Profile = std::map<std::string, Figure, std::less<>>;

template <class T>
const T& figure_of(const Profile& profile, std::string_view name) {
    const auto found = profile.find(name);
    if (found == profile.end() || !std::holds_alternative<T>(found->second.value))
        throw std::invalid_argument("the profile has no figure '" + std::string(name) + "' of this type");
    return std::get<T>(found->second.value);
}

/// std::invalid_argument if the profile has no such number.
inline double figure(const Profile& profile, std::string_view name) {
    return figure_of<double>(profile, name);
}

/// The text of the profile that was built into the program, config/devices/<model>.yaml; empty if there is
/// none.
std::string_view built_in_profile(std::string_view model);

}  // namespace echoloop
