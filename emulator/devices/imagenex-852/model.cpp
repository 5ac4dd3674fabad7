#include "emulator/devices/family/imagenex/model.h"
#include "emulator/devices/imagenex-852/sounder.h"

namespace echoloop::imagenex852 {
namespace {

constexpr double longest_range = 50;  // m
const char* const spec = "Imagenex specification notes";

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    complete(s.head, config);
    s.head.two_looks =
        true;  // noise over 50 m: standard deviation 0.385 of the mean; 0.38 by the larger of two
    return s;
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Sounder>(read_settings(config));
}

/// A plain host's pulse of 100 us.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    Shot shot =
        imagenex_head::plain_ping({}, range, longest_range, read_settings(config).head, config.sound_speed);
    shot.ping = step + 1;
    shot.pulse_length = 100e-6;
    return shot;
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe(s.head, o, f,
             {.lowest_id = 0x11,
              .highest_id = 0x15,
              .status = {{"45", 0x45}, {"41", 0x41}},
              .ceilings = {{"127", 127}}});
    o.words(s.position_bytes, "position_bytes",
            {{"78 0A", imagenex::Packed14(0x0A << 7 | 0x78)}, {"00 00", imagenex::Packed14()}},
            "bytes 5 and 6, which have no meaning in a sounder", spec);
    o.number(s.trigger_rate, "trigger_rate", "Hz", 0, 100,
             "pulses on the external trigger input, from the start of the run on; 0: no such input", spec);
}

Model model() {
    Model m = imagenex_head::model_of("imagenex-852", "Imagenex 852 ultra-miniature echo sounder");
    list_settings<Settings>(m);
    m.make = make;
    m.default_shot = default_shot;
    m.drivers = {
        {"ros1",
         "srv imagenex_echosounder",
         {"rosparam load $(rospack find imagenex_echosounder)/config/imagenex_echosounder.yaml",
          "rosrun imagenex_echosounder imagenex_echosounder _devname:={port}"}},
        {"dune",
         "LSTS DUNE",
         {"[Sensors.Imagenex852]", "Enabled                                 = Hardware",
          "Entity Label                            = {name}", "Activation Time                         = 3",
          "IO Port - Device                        = uart://{port}"}}};
    return m;
}

}  // namespace echoloop::imagenex852
