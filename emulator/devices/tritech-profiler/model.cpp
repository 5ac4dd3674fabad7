#include <cmath>
#include <stdexcept>

#include "emulator/devices/tritech-profiler/profiler.h"
#include "protocols/seanet/codec.h"

namespace echoloop::profiler {
namespace {

constexpr std::size_t turn_steps = 200;  // 1.8 deg each

std::unique_ptr<Device> make(const DeviceConfig& config) {
    if (config.endpoints.size() != 1)
        throw std::invalid_argument("a tritech-profiler has one serial line: give exactly one endpoint");
    return std::make_unique<Profiler>(read_settings(config));
}

/// Parameters of a plain driver: full circle at the higher frequency, 15 m unless said otherwise.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    constexpr double usual_range = 15;  // m
    if (!(range > 0)) range = usual_range;
    const Settings settings = read_settings(config);
    tritech::Channel channel;
    channel.slope =
        static_cast<std::uint16_t>(std::lround(tritech::usual_slope(settings.acoustics.band.frequency)));
    seanet::ProfilerParameters p;
    p.tx_pulse = static_cast<std::uint16_t>(std::min(25 + 2.5 * range, 65535.0));
    p.scan_time = 200;
    const auto bearing =
        static_cast<std::uint16_t>(step * (seanet::angle_units / turn_steps) % seanet::angle_units);
    Shot shot = ping_shot(p, settings, tritech::tune(settings.acoustics, channel), bearing);
    shot.bin_interval = 2 * range / config.sound_speed / static_cast<double>(shot.bins);
    shot.ping = step + 1;
    return shot;
}

/// 20 ms for a ping, 15 m; a pass of one, or of two 0.9 deg apart at 250 us for each 1/16 gradian. Between
/// passes of one the head goes back, so that there is one only.
std::vector<Bytes> requests(const DeviceConfig&, std::size_t pings, bool turns) {
    seanet::ProfilerCommand command;
    seanet::ProfilerParameters& p = command.parameters;
    p.hd_ctrl = seanet::profiler_ctrl::hasmot | seanet::profiler_ctrl::scanright;
    p.tx_pulse = 62;
    p.range_scale = 150;
    p.left_limit = 3200;
    p.step_size = turns ? 16 : 0;
    p.right_limit = 3200 + 16;
    p.motor_time = 25;
    p.scan_time = 200;
    std::vector<Bytes> words{seanet::encode(seanet::Message(command))};
    if (!turns) pings = 1;
    for (std::size_t i = 0; i < pings; ++i)
        if (i % 2 == 1)
            words.emplace_back();  // the second ping of a pass comes unasked
        else
            words.push_back(seanet::encode(seanet::Message(seanet::SendData{}), {seanet::nodes::profiler}));
    return words;
}

}  // namespace

Model model() {
    Model m;
    m.name = "tritech-profiler";
    m.title = "Tritech SeaKing profiling sonar";
    m.protocol = "SeaNet (node 20), serial 115200 8N1";
    m.default_endpoints = {"pty:/tmp/echoloop/profiler"};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp-listen", "udp"};
    m.turn_steps = turn_steps;
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "seanet";
    m.requests = requests;
    const std::string property = "      # property of the oroGen task sonar_tritech::Profiling";
    m.drivers = {
        {"rock", "Rock sonar_tritech", {"io_port: 'tcp://{host}:{number}'" + property}, "", "tcp-listen"},
        {"rock", "Rock sonar_tritech", {"io_port: 'serial://{port}:115200'" + property}}};
    return m;
}

}  // namespace echoloop::profiler
