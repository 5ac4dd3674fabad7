#include "emulator/devices/family/tritech/imaging_settings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::tritech {
namespace {

constexpr double ad_interval_unit = 640e-9;  // s

std::vector<Option> scan_rows(Family family) {
    const std::vector<std::string> ping_pong = family == Family::dst
                                                   ? std::vector<std::string>{"ignore", "channels"}
                                                   : std::vector<std::string>{"channels", "ignore"};
    return {
        flag_row("force_right", false, "continuous scans turn clockwise even without the scanright bit",
                 specification),
        flag_row("limits_twice", false, "ping each sector limit twice per pass", specification),
        flag_row("whole_steps", false, "never cut the last step at a sector limit", specification),
        choice_row("sector_start", {"left-limit", "position"}, "where a new sector begins", specification),
        flag_row("obey_invert", true, "the invert bit turns the rotation round (head mounted boot down)",
                 specification),
        choice_row("ping_pong", ping_pong, "HdCtrl bit 11: every other line uses the other channel",
                   "own choice: the specification gives the bit's name only; a DST has one channel"),
        choice_row("period_law", {"A", "B", "fixed"},
                   "A: 2R/c + step * MoTime + line time; B: twice 2R/c + step * MoTime, line time included",
                   specification),
        number_row("period_scale", "", 1, 0.01, 100, "factor on the period of law A or B", specification),
        number_row("fixed_period", "s", 0.05, 0.001, 60, "period of a line under law fixed", specification),
    };
}

std::vector<Option> data_rows(Family family) {
    return {
        choice_row("v3b", {"main", "v3b"},
                   "mtHeadCommand 0x1D: whose ADSpan, ADLow, gain and slope count, the main fields or V3B",
                   specification),
        choice_row("nibble_order", {"high-first", "low-first"},
                   "4-bit bins: which half of a byte is the nearer bin", specification),
        choice_row("ad_span_scale", {"255", "15"}, "4-bit bins: scale of ADSpan and ADLow", specification),
        integer_row("device_type", "", family == Family::dst ? 0x11 : -1, -1, 255,
                    "byte 15 of mtHeadData; -1: HdType of the command", specification),
        integer_row("motor_error_after", "", 0, 0, 1e9,
                    "lines after which MotErr is set, until parameters come again; 0: never",
                    "for tests of drivers"),
        integer_row("power_loss_every", "", 0, 0, 1e9, "every so many lines one says HdPwrLoss; 0: never",
                    "for tests of drivers"),
    };
}

void limit_window(Shot& shot) {
    constexpr double longest = 10.0;  // s; 7.5 km, far beyond what a head can hear
    shot.bin_interval = std::min(shot.bin_interval, longest / static_cast<double>(shot.bins));
}

}  // namespace

std::vector<Option> imaging_options(Family family) {
    std::vector<Option> all = head_option_rows(2, family == Family::dst);
    all.push_back(integer_row("node", "", seanet::nodes::imaging, 1, 254, "SeaNet node number of the head",
                              specification));
    append(all, scan_rows(family));
    append(all, data_rows(family));
    append(all, aux_rows());
    return all;
}

std::vector<FigureRow> imaging_figures(Family family) {
    std::vector<FigureRow> all = acoustic_figures(family == Family::seaking);
    for (FigureRow& row : aux_figures()) all.push_back(std::move(row));
    return all;
}

ImagingSettings read_imaging_settings(const DeviceConfig& config, Family family) {
    const Options& o = config.options;
    const bool dst = family == Family::dst;
    ImagingSettings s;
    s.head = read_head_settings(config, static_cast<std::uint8_t>(integer(o, "node")), dst);
    s.acoustics = read_acoustics(config.profile, !dst, config.effects.has(Effect::tvg));
    s.aux = read_aux(config);
    s.scan = {flag(o, "force_right"), flag(o, "limits_twice"), flag(o, "whole_steps"),
              text(o, "sector_start") == "position"};
    s.packing = {text(o, "nibble_order") == "high-first", text(o, "ad_span_scale") == "15"};
    s.obey_invert = flag(o, "obey_invert");
    s.v3b_counts = text(o, "v3b") == "v3b";
    s.ping_pong = text(o, "ping_pong") == "channels";
    s.period_law = text(o, "period_law");
    s.period_scale = number(o, "period_scale");
    s.fixed_period = number(o, "fixed_period");
    s.device_type = static_cast<int>(integer(o, "device_type"));
    s.motor_error_after = static_cast<int>(integer(o, "motor_error_after"));
    s.power_loss_every = static_cast<int>(integer(o, "power_loss_every"));
    s.most_bins = dst ? 1500 : 800;
    return s;
}

bool usable(const seanet::HeadParameters& p) { return p.bins > 0 && p.ad_interval > 0; }

Shot line_shot(const seanet::HeadParameters& p, const ImagingSettings& settings, const Tuning& tuning,
               std::uint16_t bearing) {
    constexpr double unit = 2 * std::numbers::pi / seanet::angle_units;
    constexpr int least_interval = 5;
    const bool mirrored = settings.obey_invert && (p.hd_ctrl & seanet::hd_ctrl::invert) != 0;
    Shot shot = sounding(settings.acoustics, tuning, p.tx_pulse * 1e-6);
    shot.pan = (static_cast<double>(bearing) - 3200) * unit * (mirrored ? -1 : 1);
    shot.bins = std::min<std::size_t>(p.bins, settings.most_bins);
    shot.bin_interval = std::max<int>(p.ad_interval, least_interval) * ad_interval_unit;
    limit_window(shot);
    if ((p.hd_ctrl & seanet::hd_ctrl::txoff) != 0) shot.source_level = -300;
    return shot;
}

Shot plain_shot(const DeviceConfig& config, Family family, std::size_t step, double range) {
    constexpr std::uint16_t turn_step = seanet::angle_units / turn_steps;
    constexpr double usual_range = 20;  // m
    if (!(range > 0)) range = usual_range;
    seanet::HeadParameters p;
    p.hd_ctrl = 0x2307;
    p.bins = 500;
    p.tx_pulse = 100;
    p.ad_interval = 5;
    const ImagingSettings settings = read_imaging_settings(config, family);
    Channel channel;
    channel.slope = static_cast<std::uint16_t>(std::lround(usual_slope(settings.acoustics.band.frequency)));
    const auto bearing = static_cast<std::uint16_t>((step * turn_step) % seanet::angle_units);
    Shot shot = line_shot(p, settings, tune(settings.acoustics, channel), bearing);
    shot.bin_interval = 2 * range / config.sound_speed / static_cast<double>(shot.bins);
    shot.ping = step + 1;
    return shot;
}

}  // namespace echoloop::tritech
