#include "emulator/devices/family/tritech/aux_echosounder.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "emulator/devices/family/tritech/head_options.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::tritech {
namespace {

constexpr double bin_length = 0.01;  // m; the text has millimetres, the pulse is longer

}  // namespace

std::vector<Option> aux_rows() {
    return {
        flag_row("aux_echosounder", false,
                 "an echosounder on the AUX port, looking down; its depth comes as mtAuxData between lines",
                 specification),
        number_row("aux_period", "s", 1, 0.05, 60, "from one ping of the echosounder to the next",
                   "own choice"),
        number_row("aux_range", "m", 30, 1, 300, "of the echosounder; while it listens, no line is under way",
                   "own choice"),
        number_row("aux_sound_speed", "m/s", 1500, 1300, 1700, "that the echosounder reckons with",
                   "usual setting"),
    };
}

std::vector<FigureRow> aux_figures() {
    return {
        {"aux_frequency", "Hz", "of the echosounder on the AUX port", 10e3, 10e6},
        {"aux_pulse_length", "s", "of the echosounder on the AUX port", 1e-6, 1e-2},
        {"aux_beam_width", "deg", "of the echosounder on the AUX port, -3 dB full width of its cone, two-way",
         0.5, 60},
        {"aux_source_level", "dB re 1 uPa at 1 m", "of the echosounder on the AUX port", 100, 240},
        {"aux_directivity_index", "dB", "of the echosounder on the AUX port", 0, 60},
        {"aux_blanking", "m", "of the echosounder on the AUX port; nothing nearer counts", 0, 10},
    };
}

AuxSettings read_aux(const DeviceConfig& config) {
    const Profile& p = config.profile;
    AuxSettings s;
    s.connected = flag(config.options, "aux_echosounder");
    s.period = number(config.options, "aux_period");
    s.range = number(config.options, "aux_range");
    s.sound_speed = number(config.options, "aux_sound_speed");
    s.frequency = figure(p, "aux_frequency");
    s.pulse_length = figure(p, "aux_pulse_length");
    s.beam_width = deg_to_rad(figure(p, "aux_beam_width"));
    s.source_level = figure(p, "aux_source_level");
    s.directivity_index = figure(p, "aux_directivity_index");
    s.bottom.blanking = 2 * figure(p, "aux_blanking") / s.sound_speed;
    s.receiver = receiver(p);
    return s;
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
