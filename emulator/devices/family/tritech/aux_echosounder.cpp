#include "emulator/devices/family/tritech/aux_echosounder.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "emulator/devices/family/tritech/head_options.h"

namespace echoloop::tritech {
namespace {

constexpr double bin_length = 0.01;  // m; the text has millimetres, the pulse is longer

}  // namespace

void describe(AuxSettings& s, OptionList& o, FigureList& f) {
    o.flag(s.connected, "aux_echosounder",
           "an echosounder on the AUX port, looking down; its depth comes as mtAuxData between lines",
           specification);
    o.number(s.period, "aux_period", "s", 0.05, 60, "from one ping of the echosounder to the next",
             "own choice");
    o.number(s.range, "aux_range", "m", 1, 300, "of the echosounder; while it listens, no line is under way",
             "own choice");
    o.number(s.sound_speed, "aux_sound_speed", "m/s", 1300, 1700, "that the echosounder assumes",
             "usual setting");
    f.number(s.frequency, "aux_frequency", "Hz", 10e3, 10e6, "of the echosounder on the AUX port");
    f.number(s.pulse_length, "aux_pulse_length", "s", 1e-6, 1e-2, "of the echosounder on the AUX port");
    f.degrees(s.beam_width, "aux_beam_width", 0.5, 60,
              "of the echosounder on the AUX port, -3 dB full width of its cone, two-way");
    f.number(s.source_level, "aux_source_level", "dB re 1 uPa at 1 m", 100, 240,
             "of the echosounder on the AUX port");
    f.number(s.directivity_index, "aux_directivity_index", "dB", 0, 60, "of the echosounder on the AUX port");
    double blanking = 0;
    f.number(blanking, "aux_blanking", "m", 0, 10,
             "of the echosounder on the AUX port; nothing nearer counts");
    s.bottom.blanking = 2 * blanking / s.sound_speed;
}

double aux_window(const AuxSettings& settings) { return 2 * settings.range / settings.sound_speed; }

Shot aux_shot(const AuxSettings& settings) {
    Shot shot;
    shot.tilt = -std::numbers::pi / 2;
    shot.bearings = {0.0};
    shot.beam_width = shot.fan_height = settings.beam_width;
    shot.horizontal = shot.vertical = {ApertureShape::piston, 2};
    shot.bins = static_cast<std::size_t>(std::ceil(settings.range / bin_length));
    shot.bin_interval = aux_window(settings) / static_cast<double>(shot.bins);
    shot.frequency = settings.frequency;
    shot.pulse_length = settings.pulse_length;
    shot.source_level = settings.source_level;
    shot.receiver = settings.receiver;
    shot.receiver.directivity_index = settings.directivity_index;
    // The head's receiver is another.
    shot.receiver.bins = BinRule::mean;
    shot.receiver.ring_down = nullptr;
    shot.receiver.interference = nullptr;
    return shot;
}

std::optional<std::string> aux_text(const Echogram& echogram, const AuxSettings& settings) {
    const auto bottom = echosounder::find_bottom(echogram, settings.bottom);
    if (!bottom) return std::nullopt;
    const double time = echosounder::bin_time(echogram.shot, static_cast<double>(bottom->bin));
    char text[32];
    std::snprintf(text, sizeof text, "%04ldmm", std::lround(1e3 * time * settings.sound_speed / 2));
    return std::string(text);
}

}  // namespace echoloop::tritech
