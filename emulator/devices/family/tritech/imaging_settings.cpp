#include "emulator/devices/family/tritech/imaging_settings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace echoloop::tritech {
namespace {

constexpr double ad_interval_unit = 640e-9;  // s

void describe_scan(ImagingSettings& s, OptionList& o, Family family) {
    o.flag(s.scan.force_right, "force_right",
           "continuous scans turn clockwise even without the scanright bit", specification);
    o.flag(s.scan.limits_twice, "limits_twice", "ping each sector limit twice per pass", specification);
    o.flag(s.scan.whole_steps, "whole_steps", "never shorten the last step at a sector limit", specification);
    o.choice(s.scan.start_at_position, "sector_start", {"left-limit", "position"},
             "where a new sector begins", specification);
    o.flag(s.obey_invert, "obey_invert", "the invert bit reverses the rotation (head mounted boot down)",
           specification);
    const std::initializer_list<Word<bool>> dst{{"ignore", false}, {"channels", true}},
        seaking{{"channels", true}, {"ignore", false}};
    s.ping_pong = family == Family::seaking;
    o.words(s.ping_pong, "ping_pong", family == Family::dst ? dst : seaking,
            "HdCtrl bit 11: every other line uses the other channel",
            "own choice: the specification gives the bit's name only; a DST has one channel");
    o.choice(s.period_law, "period_law", {"A", "B", "fixed"},
             "A: 2R/c + step * MoTime + line time; B: twice 2R/c + step * MoTime, line time included",
             specification);
    o.number(s.period_scale, "period_scale", "", 0.01, 100, "factor on the period of law A or B",
             specification);
    o.number(s.fixed_period, "fixed_period", "s", 0.001, 60, "period of a line under law fixed",
             specification);
}

void describe_data(ImagingSettings& s, OptionList& o) {
    o.choice(s.v3b_counts, "v3b", {"main", "v3b"},
             "mtHeadCommand 0x1D: which ADSpan, ADLow, gain and slope count, the main fields or V3B",
             specification);
    o.words(s.packing.high_first, "nibble_order", {{"high-first", true}, {"low-first", false}},
            "4-bit bins: which half of a byte is the nearer bin", specification);
    o.choice(s.packing.span_of_15, "ad_span_scale", {"255", "15"}, "4-bit bins: scale of ADSpan and ADLow",
             specification);
    o.whole(s.device_type, "device_type", "", -1, 255, "byte 15 of mtHeadData; -1: HdType of the command",
            specification);
    o.whole(s.motor_error_after, "motor_error_after", "", 0, 1e9,
            "lines after which MotErr is set until new parameters arrive; 0: never", "for tests of drivers");
    o.whole(s.power_loss_every, "power_loss_every", "", 0, 1e9,
            "one line in this many has HdPwrLoss; 0: never", "for tests of drivers");
}

void limit_window(Shot& shot) {
    constexpr double longest = 10.0;  // s; 7.5 km, far beyond what a head can hear
    shot.bin_interval = std::min(shot.bin_interval, longest / static_cast<double>(shot.bins));
}

}  // namespace

void describe(ImagingSettings& s, OptionList& o, FigureList& f, Family family) {
    s.head.dst = family == Family::dst;
    if (family == Family::seaking) {
        s.acoustics.tunable.emplace();
        s.device_type = -1;
        s.most_bins = 800;
    }
    describe(s.head, o);
    o.whole(s.head.node, "node", "", 1, 254, "SeaNet node number of the head", specification);
    describe_scan(s, o, family);
    describe_data(s, o);
    describe(s.acoustics, f);
    describe(s.aux, o, f);
}

ImagingSettings read_imaging_settings(const DeviceConfig& config, Family family) {
    auto s = fill_settings<ImagingSettings>(config, family);
    s.head.version.node = s.head.node;
    s.head.line_rate = line_rate(config.endpoints, s.head.line_rate);
    s.acoustics.tvg = config.effects.has(Effect::tvg);
    s.aux.receiver = s.acoustics.receiver;
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
