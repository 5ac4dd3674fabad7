// The acoustic figures of a sonar, each with its source, and typed access to them. Data only; reads no file.
#pragma once

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "render/echogram.h"

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

/// Rows that all models have: apertures and receiver. Names begin with the axis: horizontal or vertical.
inline std::vector<FigureRow> common_figures() {
    const std::vector<std::string> shapes{"line", "hamming", "piston"};
    return {
        {"horizontal_aperture", "", "shape of the aperture across a beam", 0, 0, false, shapes},
        {"horizontal_ways", "", "2: the same aperture sends and hears; 1: only one is directive", 1, 2, true},
        {"vertical_aperture", "", "shape of the aperture across the fan", 0, 0, false, shapes},
        {"vertical_ways", "", "2: the same aperture sends and hears; 1: only one is directive", 1, 2, true},
        {"directivity_index", "dB", "of the receiver against isotropic noise", 0, 60},
        {"self_noise", "dB re 1 uPa^2/Hz", "of the receiver, beside the thermal noise of the water", -100,
         200},
        {"saturation_level", "dB re 1 uPa", "at the receiver, where its input clips", 50, 300},
        {"converter_bits", "", "of the amplitude up to saturation; 0: no steps", 0, 32, true},
    };
}

/// `axis`: "horizontal" or "vertical".
inline AxisPattern axis_pattern(const Profile& profile, const std::string& axis) {
    const auto& shape = figure_of<std::string>(profile, axis + "_aperture");
    return {shape == "line"      ? ApertureShape::line
            : shape == "hamming" ? ApertureShape::hamming
                                 : ApertureShape::piston,
            static_cast<int>(std::lround(figure(profile, axis + "_ways")))};
}

/// Its bandwidth is left to the pulse.
inline Receiver receiver(const Profile& profile) {
    Receiver r;
    r.directivity_index = figure(profile, "directivity_index");
    r.self_noise = figure(profile, "self_noise");
    r.saturation_level = figure(profile, "saturation_level");
    r.converter_bits = static_cast<int>(std::lround(figure(profile, "converter_bits")));
    return r;
}

}  // namespace echoloop
