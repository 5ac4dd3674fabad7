#include <algorithm>
#include <cmath>

#include "emulator/devices/imagenex-831l/profiler.h"
#include "protocols/imagenex/codec.h"
#include "protocols/imagenex/pipe_ranges.h"

namespace echoloop::imagenex831l {
namespace {

constexpr std::size_t turn_steps = 400;  // 0.9 deg each

/// What a public driver asks for by its own file of parameters: 1 m, 20 dB, 0.1 dB/m, 10 us, all around.
imagenex::SwitchCommand plain_command() {
    imagenex::SwitchCommand command;
    command.head_id = 0;
    command.range = 10;
    command.start_gain = 20;
    command.absorption = 10;
    command.train_angle = 120;
    command.sector_width = 120;
    command.step_size = 3;
    command.pulse_length = 10;
    command.minimum_profile_range = 1;
    command.data_points = 25;
    command.data_bits = 8;
    command.reply_baud = interrogate;
    command.frequency = 100;
    return command;
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Profiler>(read_settings(config));
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    imagenex::SwitchCommand command = plain_command();
    if (range > 0) {
        const auto* found = std::ranges::find_if(imagenex::pipe_ranges,
                                                 [&](const auto& one) { return one.metres >= range - 1e-9; });
        command.range =
            found != imagenex::pipe_ranges.end() ? found->code : imagenex::pipe_ranges.back().code;
    }
    Shot shot = shot_from(command, read_settings(config));
    if (range > 0) shot.bin_interval = 2 * range / config.sound_speed / static_cast<double>(shot.bins);
    shot.ping = step + 1;
    constexpr int step_size = imagenex_head::circle / static_cast<int>(turn_steps);
    const int position = static_cast<int>(step % turn_steps) * step_size;
    shot.pan = std::remainder(imagenex_head::angle_of(position), 2 * std::numbers::pi);
    return shot;
}

std::vector<Bytes> requests(const DeviceConfig&, std::size_t pings, bool turns) {
    imagenex::SwitchCommand command = plain_command();
    if (!turns) command.step_size = 0;
    return std::vector<Bytes>(pings, imagenex::encode(imagenex::Message(command)));
}

}  // namespace

Model model() {
    Model m;
    m.name = "imagenex-831l";
    m.title = "Imagenex 831L pipe profiling sonar";
    m.protocol = "Imagenex switch data, TCP 4040";
    m.default_endpoints = {"tcp-listen://127.0.0.1:4040"};
    m.endpoint_schemes = {"tcp-listen"};
    m.turn_steps = turn_steps;
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "imagenex";
    m.requests = requests;
    m.drivers = {
        {"python",
         "imagenex831l",
         {"from imagenex831l_driver import Imagenex831L", "sonar = Imagenex831L('{host}', {number})",
          "sonar.set_parameters(False, 20, 10, 120, 120, 3, 10, 10, 1, 0, 0, 0, 2250)",
          "sonar.send_request()", "sonar.interpret_data(sonar.read_data())"},
         "runs in the folder of that file, and needs numpy and rclpy, of which an empty module does"}};
    return m;
}

}  // namespace echoloop::imagenex831l
