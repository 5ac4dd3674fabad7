#include "render/acoustics/pattern_table.h"

namespace echoloop {

PatternTable::PatternTable(const AperturePattern& aperture)
    : per_sine_(static_cast<double>(pattern_values(aperture.length_in_wavelengths()))) {
    const auto count = static_cast<std::size_t>(per_sine_);
    for (std::size_t i = 0; i <= count; ++i)
        values_.push_back(static_cast<float>(aperture.at_sine(static_cast<double>(i) / per_sine_)));
    values_.push_back(values_.back());
}

}  // namespace echoloop
