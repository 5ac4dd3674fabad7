#include "emulator/devices/family/imagenex/model.h"

#include <algorithm>
#include <cmath>

#include "emulator/contract/options.h"
#include "emulator/devices/family/imagenex/echo.h"
#include "protocols/imagenex/codec.h"

namespace echoloop::imagenex_head {
namespace {

std::vector<Bytes> requests(const DeviceConfig& config, std::size_t pings, bool turns) {
    imagenex::SwitchCommand command;
    command.head_id = static_cast<std::uint8_t>(integer(config.options, "head_id"));
    command.range = 10;
    command.mode = imagenex::mode::all;
    command.sector_width = 120;
    command.step_size = turns ? 1 : 0;
    command.pulse_length = 10;
    command.data_points = 25;
    command.data_bits = 8;
    return std::vector<Bytes>(pings, imagenex::encode(imagenex::Message(command)));
}

}  // namespace

Model model_of(const std::string& name, const std::string& title) {
    Model m;
    m.name = name;
    m.title = title;
    m.protocol = "Imagenex switch data, serial 115200 8N1";
    m.default_endpoints = {"pty:/tmp/echoloop/" + name};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp-listen", "udp"};
    m.profile = built_in_profile(name);
    m.family = "imagenex";
    m.requests = requests;
    return m;
}

Shot plain_ping(imagenex::SwitchCommand command, double range, double longest, const Settings& settings,
                double true_sound_speed) {
    constexpr double default_range = 10;  // m
    constexpr int points = 500;
    if (!(range > 0)) range = default_range;
    command.range = static_cast<std::uint8_t>(std::clamp(std::ceil(range), 1.0, longest));
    command.data_points = points / 10;
    Shot shot = plain_shot(command, format_of(command, settings), range / points, settings);
    shot.bin_interval = 2 * range / true_sound_speed / static_cast<double>(shot.bins);
    return shot;
}

}  // namespace echoloop::imagenex_head
