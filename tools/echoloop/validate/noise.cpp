// V9: the noise of the water and the receiver, before and after the device's gain.
#include <cmath>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/micron_receiver.h"
#include "tools/echoloop/validate/statistics.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

/// A ping of one beam by a receiver of 30 dB directivity and a band of 10 kHz.
Shot narrow_band(double self_noise, std::uint64_t ping = 0) {
    Shot shot = fan(3, 30, 1, 16384, 30);
    shot.ping = ping;
    shot.receiver.bandwidth = 10e3;
    shot.receiver.directivity_index = 30;
    shot.receiver.self_noise = self_noise;
    return shot;
}

/// The same, with a matched filter.
Shot chirp() {
    Shot shot = narrow_band(-std::numeric_limits<double>::infinity());
    shot.receiver.bandwidth = 0;
    shot.pulse_length = 1e-3;
    shot.bandwidth = 100e3;
    return shot;
}

/// The same with a band so wide that the window holds thousands of independent values.
Shot wide_band() {
    Shot shot = narrow_band(-std::numeric_limits<double>::infinity());
    shot.receiver.bandwidth = 100e3;
    return shot;
}

/// What is heard of nothing.
Echogram silence(const Shot& shot) {
    Echogram e;
    e.shot = shot;
    e.sound_speed = 1500;
    e.values.resize(e.shot.bins);
    e.noise_power = AcousticChain(only({Effect::pulse, Effect::noise})).apply(e.shot, {}, 1500, {}, e.values);
    return e;
}

/// dB, mean over a window's bins and so many pings that a band as narrow as the pulse's has 8,000 independent
/// values.
double mean_of_silence(Shot shot) {
    constexpr int pings = 20;
    double sum = 0;
    for (int ping = 0; ping < pings; ++ping, ++shot.ping)
        sum += total(silence(shot).values) / static_cast<double>(shot.bins) / pings;
    return db(sum);
}

double likeness(const Echogram& a, const Echogram& b) {
    return correlation(std::vector<double>(a.values.begin(), a.values.end()),
                       std::vector<double>(b.values.begin(), b.values.end()));
}

/// dB per decade of range of what the Micron shows, from 2 m on.
double growth(const Echogram& e, double spreading) {
    const auto shown = shown_by_micron(e, spreading, 0, 45 - (40 - spreading) * 0.5);
    std::vector<std::pair<double, double>> points;
    for (std::size_t bin = 0; bin < e.shot.bins; ++bin)
        if (e.bin_range(bin) > 2) points.emplace_back(std::log10(e.bin_range(bin)), shown[bin]);
    return slope(points);
}

}  // namespace

void check_noise(Findings& find) {
    find.source("Mellen 1952: -15 + 20 log10 f[kHz]");
    find.within("thermal noise at 750 kHz", "dB re uPa^2/Hz", 42.5, 0.05, thermal_noise_level(750e3));
    const double none = -std::numeric_limits<double>::infinity();
    const Echogram e = silence(narrow_band(none));
    find.source("NL + 10 log B - DI, B 10 kHz, DI 30 dB");
    find.within("mean of what is heard of nothing", "dB", 52.5, 0.2, mean_of_silence(narrow_band(none)));
    find.within("mean that the echogram declares", "dB", 52.5, 0.1, db(e.noise_power));
    find.source("isotropic, like the thermal: equal powers add to 3.01 dB more");
    find.within("self noise as loud as the thermal", "dB", 55.51, 0.2, mean_of_silence(narrow_band(42.5)));
    find.source("a filter matched to a chirp of 1 ms lets through 1 kHz of noise: NL + 10 log 1 / T - DI");
    find.within("noise of a chirp of 100 kHz over 1 ms", "dB", 42.5, 0.2, mean_of_silence(chirp()));
    find.source("every ping has its own noise", Kind::property);
    find.at_most("correlation of the noise of two pings", "", 0.05,
                 std::abs(likeness(e, silence(narrow_band(none, 1)))));
    find.source("the gain acts on noise as on echoes", Kind::property);
    find.within("growth of the shown noise over range, gain constant", "dB/decade", 0, 0.6,
                growth(silence(wide_band()), 0));
    find.within("growth of the shown noise over range, gain 40 log R", "dB/decade", 40, 0.6,
                growth(silence(wide_band()), 40));
}

}  // namespace echoloop::validation
