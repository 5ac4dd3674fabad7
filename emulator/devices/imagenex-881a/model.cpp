#include <cmath>
#include <numbers>
#include <stdexcept>

#include "emulator/devices/family/imagenex/model.h"
#include "emulator/devices/imagenex-881a/sonar.h"

namespace echoloop::imagenex881a {
namespace {

constexpr std::size_t turn_steps = 400;  // 0.9 deg each
constexpr double longest_range = 200;    // m
const char* const spec = "Imagenex specification notes";

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    complete(s.head, config);
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
    const imagenex_head::Settings head = read_settings(config).head;
    Shot shot = imagenex_head::plain_ping(command, range, longest_range, head, config.sound_speed);
    shot.ping = step + 1;
    set_sound(command, head.acoustics.frequency, shot);
    const int position = static_cast<int>(step % turn_steps * (circle / turn_steps));
    shot.pan = std::remainder(angle_of(position), 2 * std::numbers::pi);
    return shot;
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe(s.head, o, f,
             {.lowest_id = 0x10,
              .highest_id = 0x1F,
              .status = {{"41", 0x41}, {"40", 0x40}},
              .ceilings = {{"127", 127}, {"255", 255}}});
    o.words(s.head.imx_bytes, "imx_bytes", {{"252", 252}, {"250", 250}},
            "8-bit echo data of an IMX reply; 250: old firmware", spec);
    o.choice(s.clip, "sector_edge", {"before", "clip"},
             "the head reverses before it would pass a sector's edge, or shortens its last step to end there",
             spec);
    double start_angle = 0;  // deg
    o.number(start_angle, "start_angle", "deg", -180, 179.7, "where the head points at power-up",
             "own choice");
    s.start_position = (static_cast<int>(std::lround(start_angle / 0.3)) + ahead) % circle;
    o.flag(s.azimuth_drive, "azimuth_drive", "an azimuth drive, id 1F, turns the head about the same axis",
           "Imagenex specification notes; the axis: own choice");
}

Model model() {
    Model m = imagenex_head::model_of("imagenex-881a", "Imagenex 881A multi-frequency scanning sonar");
    m.turn_steps = turn_steps;
    list_settings<Settings>(m);
    m.make = make;
    m.default_shot = default_shot;
    m.drivers = {{"dune",
                  "LSTS DUNE",
                  {"[Sensors.Imagenex881A]", "Enabled                                 = Hardware",
                   "Entity Label                            = {name}",
                   "Serial Port - Device                    = {port}"}}};
    return m;
}

}  // namespace echoloop::imagenex881a
