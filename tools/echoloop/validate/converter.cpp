// V28: converters behind the staves, whose steps become noise of a beam and no steps of it.
#include <cmath>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/statistics.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr int bits = 16;

/// A fan of 256 staves with Hamming weights whose noise is that many steps of a stave's converter.
Shot of_noise_in_steps(double steps) {
    Shot shot = fan(64, 20, 64, 2048, 60);
    shot.pulse_length = 8 * shot.bin_interval;
    shot.horizontal = {ApertureShape::hamming, 1};
    shot.receiver.bins = BinRule::sample;
    shot.receiver.staves = 256;
    shot.receiver.converter_bits = bits;
    const double of_stave = db(received_noise(shot) * effective_staves(shot));
    shot.receiver.saturation_level = of_stave - 20 * std::log10(steps) + 20 * std::log10(32767);
    return shot;
}

std::vector<double> silence(const Shot& shot, Effects effects) {
    std::vector<float> values(shot.bearings.size() * shot.bins, 0.0F);
    AcousticChain(effects).apply(shot, {}, 1500, {}, values);
    return {values.begin(), values.end()};
}

double mean_db(const std::vector<double>& values) { return db(moments(values).mean); }

}  // namespace

void check_converter(Findings& find) {
    find.source("an error that is even over a step has step^2 / 12 (Widrow & Kollar 2008)");
    for (const auto& [steps, rise] : {std::pair{1.0, 0.35}, {0.5, 1.25}}) {
        const Shot shot = of_noise_in_steps(steps);
        const std::string of = steps == 1 ? "one step" : "half a step";
        const auto stepped = silence(shot, only({Effect::pulse, Effect::noise, Effect::quantisation}));
        find.within("a beam's noise rises, of staves whose noise is " + of, "dB", rise, 0.15,
                    mean_db(stepped) - mean_db(silence(shot, only({Effect::pulse, Effect::noise}))));
        std::vector<double> amplitudes;
        for (std::size_t i = 0; i < stepped.size(); i += 16) amplitudes.push_back(std::sqrt(stepped[i]));
        const Moments moment = moments(amplitudes);
        find.within("its coefficient of variation, " + of, "", 0.523, 0.02,
                    std::sqrt(moment.variance) / moment.mean);
    }
    const Shot shot = of_noise_in_steps(1);
    Shot behind = shot;
    behind.receiver.staves = 1;
    find.source(
        "10 log of the effective number of staves, 0.73 of 256 with Hamming weights (Van Trees 2002)");
    find.within("steps of a beam below those of a stave", "dB", 22.72, 0.1,
                db(converter_step(behind) / converter_step(shot)));
    find.source("20 log (2^15 - 1)");
    find.within("saturation over a step, 16 bits", "dB", 90.3, 0.05,
                behind.receiver.saturation_level - db(converter_step(behind)));
}

}  // namespace echoloop::validation
