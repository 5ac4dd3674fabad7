#include "emulator/devices/tritech-profiler/settings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::profiler {
namespace {

namespace bits = seanet::profiler_ctrl;
constexpr double scan_time_unit = 100e-6;  // s

}  // namespace

std::vector<Option> option_table() {
    std::vector<Option> all = tritech::head_option_rows(1, false);
    tritech::append(
        all, {
                 flag_row("whole_steps", false, "no shorter last step at a limit", tritech::specification),
                 choice_row("acquisition", {"main", "block"},
                            "whose threshold, gain and slope count in mtHeadCommand 0x1D: the main fields or "
                            "the block behind",
                            tritech::specification),
                 number_row("period_scale", "", 1, 0.01, 100, "factor on the time of a ping", "own choice"),
                 integer_row("device_type", "", -1, -1, 255,
                             "byte 15 of mtHeadData; -1: HdType of the command", tritech::specification),
             });
    return all;
}

std::vector<FigureRow> figure_table() { return tritech::acoustic_figures(true); }

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.head = tritech::read_head_settings(config, seanet::nodes::profiler, false);
    s.acoustics = tritech::read_acoustics(config.profile, true, config.effects.has(Effect::tvg));
    s.whole_steps = flag(o, "whole_steps");
    s.gains_count = text(o, "acquisition") == "block";
    s.period_scale = number(o, "period_scale");
    s.device_type = static_cast<int>(integer(o, "device_type"));
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
