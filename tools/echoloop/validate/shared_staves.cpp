// V27: beams that share staves share noise and speckle.
#include <cmath>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/statistics.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr std::size_t stave_beams = 96, stave_bins = 4000;

/// Beams a quarter of a width apart, in bins of one look as long as the pulse.
Shot close_beams(ApertureShape shape) {
    Shot shot = fan(24, 20, stave_beams, stave_bins, 400);
    shot.beam_width = deg_to_rad(1);
    shot.horizontal = {shape, 1};
    shot.receiver.bins = BinRule::sample;
    return shot;
}

std::vector<double> heard_by(const Shot& shot, Effects effects, float power) {
    std::vector<float> values(stave_beams * stave_bins, power);
    AcousticChain(effects).apply(shot, {}, 1500, {}, values);
    return {values.begin(), values.end()};
}

double between_beams(const std::vector<double>& values, std::size_t step) {
    const std::span<const double> all(values);
    double sum = 0;
    for (std::size_t i = 0; i + step < stave_beams; ++i)
        sum += correlation(all.subspan(i * stave_bins, stave_bins),
                           all.subspan((i + step) * stave_bins, stave_bins)) /
               static_cast<double>(stave_beams - step);
    return sum;
}

}  // namespace

void check_shared_staves(Findings& find) {
    struct SpacingRow {
        std::size_t quarters;
        double plain, hamming;
        const char* name;
    };
    constexpr SpacingRow rows[] = {{1, 0.849, 0.907, "0.25"},
                                   {2, 0.501, 0.675, "0.5"},
                                   {3, 0.175, 0.410, "0.75"},
                                   {4, 0.016, 0.200, "1"}};
    find.source("|r|^2, r = sum w^2 e^(i k x D) / sum w^2 (Van Trees 2002)");
    for (const bool shaded : {false, true}) {
        const Shot shot = close_beams(shaded ? ApertureShape::hamming : ApertureShape::line);
        const auto of_speckle = heard_by(shot, only({Effect::pulse, Effect::speckle}), 1);
        const auto of_noise = heard_by(shot, only({Effect::pulse, Effect::noise}), 0);
        for (const SpacingRow& row : rows) {
            const std::string of = std::string(" of beams ") + row.name + " widths apart, " +
                                   (shaded ? "Hamming" : "plain line");
            const double published = shaded ? row.hamming : row.plain;
            find.within("speckle" + of, "", published, 0.03, between_beams(of_speckle, row.quarters));
            find.within("noise" + of, "", published, 0.03, between_beams(of_noise, row.quarters));
        }
    }
}

}  // namespace echoloop::validation
