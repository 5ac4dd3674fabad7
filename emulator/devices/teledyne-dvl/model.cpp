#include "emulator/contract/endpoint.h"
#include "emulator/devices/teledyne-dvl/dvl.h"
#include "emulator/devices/teledyne-dvl/models.h"

namespace echoloop::teledyne_dvl {
namespace {

template <const Series* series>
std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Dvl>(read_settings(config, *series));
}

/// In the first mode whose depths reach out to `range`.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    constexpr double usual = 20;  // m
    const Settings settings = read_settings(config, pathfinder);
    const doppler::Acoustics& a = settings.acoustics;
    const auto modes = doppler::usual_modes(a.lowest_altitude, a.highest_altitude);
    std::size_t mode = 0;
    while (mode + 1 < modes.size() && modes[mode].farthest < (range > 0 ? range : usual)) ++mode;
    return doppler::make_shot(doppler::make_plan(modes[mode], config.sound_speed, settings), settings,
                              step + 1);
}

Model row(const std::string& name, const std::string& title) {
    Model m;
    m.name = name;
    m.title = title;
    m.protocol = "PD0, PD4, PD5, PD6, PD13 and a console, serial 115200 8N1";
    m.default_endpoints = {"pty:/tmp/echoloop/" + name};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.default_shot = default_shot;
    m.family = "teledyne";
    m.drivers = {{"rock",
                  "drivers-dvl_teledyne",
                  {"io_port: serial://{port}:{rate}"},
                  "its break is lost on a pty; the line end behind it stops the pings here"},
                 {"python",
                  "adcpreader",
                  {"with open(\"{port}\", \"rb\") as line, open(\"dvl.pd0\", \"wb\") as file:",
                   "    file.write(line.read(100000))", "from adcpreader.rdi_reader import PD0",
                   "ensembles = list(PD0().ensemble_generator(\"dvl.pd0\"))"},
                  "it reads files only",
                  "pty"}};
    return m;
}

}  // namespace

std::vector<Model> models() {
    std::vector<Model> all{row("dvl-pathfinder", "Teledyne Pathfinder Doppler velocity log"),
                           row("dvl-explorer", "Teledyne Explorer Doppler velocity log"),
                           row("dvl-navigator", "Teledyne Navigator Doppler velocity log")};
    all[0].make = make<&pathfinder>;
    all[1].make = make<&explorer>;
    all[2].make = make<&navigator>;
    return all;
}

}  // namespace echoloop::teledyne_dvl
