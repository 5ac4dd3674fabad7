#include "emulator/devices/family/tritech/imaging_drivers.h"

#include "protocols/seanet/codec.h"

namespace echoloop::tritech {

/// 200 bins of 25 mm, a step of 0.9 deg at 250 us for each 1/16 gradian.
std::vector<Bytes> imaging_requests(const DeviceConfig&, std::size_t pings, bool turns) {
    seanet::HeadCommand command;
    seanet::HeadParameters& p = command.parameters;
    p.hd_ctrl = seanet::hd_ctrl::adc8on | seanet::hd_ctrl::cont | seanet::hd_ctrl::scanright |
                seanet::hd_ctrl::raw | seanet::hd_ctrl::hasmot | seanet::hd_ctrl::reply_asl;
    p.hd_type = 0x11;
    p.range_scale = 50;
    p.ad_span = 81;
    p.initial_gain1 = p.initial_gain2 = 105;  // 50 %, as Rock's driver has it
    p.motor_time = 25;
    p.step_size = turns ? 16 : 0;
    p.ad_interval = 52;
    p.bins = 200;
    p.max_ad_buffer = 1000;
    const Bytes ask = seanet::encode(seanet::Message(seanet::SendData{}));
    std::vector<Bytes> words(1 + pings, ask);
    words.front() = seanet::encode(seanet::Message(command));
    return words;
}

/// iSonar takes each setting from its block and has no defaults: without NBINS it shows nothing.
KnownDriver isonar(Family family) {
    const std::string type = family == Family::dst ? "Micron" : "Miniking";
    return {"moos",
            "moos-ivp-enstabretagne iSonar",
            {"ProcessConfig = iSonar", "{", "  AppTick     = 4", "  CommsTick   = 4",
             "  SERIAL_PORT = {port}", "  SONAR_TYPE  = " + type, "  RANGE       = 10",
             "  VOS         = 1500", "  INVERT      = 0", "  NBINS       = 200", "  ANGLESTEP   = 1.8",
             "  GAIN        = 45", "  CONTINUOUS  = true", "  POWERED_AT_START = true", "}"},
            "range in m, step in deg, gain in %"};
}

std::vector<KnownDriver> imaging_drivers(Family family) {
    const std::string property = "      # property of the oroGen task sonar_tritech::Micron";
    const std::string dst = family == Family::dst ? "" : "it wants the head of a DST: option device_type 17";
    return {
        {"ros1",
         "tritech_micron (branch noetic)",
         {"rosrun tritech_micron scan.py _port:={port} _frame:={name}"},
         dst},
        {"ros2",
         "labust tritech_sonar_driver",
         {"micron_sonar_node:", "  ros__parameters:", "    port: \"{port}\"", "    baudrate: 115200"},
         "goes into config/micron_sonar_node_params.yaml; start it with ros2 launch "
         "drivers_sonar_tritech micron_sonar_node.launch.py" +
             (dst.empty() ? dst : "; " + dst)},
        isonar(family),
        {"rock", "Rock sonar_tritech", {"io_port: 'tcp://{host}:{number}'" + property}, dst, "tcp-listen"},
        {"rock",
         "Rock sonar_tritech",
         {"io_port: 'serial://{port}:115200'" + property},
         "its program without Rock is sonar_tritech_bin, which takes the port"}};
}

}  // namespace echoloop::tritech
