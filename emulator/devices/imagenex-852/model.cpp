#include <algorithm>
#include <cmath>

#include "emulator/devices/imagenex-852/sounder.h"
#include "emulator/option_rows.h"
#include "emulator/options.h"

namespace echoloop::imagenex852 {
namespace {

constexpr double default_range = 10;  // m
const char* const spec = "Imagenex specification notes";

std::vector<Option> option_table() {
    auto all = imagenex_head::option_table({.head_id = 0x11,
                                            .lowest_id = 0x11,
                                            .highest_id = 0x15,
                                            .status = {"45", "41"},
                                            .ceilings = {"127"}});
    const std::vector<Option> own{
        choice_row("position_bytes", {"78 0A", "00 00"}, "bytes 5 and 6, which mean nothing in a sounder",
                   spec),
        number_row("trigger_rate", "Hz", 0, 0, 100,
                   "pulses on the external trigger input, from the start of the run on; 0: no such input",
                   spec),
    };
    all.insert(all.end(), own.begin(), own.end());
    return all;
}

Settings read_settings(const DeviceConfig& config) {
    Settings s;
    s.head = imagenex_head::read_settings(config);
    if (text(config.options, "position_bytes") == "78 0A") {
        s.position_bytes.low = 0x78;
        s.position_bytes.high = 0x0A;
    }
    s.trigger_rate = number(config.options, "trigger_rate");
    return s;
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Sounder>(read_settings(config));
}

/// A plain host's command: 500 points, 100 us.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    if (!(range > 0)) range = default_range;
    const auto settings = imagenex_head::read_settings(config);
    imagenex::SwitchCommand command;
    command.range = static_cast<std::uint8_t>(std::clamp(std::ceil(range), 1.0, 50.0));
    command.data_points = 50;
    const auto format = imagenex_head::format_of(command, settings);
    Shot shot = imagenex_head::plain_shot(command, format, range / 500, settings);
    shot.pulse_length = 100e-6;
    shot.bin_interval = 2 * range / config.sound_speed / static_cast<double>(shot.bins);
    shot.ping = step + 1;
    return shot;
}

}  // namespace

Model model() {
    Model m;
    m.name = "imagenex-852";
    m.title = "Imagenex 852 ultra-miniature echo sounder";
    m.protocol = "Imagenex switch data, serial 115200 8N1";
    m.default_endpoints = {"pty:/tmp/echoloop/imagenex-852"};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp-listen", "udp"};
    m.options = option_table();
    m.figures = imagenex_head::figure_table();
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    return m;
}

}  // namespace echoloop::imagenex852
