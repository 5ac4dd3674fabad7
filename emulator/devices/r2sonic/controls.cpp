#include "emulator/devices/r2sonic/controls.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <variant>

namespace echoloop::r2sonic_device {
namespace {

constexpr double deg = std::numbers::pi / 180;

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
    {"TXL0", &Controls::pulse, 10e-6, 1115e-6},
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
    {"BOS0", &Controls::equi_distant},
    {"BIE0", &Controls::intensity},
    {"AIH0", &Controls::image_height, 0, 4096},
    {"AIB0", &Controls::image_brightness, 0, 60},
    {"PROJ", &Controls::projector, 1, 2},
    {"PRZ0", &Controls::projector_z, -0.2, 0.2},
    {"DGA0", &Controls::gate_min, 0, 1200},
    {"DGB0", &Controls::gate_max, 0, 1200},
    {"DGS0", &Controls::gate_slope, -80 * deg, 80 * deg},
    {"DGO0", &Controls::gate_mode, 0, 0xFFFF},
    {"RGA0", &Controls::range_gate_min, 0, 1200},
    {"RGB0", &Controls::range_gate_max, 0, 1200},
    {"RGO0", &Controls::range_gate},
    {"STM0", &Controls::status, 0, 3},
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

}  // namespace

Applied apply(Controls& controls, const r2sonic::Command& command) {
    const std::string_view name = command.name.view();
    if (name == "PNG0") return command.as_u32() == 1 ? Applied::ping : Applied::set;
    const auto row =
        std::find_if(std::begin(rows), std::end(rows), [&](const Row& r) { return r.name == name; });
    return row == std::end(rows) ? Applied::unknown : set(controls, *row, command);
}

}  // namespace echoloop::r2sonic_device
