#include "emulator/devices/family/imagenex/model.h"
#include "emulator/devices/imagenex-852/sounder.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::imagenex852 {
namespace {

constexpr double longest_range = 50;  // m
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

/// A plain host's pulse of 100 us.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    Shot shot = imagenex_head::plain_ping({}, range, longest_range, config, step);
    shot.pulse_length = 100e-6;
    return shot;
}

}  // namespace

Model model() {
    Model m = imagenex_head::model_of("imagenex-852", "Imagenex 852 ultra-miniature echo sounder");
    m.options = option_table();
    m.make = make;
    m.default_shot = default_shot;
    return m;
}

}  // namespace echoloop::imagenex852
