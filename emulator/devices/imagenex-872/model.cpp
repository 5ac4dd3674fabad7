#include <algorithm>
#include <cmath>

#include "emulator/devices/imagenex-872/imagenex_872.h"
#include "protocols/imagenex/codec.h"

namespace echoloop::imagenex872 {
namespace {

/// The default of a known host: 770 kHz, 40 %, 30.
imagenex::SwitchCommand plain_command(double range) {
    constexpr double default_range = 30;  // m
    imagenex::SwitchCommand command;
    command.head_id = 0;
    command.range =
        static_cast<std::uint8_t>(std::clamp(std::ceil(range > 0 ? range : default_range), 10.0, 200.0));
    command.reserved7 = 2;
    command.start_gain = 40;
    command.absorption = 30;
    return command;
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Imagenex872>(read_settings(config));
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    Shot shot = shot_from(plain_command(range), read_settings(config));
    if (range > 0) shot.bin_interval = 2 * range / config.sound_speed / points;
    shot.ping = step + 1;
    return shot;
}

std::vector<Bytes> requests(const DeviceConfig&, std::size_t pings, bool) {
    return std::vector<Bytes>(pings, imagenex::encode(imagenex::Message(plain_command(0))));
}

}  // namespace

Model model() {
    Model m;
    m.name = "imagenex-872";
    m.title = "Imagenex 872 YellowFin side-scan sonar";
    m.protocol = "Imagenex switch data, TCP 4040";
    m.default_endpoints = {"tcp-listen://127.0.0.1:4040"};
    m.endpoint_schemes = {"tcp-listen"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "imagenex";
    m.requests = requests;
    m.drivers = {{"dune",
                  "DUNE, Sensors/Imagenex872",
                  {"[Sensors.Imagenex872]", "Enabled = Hardware", "Entity Label = Sidescan",
                   "Activation Time = 3", "IO Port - Device = tcp://{host}:{number}"},
                  "goes into the vehicle's .ini file"}};
    return m;
}

}  // namespace echoloop::imagenex872
