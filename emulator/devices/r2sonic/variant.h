// What differs between the models of the Sonic series, beside the figures of their profiles. Data only.
#pragma once

#include <array>
#include <string_view>

namespace echoloop::r2sonic_device {

struct Variant {
    std::string_view name;  ///< of the model, "r2sonic-2024"
    std::string_view title;
    std::string_view number;          ///< as H0 gives it, "2024"
    std::array<double, 3> singles{};  ///< Hz, beside the band of 200 to 400 kHz; 0: none
    double widest_sector = 0;         ///< rad
    double longest_pulse = 0;         ///< s
    bool has_thermometer = false;     ///< of the projector, in H0
};

/// Hz that the model transmits when asked for `frequency`: the nearest that it has.
double nearest_frequency(const Variant& variant, double frequency);

/// All of them, by name.
const std::array<Variant, 4>& variants();

}  // namespace echoloop::r2sonic_device
