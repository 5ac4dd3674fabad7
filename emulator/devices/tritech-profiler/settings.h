// The options of a profiler as typed values, and the ping that its command makes. Data and pure functions.
#pragma once

#include "emulator/devices/family/tritech/acoustics.h"
#include "emulator/devices/family/tritech/head_options.h"
#include "emulator/devices/tritech-profiler/echo_time.h"
#include "emulator/devices/tritech-profiler/pass.h"

namespace echoloop::profiler {

/// Emulator options; README.md of this folder explains each.
struct Settings {
    tritech::HeadSettings head;
    tritech::Acoustics acoustics;
    bool whole_steps = false;
    bool gains_count = false;  ///< the block behind the main fields of 0x1D instead of them
    double period_scale = 1;
    int device_type = -1;  ///< -1: HdType of the command
};

Settings read_settings(const DeviceConfig& config);
void describe(Settings& settings, OptionList& options, FigureList& figures);

/// False if no ping can come of it.
bool usable(const seanet::ProfilerParameters& parameters);
/// How long a ping listens, s.
double window(const seanet::ProfilerParameters& parameters);
Choice choice(const seanet::ProfilerParameters& parameters);
Pass make_pass(const seanet::ProfilerParameters& parameters, const Settings& settings);
Shot ping_shot(const seanet::ProfilerParameters& parameters, const Settings& settings,
               const tritech::Tuning& tuning, std::uint16_t bearing);

}  // namespace echoloop::profiler
