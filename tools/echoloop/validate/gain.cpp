// V10: what the receiver does to the echo: time-varied gain, clipping. Steps: converter.cpp.
#include <algorithm>
#include <cmath>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/micron_receiver.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

/// The largest difference from the mean of what the Micron shows of one target at ranges from 2 to 50 m.
double unevenness() {
    const double ranges[] = {2, 3, 5, 8, 13, 20, 30, 40, 50};
    std::vector<PointTarget> targets;
    for (const double range : ranges) targets.push_back({"target", {range, 0, 0}, -20});
    Renderer renderer(scene_of({}, targets), Water{},
                      with(only({Effect::spreading, Effect::absorption, Effect::pulse})));
    const Shot shot = pencil(52, 100e-6);
    const double absorption = absorption_db_per_km(renderer.water(), shot.frequency) / 1e3;
    const Echogram e = renderer.render(shot, {});
    const auto shown = shown_by_micron(e, 40, absorption, shot.source_level - 20 - 40);
    std::vector<double> peaks;
    for (const double range : ranges) {
        const auto from = static_cast<std::size_t>((range - 0.3) * 2 / e.sound_speed / shot.bin_interval);
        const auto begin = shown.begin() + static_cast<std::ptrdiff_t>(from);
        peaks.push_back(*std::max_element(begin, begin + 40));
    }
    const auto [low, high] = std::minmax_element(peaks.begin(), peaks.end());
    return *high<micron_full_scale&& * low> 0 ? (*high - *low) / 2 : micron_full_scale;
}

constexpr double saturation = 150;  // dB re 1 uPa

/// An echo that grows from 100 dB below saturation to 20 dB above it, through one effect of the receiver.
std::vector<float> through(Effect effect) {
    Shot shot = fan(3, 30, 1, 4800, 30);
    shot.receiver.saturation_level = saturation;
    std::vector<float> values;
    for (std::size_t i = 0; i < shot.bins; ++i)
        values.push_back(static_cast<float>(db_to_power(saturation - 100 + 0.025 * static_cast<double>(i))));
    AcousticChain(only({effect})).apply(shot, {}, 1500, {}, values);
    return values;
}

}  // namespace

void check_gain(Findings& find) {
    find.source("40 log R + 2 a R, shown by the Micron in steps of 0.31 dB");
    find.within("target of constant strength from 2 to 50 m, half its spread", "dB", 0, 0.5, unevenness());
    find.source("as the shot's receiver declares", Kind::property);
    const auto clipped = through(Effect::saturation);
    find.within("loudest level of an echo 20 dB above saturation", "dB", saturation, 0.1, db(peak(clipped)));
    find.within("level of an echo 10 dB below saturation", "dB", saturation - 10, 0.1, db(clipped[3600]));
}

}  // namespace echoloop::validation
