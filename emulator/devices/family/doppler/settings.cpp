#include "emulator/devices/family/doppler/settings.h"

namespace echoloop::doppler {

void describe(Noise& n, OptionList& o) {
    o.number(n.floor, "noise", "m/s", 0, 1, "of a beam's velocity at rest and near the bottom",
             "own estimate by published samples (figures of merit 1.6e-4 to 2e-3)");
    o.number(n.by_altitude, "noise_by_altitude", "m/s per m", 0, 0.1, "more of it with altitude",
             "own estimate");
    o.number(n.by_speed, "noise_by_speed", "", 0, 0.1, "more of it with speed", "own estimate");
    o.number(n.bias, "bias", "m/s", 0, 0.1, "of a beam's velocity, which drifts within minutes",
             "maximilian-nitsch/DVL-Simulator, fitted to real A50 data");
}

void describe(Acoustics& a, FigureList& f, std::string_view reads) {
    f.number(a.frequency, "frequency", "Hz", 100e3, 2e6, "of the pulses");
    f.number(a.shortest_pulse, "shortest_pulse", "s", 1e-6, 1e-2, "in the mode of the lowest altitudes");
    f.number(a.longest_pulse, "longest_pulse", "s", 1e-6, 1e-2, "in the mode of the highest");
    f.number(a.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 240, "of each transducer");
    f.degrees(a.tilt, "tilt", 5, 45, "of each beam, from straight down");
    f.degrees(a.beam_width, "beam_width", 0.5, 20, "of each beam, -3 dB full width, two-way");
    f.number(a.lowest_altitude, "lowest_altitude", "m", 0.01, 5, "at which it has bottom lock");
    f.number(a.highest_altitude, "highest_altitude", "m", 20, 300, "at which it looks for the bottom");
    f.number(a.fastest, "fastest", "m/s", 0.5, 20, "velocity that it can measure");
    f.number(a.detection, "detection_level", "dB", 0, 60, "above the noise that an echo must have");
    f.number(a.reference_level, "reference_level", "dB re 1 uPa", 0, 300, reads);
    f.common(a.horizontal, a.vertical, a.receiver);
}

}  // namespace echoloop::doppler
