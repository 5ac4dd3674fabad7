#include "protocols/r2sonic/commands.h"

#include <algorithm>
#include <array>
#include <string>

namespace echoloop::r2sonic {

namespace {

constexpr CommandInfo table[] = {
    {"ABS0", true, "dB/km", "absorption, 0..200; ABS1-4 MultiMode"},
    {"AIB0", true, "dB", "image brightness, 0..60"},
    {"AIH0", false, "", "image height in bins, 0 off"},
    {"AUT0", false, "", "0x10000 auto range"},
    {"BIE0", false, "", "1 adds intensities (I1)"},
    {"BMAX", false, "", "of older programs, ignored"},
    {"BMIN", false, "", "of older programs, ignored"},
    {"BOS0", false, "", "0 equi-angle, 1 equi-distant"},
    {"BPHS", false, "", "of older programs, ignored"},
    {"DGA0", true, "m", "depth gate min, 0..1200"},
    {"DGB0", true, "m", "depth gate max, 0..1200"},
    {"DGO0", false, "", "0 off, 1 manual, 0xww02 auto, 0xww03 auto + slope, ww % of depth"},
    {"DGS0", true, "rad", "depth gate slope, positive: deeper to starboard; degrees towards the GUI"},
    {"DHM0", false, "", "0 single, 1/2 master, 3/4 slave"},
    {"DYNA", false, "", "0xaabbbccc simulated bottom"},
    {"FIL0", false, "", "0 single, 1 double, 2 quad fill"},
    {"FILT", false, "", "of older programs, ignored"},
    {"FRQ0", true, "Hz", "frequency; FRQ1-4 MultiMode"},
    {"GAN0", true, "2 dB", "gain, 1..45; GAN1-4 MultiMode"},
    {"IINS", false, "", "SIM: inertial system"},
    {"MIM0", false, "", "of older programs, ignored"},
    {"PNG0", false, "", "1 one ping"},
    {"POG0", false, "", "SIM: PPS edge"},
    {"PRL0", true, "Hz", "ping rate limit, 0.1..60"},
    {"PRO0", false, "", "projector 0 forward, 1 aft"},
    {"PROJ", false, "", "1 narrow, 2 wide projector beam"},
    {"PRU0", false, "", "1 ping rate limit on"},
    {"PRX0", true, "m", "projector offset"},
    {"PRY0", true, "m", "projector offset"},
    {"PRZ0", true, "m", "projector offset, +-0.2"},
    {"PTS0", false, "", "head: pitch stabilisation; SIM: sound velocity port"},
    {"RET0", true, "rad", "receiver tilt, +-45 deg"},
    {"RGA0", true, "m", "range gate min"},
    {"RGB0", true, "m", "range gate max"},
    {"RGO0", false, "", "1 range gate on"},
    {"RNG0", true, "m", "range, 2..1200"},
    {"ROS0", false, "", "roll stabilisation"},
    {"SER0", true, "rad", "sector rotation, +-70 deg; degrees towards the GUI; SER1-4 MultiMode"},
    {"SEW0", true, "rad", "sector width, 10..160 deg; SEW1-4 MultiMode"},
    {"SNIP", false, "", "1 snippets on"},
    {"SPO0", false, "", "SIM: head power"},
    {"SPR0", true, "dB", "spreading, 0..60; SPR1-4 MultiMode"},
    {"STM0", false, "", "status, 0 off"},
    {"SVL0", true, "m/s", "sound speed, 1250..1600"},
    {"SVU0", false, "", "1 use SVL0"},
    {"SYI0", false, "", "SIM: sync in 0 off, 1 rising, 2 falling"},
    {"SYO0", false, "", "SIM: sync out 0 high, 1 low, 2 off"},
    {"TPG0", false, "", "TruePix gates: 0 off, 1 max, 2 min and max"},
    {"TPM0", false, "", "TruePix: 0 off, 1 magnitude, 2 and direction"},
    {"TRG0", false, "", "trigger 0 free running, 1 external, 2 wait for PNG0"},
    {"TWIX", false, "", "0 flat bottom, 1 vertical features"},
    {"TXF0", true, "m", "transmit focus; 0 infinity, -1 nadir, -2 mid gates"},
    {"TXL0", true, "s", "pulse width"},
    {"TXP0", true, "dB", "source level, 0 or 191..221"},
    {"TXS0", true, "rad", "transmit steering"},
    {"TXW0", false, "", "0 rectangular, 1 Kaiser, 0xn0 staves"},
    {"UHD0", false, "", "1 is 1024 points"},
    {"WCM0", false, "", "water column: 0 off, 1 magnitude, 2 and phase"},
};

/// The SIM's serial ports: two letters, one of G (gps), M (motion), H (heading), S (svp), and 0.
constexpr std::array port_settings = {
    CommandInfo{"EN?0", false, "", "SIM port: enable"},
    CommandInfo{"DR?0", false, "", "SIM port: interface"},
    CommandInfo{"BD?0", false, "", "SIM port: baud"},
    CommandInfo{"DB?0", false, "", "SIM port: data bits"},
    CommandInfo{"PA?0", false, "", "SIM port: parity"},
    CommandInfo{"SB?0", false, "", "SIM port: stop bits"},
    CommandInfo{"IP?0", false, "", "SIM port: IPv4 address"},
    CommandInfo{"PT?0", false, "", "SIM port: UDP port"},
};

constexpr std::array multi_mode = {"ABS0", "FRQ0", "GAN0", "SER0", "SEW0", "SPR0"};

const CommandInfo* exact(std::string_view name) {
    const auto* row =
        std::find_if(std::begin(table), std::end(table), [&](const auto& c) { return c.name == name; });
    return row == std::end(table) ? nullptr : row;
}

const CommandInfo* port_setting(std::string_view name) {
    const bool form = std::string_view("GMHS").find(name[2]) != std::string_view::npos && name[3] == '0';
    const auto* row = std::find_if(port_settings.begin(), port_settings.end(), [&](const auto& c) {
        return form && c.name.substr(0, 2) == name.substr(0, 2);
    });
    return row == port_settings.end() ? nullptr : row;
}

}  // namespace

std::span<const CommandInfo> commands() { return table; }

const CommandInfo* find_command(std::string_view name) {
    if (name.size() != 4) return nullptr;
    if (const CommandInfo* row = exact(name)) return row;
    if (const CommandInfo* row = port_setting(name)) return row;
    if (name[3] < '1' || name[3] > '4') return nullptr;
    const std::string first = std::string(name.substr(0, 3)) + '0';
    const bool multi = std::find(multi_mode.begin(), multi_mode.end(), first) != multi_mode.end();
    return multi ? exact(first) : nullptr;
}

wire::Table command_table() {
    wire::Table out{.name = "Settings",
                    .tag = "",
                    .help = "names and values of CMD0",
                    .order = wire::ByteOrder::big,
                    .base = 0,
                    .rows = {}};
    const auto add = [&](const CommandInfo& info) {
        out.rows.push_back({.meta = {info.name, info.unit, info.help}, .type = info.real ? "f32" : "u32"});
    };
    std::for_each(std::begin(table), std::end(table), add);
    std::for_each(port_settings.begin(), port_settings.end(), add);
    return out;
}

}  // namespace echoloop::r2sonic
