#include "emulator/devices/altimeters/altimeters.h"

namespace echoloop::altimeters {
namespace {

template <class Device, class Settings>
std::unique_ptr<echoloop::Device> make(const DeviceConfig& config) {
    return std::make_unique<Device>(read_settings<Settings>(config),
                                    echosounder::read_wiring(config.endpoints, "serial altimeter"));
}

template <class Settings>
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    return echosounder::plain_shot(read_settings<Settings>(config).sounding, config.sound_speed, step, range);
}

template <class Device, class Settings>
Model model(const char* name, const char* title, const char* protocol, const char* family) {
    Model m;
    m.name = name;
    m.title = title;
    m.protocol = protocol;
    m.default_endpoints = {std::string("pty:/tmp/echoloop/") + name};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make<Device, Settings>;
    m.default_shot = default_shot<Settings>;
    m.family = family;
    return m;
}

}  // namespace

std::vector<Model> models() {
    std::vector<Model> all{
        model<ValeportVa500, Valeport>("valeport-va500", "Valeport VA500 altimeter",
                                       "$PRVAT and commands, serial 115200 8N1", "nmea"),
        model<TritechPa, Tritech>("tritech-pa500", "Tritech PA500 altimeter", "ASCII lines, serial 9600 8N1",
                                  "altimeter"),
        model<TritechPa, TritechPa200>("tritech-pa200", "Tritech PA200 altimeter",
                                       "ASCII lines, serial 9600 8N1", "altimeter"),
        model<BenthosPsa916, Benthos>("benthos-psa916", "Benthos PSA-916 altimeter",
                                      "ASCII lines, serial 9600 8N1", "altimeter"),
        model<EchologgerEct, Echologger>("echologger-ect400", "Echologger ECT400 altimeter",
                                         "NMEA 0183 or ASCII lines, serial 115200 8N1", "nmea"),
        model<Imagenex863, Imagenex>("imagenex-863", "Imagenex 863 altimeter", "4 bytes, serial 2400 8N1",
                                     "altimeter")};
    for (Model& m : all)
        if (m.name == "echologger-ect400") m.drivers = {range_finder_in_sitl("17")};
    return all;
}

}  // namespace echoloop::altimeters
