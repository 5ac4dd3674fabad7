#include "emulator/devices/r2sonic/controls.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <variant>

namespace echoloop::r2sonic_device {
namespace {

constexpr double deg = std::numbers::pi / 180;
constexpr std::uint32_t any = 0xFFFFFFFF;

/// One row a command: its name, where it goes, its bounds.
struct Row {
    std::string_view name;
    std::variant<double Controls::*, bool Controls::*, std::uint32_t Controls::*> member;
    double low = 0, high = 0;
};

// Bounds of the operation manual v6.3, appendix "Control commands".
const Row rows[] = {
    {"TRG0", &Controls::trigger, 0, 2},
    {"RNG0", &Controls::range, 2, 1200},
    {"FRQ0", &Controls::frequency, 90e3, 700e3},
    {"TXP0", &Controls::power, 0, 221},
    {"TXL0", &Controls::pulse, 10e-6, 2000e-6},
    {"TXS0", &Controls::steering, -45 * deg, 45 * deg},
    {"TXW0", &Controls::window, 0, any},
    {"GAN0", &Controls::gain, 1, 45},
    {"SPR0", &Controls::spreading, 0, 60},
    {"ABS0", &Controls::absorption, 0, 200},
    {"SVL0", &Controls::sound_speed, 1250, 1600},
    {"SVU0", &Controls::use_sound_speed},
    {"PRL0", &Controls::ping_rate, 0.1, 60},
    {"PRU0", &Controls::limit_ping_rate},
    {"SEW0", &Controls::sector_width, 10 * deg, 160 * deg},
    {"SER0", &Controls::sector_rotation, -70 * deg, 70 * deg},
    {"RET0", &Controls::receiver_tilt, -45 * deg, 45 * deg},
    {"ROS0", &Controls::roll_stabilised},
    {"PTS0", &Controls::pitch_stabilised},
    {"BOS0", &Controls::equi_distant},
    {"UHD0", &Controls::ultra_high_density},
    {"BIE0", &Controls::intensity},
    {"AIH0", &Controls::image_height, 0, 4096},
    {"AIB0", &Controls::image_brightness, 0, 60},
    {"WCM0", &Controls::water_column, 0, 2},
    {"SNIP", &Controls::snippets},
    {"TPM0", &Controls::truepix, 0, 2},
    {"TPG0", &Controls::truepix_gates, 0, 2},
    {"PROJ", &Controls::projector, 1, 2},
    {"PRX0", &Controls::projector_x, -10, 10},
    {"PRY0", &Controls::projector_y, -10, 10},
    {"PRZ0", &Controls::projector_z, -0.2, 0.2},
    {"DGA0", &Controls::gate_min, 0, 1200},
    {"DGB0", &Controls::gate_max, 0, 1200},
    {"DGS0", &Controls::gate_slope, -90 * deg, 90 * deg},
    {"DGO0", &Controls::gate_mode, 0, 0xFFFF},
    {"RGA0", &Controls::range_gate_min, 0, 1200},
    {"RGB0", &Controls::range_gate_max, 0, 1200},
    {"RGO0", &Controls::range_gate},
    {"AUT0", &Controls::auto_range, 0, any},
    {"STM0", &Controls::status, 0, 3},
};

/// MultiMode has commands of its own for these, with 1 to 4 for the 0.
struct SetRow {
    std::string_view stem;
    std::optional<double> ModeSet::*member;
    double Controls::*plain;
};
const SetRow set_rows[] = {
    {"ABS", &ModeSet::absorption, &Controls::absorption},
    {"FRQ", &ModeSet::frequency, &Controls::frequency},
    {"GAN", &ModeSet::gain, &Controls::gain},
    {"SER", &ModeSet::sector_rotation, &Controls::sector_rotation},
    {"SEW", &ModeSet::sector_width, &Controls::sector_width},
    {"SPR", &ModeSet::spreading, &Controls::spreading},
};

Applied set(Controls& controls, const Row& row, const r2sonic::Command& command) {
    if (const auto* flag = std::get_if<bool Controls::*>(&row.member)) {
        controls.*(*flag) = command.as_u32() != 0;
    } else if (const auto* word = std::get_if<std::uint32_t Controls::*>(&row.member)) {
        const auto low = static_cast<std::uint32_t>(row.low), high = static_cast<std::uint32_t>(row.high);
        controls.*(*word) = std::clamp(command.as_u32(), low, high);
    } else {
        const double value = command.as_f32();
        if (!std::isfinite(value)) return Applied::refused;
        controls.*std::get<double Controls::*>(row.member) = std::clamp(value, row.low, row.high);
    }
    return Applied::set;
}

const Row* find_row(std::string_view name) {
    const auto row =
        std::find_if(std::begin(rows), std::end(rows), [&](const Row& r) { return r.name == name; });
    return row == std::end(rows) ? nullptr : row;
}

/// A command of MultiMode is applied to a copy as the plain one would be, so that its bounds are the same.
Applied apply_to_set(Controls& controls, const r2sonic::Command& command, const Variant& variant) {
    const std::string_view name = command.name.view();
    if (name.size() != 4 || name[3] < '1' || name[3] > '4') return Applied::unknown;
    for (const SetRow& row : set_rows) {
        if (name.substr(0, 3) != row.stem) continue;
        const std::string plain = std::string(row.stem) + '0';
        Controls copy = controls;
        const Applied applied = apply(copy, {std::string_view(plain), command.raw}, variant);
        if (applied == Applied::set)
            controls.sets[static_cast<std::size_t>(name[3] - '1')].*row.member = copy.*row.plain;
        return applied;
    }
    return Applied::unknown;
}

}  // namespace

void fit(Controls& controls, const Variant& variant) {
    controls.frequency = nearest_frequency(variant, controls.frequency);
    controls.sector_width = std::min(controls.sector_width, variant.widest_sector);
    controls.pulse = std::min(controls.pulse, variant.longest_pulse);
    controls.power = controls.power < 1 ? 0 : std::max(controls.power, 191.0);
}

Applied apply(Controls& controls, const r2sonic::Command& command, const Variant& variant) {
    const std::string_view name = command.name.view();
    if (name == "PNG0") return command.as_u32() == 1 ? Applied::ping : Applied::set;
    const Row* row = find_row(name);
    if (row == nullptr) return apply_to_set(controls, command, variant);
    const Applied applied = set(controls, *row, command);
    if (applied == Applied::set) fit(controls, variant);
    return applied;
}

Controls with_set(Controls controls, std::size_t set) {
    for (const SetRow& row : set_rows)
        if (const auto value = controls.sets.at(set).*row.member) controls.*row.plain = *value;
    return controls;
}

}  // namespace echoloop::r2sonic_device
