#include "emulator/devices/tritech-micron/settings.h"

#include <algorithm>

#include "emulator/option_rows.h"
#include "emulator/options.h"

namespace echoloop::micron {
namespace {

const char* const spec = "SeaNet specification notes";

std::vector<Option> start_up_options() {
    return {
        choice_row("profile", {"dst", "miniking"}, "family: dst sends the FPGA messages after mtBBUserData",
                   spec),
        integer_row("node", "", 2, 1, 254, "SeaNet node number of the head", spec),
        number_row("first_alive", "s", 1.0, 0.1, 30, "first mtAlive after power-up or mtReBoot", spec),
        integer_row("recentring_alives", "", 3, 0, 60,
                    "mtAlives sent while re-centring; one public driver needs 2", spec),
        flag_row("alives_while_scanning", false, "keep sending mtAlive while lines are requested", spec),
        choice_row("sent_cfg_by", {"both", "head-command", "bb-user"}, "which message sets the SentCfg bit",
                   spec),
        choice_row("early_request", {"ignore", "answer-later"},
                   "mtSendData without parameters or while centring", spec),
        choice_row("short_commands", {"drop", "by-id"}, "commands that claim more bytes than they have",
                   spec),
        flag_row("refuse_while_centring", false, "drop mtHeadCommand that comes while re-centring", spec),
        integer_row("software_version", "", 2, 0, 255, "first byte of mtVersionData", "free choice"),
        integer_row("serial_number", "", 1234, 0, 65535, "in mtVersionData", "free choice"),
    };
}

std::vector<Option> scan_options() {
    return {
        integer_row("replies", "", 2, 1, 2, "mtHeadData per mtSendData", spec),
        choice_row("surplus_requests", {"merge", "queue"}, "mtSendData that comes while lines are under way",
                   spec),
        flag_row("force_right", false, "continuous scans turn clockwise even without the scanright bit",
                 spec),
        flag_row("limits_twice", false, "ping each sector limit twice per pass", spec),
        flag_row("whole_steps", false, "never cut the last step at a sector limit", spec),
        choice_row("sector_start", {"left-limit", "position"}, "where a new sector begins", spec),
        flag_row("obey_invert", true, "the invert bit turns the rotation round (head mounted boot down)",
                 spec),
        choice_row("period_law", {"A", "B", "fixed"},
                   "A: 2R/c + step * MoTime + line time; B: twice 2R/c + step * MoTime, line time included",
                   spec),
        number_row("period_scale", "", 1, 0.01, 100, "factor on the period of law A or B", spec),
        number_row("fixed_period", "s", 0.05, 0.001, 60, "period of a line under law fixed", spec),
    };
}

std::vector<Option> data_options() {
    return {
        choice_row("nibble_order", {"high-first", "low-first"},
                   "4-bit bins: which half of a byte is the nearer bin", spec),
        choice_row("ad_span_scale", {"255", "15"}, "4-bit bins: scale of ADSpan and ADLow", spec),
        integer_row("device_type", "", 0x11, 0, 255, "byte 15 of mtHeadData", spec),
        choice_row("head_data_byte9", {"zero", "low-byte"},
                   "byte 9 of mtHeadData: one public driver takes only zero", spec),
        integer_row("hd_ctrl_set", "", 0, 0, 65535, "bits forced to 1 in the HdCtrl of replies", spec),
        integer_row("hd_ctrl_clear", "", 0, 0, 65535, "bits forced to 0 in the HdCtrl of replies", spec),
        number_row("baud", "bit/s", 115200, 0, 4e6, "line rate of pty and TCP endpoints; 0: not paced", spec),
    };
}

void append(std::vector<Option>& all, std::vector<Option> more) {
    std::move(more.begin(), more.end(), std::back_inserter(all));
}

Acoustics read_acoustics(const Profile& p, bool tvg) {
    Acoustics a;
    a.frequency = figure(p, "frequency");
    a.bandwidth = figure(p, "bandwidth");
    a.shortest_pulse = figure(p, "shortest_pulse");
    a.source_level = figure(p, "source_level");
    a.beam_width = deg_to_rad(figure(p, "beam_width"));
    a.fan_height = deg_to_rad(figure(p, "fan_height"));
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    a.reference_level = figure(p, "reference_level");
    a.tvg_spreading = tvg ? figure(p, "tvg_spreading") : 0;
    a.tvg_absorption = tvg ? figure(p, "tvg_absorption") : 0;
    return a;
}

}  // namespace

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"frequency", "Hz", "centre of the swept band", 10e3, 10e6},
        {"bandwidth", "Hz", "width of the swept band; 0: a tone", 0, 5e6},
        {"shortest_pulse", "s", "shorter commanded pulses are made as long", 1e-6, 1e-2},
        {"source_level", "dB re 1 uPa at 1 m", "on the axis", 100, 240},
        {"beam_width", "deg", "horizontal -3 dB full width, two-way", 0.1, 60},
        {"fan_height", "deg", "vertical -3 dB full width, two-way", 0.1, 120},
        {"tvg_spreading", "dB per decade of range", "time-varied gain", 0, 60},
        {"tvg_absorption", "dB/m", "time-varied gain, one way", 0, 2},
        {"reference_level", "dB re 1 uPa", "level after time-varied gain that reads 0 dB at zero gain", 0,
         300},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    std::vector<Option> all = start_up_options();
    append(all, scan_options());
    append(all, data_options());
    return all;
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.node = static_cast<std::uint8_t>(integer(o, "node"));
    s.dst = text(o, "profile") == "dst";
    s.first_alive = number(o, "first_alive");
    s.recentring_alives = static_cast<int>(integer(o, "recentring_alives"));
    s.alives_while_scanning = flag(o, "alives_while_scanning");
    s.sent_cfg_by = text(o, "sent_cfg_by");
    s.replies = static_cast<int>(integer(o, "replies"));
    s.queue_requests = text(o, "surplus_requests") == "queue";
    s.early_request = text(o, "early_request");
    s.refuse_while_centring = flag(o, "refuse_while_centring");
    s.scan = {flag(o, "force_right"), flag(o, "limits_twice"), flag(o, "whole_steps"),
              text(o, "sector_start") == "position"};
    s.obey_invert = flag(o, "obey_invert");
    s.period_law = text(o, "period_law");
    s.period_scale = number(o, "period_scale");
    s.fixed_period = number(o, "fixed_period");
    s.high_nibble_first = text(o, "nibble_order") == "high-first";
    s.ad_span_15 = text(o, "ad_span_scale") == "15";
    s.device_type = static_cast<std::uint8_t>(integer(o, "device_type"));
    if (text(o, "short_commands") == "by-id") s.frame_lengths = seanet::Framer::Lengths::by_id;
    if (text(o, "head_data_byte9") == "low-byte") s.head_data_remaining = seanet::HeadDataRemaining::low_byte;
    s.hd_ctrl_set = static_cast<std::uint16_t>(integer(o, "hd_ctrl_set"));
    s.hd_ctrl_clear = static_cast<std::uint16_t>(integer(o, "hd_ctrl_clear"));
    s.software_version = static_cast<std::uint8_t>(integer(o, "software_version"));
    s.serial_number = static_cast<std::uint16_t>(integer(o, "serial_number"));
    s.baud = number(o, "baud");
    s.acoustics = read_acoustics(config.profile, config.effects.has(Effect::tvg));
    return s;
}

bool usable(const seanet::HeadParameters& p) { return p.bins > 0 && p.ad_interval > 0; }

std::size_t effective_bins(const seanet::HeadParameters& p, const Settings& settings) {
    return std::min<std::size_t>(p.bins, static_cast<std::size_t>(settings.bin_limit()));
}

Shot shot_from(const seanet::HeadParameters& p, const Settings& settings, std::uint16_t bearing) {
    constexpr double unit = 2 * std::numbers::pi / seanet::angle_units;
    constexpr double longest = 10.0;  // s; a window of 7.5 km, far beyond what the head can hear
    const bool mirrored = settings.obey_invert && (p.hd_ctrl & seanet::hd_ctrl::invert) != 0;
    const Acoustics& a = settings.acoustics;
    Shot shot;
    shot.pan = (static_cast<double>(bearing) - 3200) * unit * (mirrored ? -1 : 1);
    shot.bearings = {0.0};
    shot.beam_width = a.beam_width;
    shot.fan_height = a.fan_height;
    shot.bins = effective_bins(p, settings);
    shot.bin_interval = std::max<int>(p.ad_interval, 5) * ad_interval_unit;
    shot.bin_interval = std::min(shot.bin_interval, longest / static_cast<double>(shot.bins));
    shot.frequency = a.frequency;
    shot.bandwidth = a.bandwidth;
    shot.pulse_length = std::max(p.tx_pulse * 1e-6, a.shortest_pulse);
    const bool silent = (p.hd_ctrl & seanet::hd_ctrl::txoff) != 0;
    shot.source_level = silent ? -300 : a.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    // A matched filter lets through as much noise as 1 / T, however wide the sweep.
    shot.receiver.bandwidth = 1 / shot.pulse_length;
    return shot;
}

}  // namespace echoloop::micron
