#include "emulator/devices/family/tritech/imaging_model.h"
#include "emulator/devices/tritech-micron/micron.h"

namespace echoloop::micron {
namespace {

using tritech::Family;

std::unique_ptr<Device> make(const DeviceConfig& config) {
    tritech::want_one_line(config, "tritech-micron");
    return std::make_unique<tritech::Imaging>(tritech::read_imaging_settings(config, Family::dst));
}

/// Parameters of a plain driver: continuous 8-bit turn to the right, 500 bins, half gain.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    return tritech::plain_shot(config, Family::dst, step, range);
}

}  // namespace

Model model() {
    Model m = tritech::imaging_model("tritech-micron", "micron", Family::dst);
    m.title = "Tritech Micron DST mechanical scanning sonar";
    m.make = make;
    m.default_shot = default_shot;
    return m;
}

}  // namespace echoloop::micron
