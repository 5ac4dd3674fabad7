// V29: the floor of side lobes of arrays whose staves differ.
#include "render/acoustics/stave_errors.h"

#include <cmath>
#include <cstdio>

#include "tools/echoloop/validate/groups.h"

namespace echoloop::validation {
namespace {

/// dB re the main lobe, one way: the mean of 200 units beyond ten beam widths, without the ideal side lobes.
double stave_floor(std::size_t staves, double amplitude_db, double phase_deg) {
    constexpr int units = 200, angles = 1000;
    const auto ideal = AperturePattern::of_length(ApertureShape::hamming, static_cast<double>(staves) / 2);
    const double first = 12 / ideal.length_in_wavelengths();
    double sum = 0;
    for (int unit = 1; unit <= units; ++unit) {
        const StaveErrors array(ideal, staves,
                                {amplitude_db, deg_to_rad(phase_deg), static_cast<std::uint64_t>(unit)}, 0);
        for (int i = 0; i < angles; ++i) {
            const double angle = std::asin(first + (0.98 - first) * (i + 0.5) / angles);
            sum += array.power(angle) - std::pow(ideal.amplitude(angle), 2);
        }
    }
    return 10 * std::log10(sum / units / angles);
}

}  // namespace

void check_stave_errors(Findings& f) {
    struct Row {
        double amplitude_db, phase_deg, of_64, of_256;
    };
    f.begin("V29");
    f.source("(sa^2 + sp^2) / N_eff, Steinberg 1976, chapter 13; Van Trees 2002, section 2.6.3");
    for (const Row& row : {Row{0.5, 5, -36.3, -42.3}, {0.75, 7.5, -32.8, -38.8}, {1, 10, -30.3, -36.3}})
        for (const std::size_t staves : {64U, 256U}) {
            char name[80];
            std::snprintf(name, sizeof name, "mean floor, Hamming %zu, %g dB and %g deg", staves,
                          row.amplitude_db, row.phase_deg);
            f.within(name, "dB", staves == 64 ? row.of_64 : row.of_256, 1,
                     stave_floor(staves, row.amplitude_db, row.phase_deg));
        }
}

}  // namespace echoloop::validation
