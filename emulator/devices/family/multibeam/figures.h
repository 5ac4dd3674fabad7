// The figures of a profile that say how a multibeam detects the bottom. A list; decides nothing.
#pragma once

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/multibeam/bottom.h"

namespace echoloop::multibeam {

inline void list_figures(Rule& rule, FigureList& f) {
    f.number(rule.margin, "detection_margin", "dB", 0, 60, "how far above the noise a bottom must be");
    f.number(rule.phase_length, "phase_length", "", 1, 100,
             "echoes so many times longer than the pulse are located by phase");
    f.whole(rule.smoothed, "smoothed_soundings", 1, 15,
            "soundings by phase that are averaged for one; 1: none");
}

}  // namespace echoloop::multibeam
