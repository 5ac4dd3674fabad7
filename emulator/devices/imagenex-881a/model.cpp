#include <cmath>
#include <numbers>
#include <stdexcept>

#include "emulator/devices/family/imagenex/model.h"
#include "emulator/devices/imagenex-881a/sonar.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::imagenex881a {
namespace {

constexpr std::size_t turn_steps = 400;  // 0.9 deg each
constexpr double longest_range = 200;    // m
const char* const spec = "Imagenex specification notes";

std::vector<Option> option_table() {
    auto all = imagenex_head::option_table({.head_id = 0x10,
                                            .lowest_id = 0x10,
                                            .highest_id = 0x1F,
                                            .status = {"41", "40"},
                                            .ceilings = {"127", "255"}});
    const std::vector<Option> own{
        choice_row("imx_bytes", {"252", "250"}, "8-bit echo data of an IMX reply; 250: old firmware", spec),
        choice_row(
            "sector_edge", {"before", "clip"},
            "the head turns round before it would pass a sector's edge, or makes its last step end there",
            spec),
        number_row("start_angle", "deg", 0, -180, 179.7, "where the head points at power-up", "own choice"),
        flag_row("azimuth_drive", false, "an azimuth drive, id 1F, turns the head about the same axis",
                 "Imagenex specification notes; the axis: own choice"),
    };
    all.insert(all.end(), own.begin(), own.end());
    return all;
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.head = imagenex_head::read_settings(config);
    s.head.imx_bytes = text(o, "imx_bytes") == "250" ? 250 : 252;
    s.clip = text(o, "sector_edge") == "clip";
    s.start_position = static_cast<int>(std::lround(number(o, "start_angle") / 0.3)) + ahead;
    s.start_position %= circle;
    s.azimuth_drive = flag(o, "azimuth_drive");
    if (s.azimuth_drive && s.head.head_id == imagenex::azimuth_head_id)
        throw std::invalid_argument(
            "head_id 31 (1F) is the azimuth drive's; choose another id or switch the drive off");
    return s;
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Sonar>(read_settings(config));
}

/// A plain host's command: 8 bits at 675 kHz.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    imagenex::SwitchCommand command;
    command.pulse_length = 6;
    command.frequency = 100;
    Shot shot = imagenex_head::plain_ping(command, range, longest_range, config, step);
    set_sound(command, read_settings(config).head.acoustics.frequency, shot);
    const int position = static_cast<int>(step % turn_steps * (circle / turn_steps));
    shot.pan = std::remainder(angle_of(position), 2 * std::numbers::pi);
    return shot;
}

}  // namespace

Model model() {
    Model m = imagenex_head::model_of("imagenex-881a", "Imagenex 881A multi-frequency scanning sonar");
    m.turn_steps = turn_steps;
    m.options = option_table();
    m.make = make;
    m.default_shot = default_shot;
    return m;
}

}  // namespace echoloop::imagenex881a
