#include "emulator/devices/tritech-profiler/settings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace echoloop::profiler {
namespace {

namespace bits = seanet::profiler_ctrl;
constexpr double scan_time_unit = 100e-6;  // s

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    s.head.node = seanet::nodes::profiler;
    s.head.dst = false;
    s.head.replies = 1;
    s.acoustics.tunable.emplace();
    describe(s.head, o);
    o.flag(s.whole_steps, "whole_steps", "never shorten the last step at a limit", tritech::specification);
    o.choice(s.gains_count, "acquisition", {"main", "block"},
             "which threshold, gain and slope count in mtHeadCommand 0x1D: the main fields or the block "
             "after them",
             tritech::specification);
    o.number(s.period_scale, "period_scale", "", 0.01, 100, "factor on the time of a ping", "own choice");
    o.whole(s.device_type, "device_type", "", -1, 255, "byte 15 of mtHeadData; -1: HdType of the command",
            tritech::specification);
    describe(s.acoustics, f);
}

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    s.head.version.node = s.head.node;
    s.head.line_rate = line_rate(config.endpoints, s.head.line_rate);
    s.acoustics.tvg = config.effects.has(Effect::tvg);
    return s;
}

bool usable(const seanet::ProfilerParameters& p) { return p.scan_time > 0; }

double window(const seanet::ProfilerParameters& p) { return p.scan_time * scan_time_unit; }

Choice choice(const seanet::ProfilerParameters& p) {
    if ((p.hd_ctrl & bits::first) != 0) return Choice::first;
    return (p.prf_ctl2 & 1) != 0 ? Choice::strongest : Choice::normal;
}

Pass make_pass(const seanet::ProfilerParameters& p, const Settings& settings) {
    const auto has = [&](std::uint16_t bit) { return (p.hd_ctrl & bit) != 0; };
    const bool alternate = has(bits::alt);
    return Pass(p.left_limit, p.right_limit, has(bits::motoff) ? std::uint8_t{0} : p.step_size,
                {alternate, alternate || has(bits::scanright), has(bits::stare_llim), settings.whole_steps});
}

Shot ping_shot(const seanet::ProfilerParameters& p, const Settings& settings, const tritech::Tuning& tuning,
               std::uint16_t bearing) {
    constexpr double unit = 2 * std::numbers::pi / seanet::angle_units;
    constexpr double finest = 5e-6;  // s; 4 mm
    constexpr double most_bins = 5000;
    const bool mirrored = (p.hd_ctrl & bits::invert) != 0;
    Shot shot = tritech::sounding(settings.acoustics, tuning, p.tx_pulse * 1e-6);
    shot.pan = (static_cast<double>(bearing) - 3200) * unit * (mirrored ? -1 : 1);
    shot.bins = static_cast<std::size_t>(std::clamp(std::ceil(window(p) / finest), 1.0, most_bins));
    shot.bin_interval = window(p) / static_cast<double>(shot.bins);
    if ((p.hd_ctrl & bits::txoff) != 0) shot.source_level = -300;
    return shot;
}

}  // namespace echoloop::profiler
