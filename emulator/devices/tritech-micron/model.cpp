#include <cmath>
#include <stdexcept>

#include "emulator/devices/tritech-micron/micron.h"
#include "emulator/endpoint.h"
#include "emulator/options.h"

namespace echoloop::micron {
namespace {

constexpr std::size_t turn_steps = 200;  // 1.8 deg each
constexpr std::uint16_t turn_step = seanet::angle_units / turn_steps;
constexpr std::uint16_t turn_bins = 500;
constexpr double default_range = 20;  // m

std::unique_ptr<Device> make(const DeviceConfig& config) {
    if (config.endpoints.size() != 1)
        throw std::invalid_argument("a tritech-micron has one serial line: give exactly one endpoint");
    return std::make_unique<Micron>(read_settings(config));
}

/// Parameters of a plain driver: continuous 8-bit turn to the right, 500 bins, half gain.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    if (!(range > 0)) range = default_range;
    seanet::HeadParameters p;
    p.hd_ctrl = 0x2307;
    p.bins = turn_bins;
    p.tx_pulse = 100;
    const double interval = 2 * range / config.sound_speed / turn_bins / ad_interval_unit;
    p.ad_interval = static_cast<std::uint16_t>(std::min(interval, 65535.0));
    const auto bearing = static_cast<std::uint16_t>((step * turn_step) % seanet::angle_units);
    Shot shot = shot_from(p, read_settings(config), bearing);
    shot.bin_interval = 2 * range / config.sound_speed / turn_bins;
    shot.ping = step + 1;
    return shot;
}

}  // namespace

Model model() {
    Model m;
    m.name = "tritech-micron";
    m.title = "Tritech Micron DST mechanical scanning sonar";
    m.protocol = "SeaNet, serial 115200 8N1";
    m.default_endpoints = {"pty:/tmp/echoloop/micron"};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp-listen", "udp"};
    m.turn_steps = turn_steps;
    m.options = option_table();
    m.figures = figure_table();
    m.profile = built_in_profile(m.name);
    m.moved = {{"source_level", "source_level"},
               {"reference_level", "reference_level"},
               {"tvg_spreading", "tvg_spreading"},
               {"tvg_absorption", "tvg_absorption"}};
    m.make = make;
    m.default_shot = default_shot;
    return m;
}

}  // namespace echoloop::micron
