// An echosounder daisy-chained to a head's AUX port: what it hears below, as the ASCII that mtAuxData
// carries. It shares the water with the head, so its pings stand between the head's lines.
#pragma once

#include <optional>
#include <string>

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/sounder/bottom.h"

namespace echoloop::tritech {

struct AuxSettings {
    bool connected = false;
    double period = 1;          ///< s between two of its pings
    double range = 30;          ///< m
    double sound_speed = 1500;  ///< m/s, that it reckons with
    double frequency = 0, pulse_length = 0, source_level = 0, directivity_index = 0;
    double beam_width = 0;  ///< rad, conical
    echosounder::BottomRule bottom;
    Receiver receiver;
};

/// All but its receiver, which is as good as the head's.
void describe(AuxSettings& settings, OptionList& options, FigureList& figures);

/// Its ping straight down.
Shot aux_shot(const AuxSettings& settings);
/// How long it listens, s.
double aux_window(const AuxSettings& settings);
/// "0123mm" for a bottom 123 mm below; nothing where there is none.
std::optional<std::string> aux_text(const Echogram& echogram, const AuxSettings& settings);

}  // namespace echoloop::tritech
