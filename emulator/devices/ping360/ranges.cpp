#include "emulator/devices/ping360/ranges.h"

namespace echoloop::ping360 {
namespace {

/// What both commands have.
template <class Command>
std::optional<std::string_view> common_ranges(const Command& c) {
    const auto outside = [](int value, int low, int high) { return value < low || value > high; };
    if (outside(c.mode, 0, 1)) return "mode out of range";
    if (outside(c.gain_setting, 0, 2)) return "gain out of range";
    if (outside(c.transmit_duration, 1, 1000)) return "transmit duration out of range";
    if (outside(c.sample_period, 80, 40000)) return "sample period out of range";
    if (outside(c.transmit_frequency, 500, 1000)) return "transmit frequency out of range";
    if (outside(c.number_of_samples, 200, 1200)) return "number of samples out of range";
    return std::nullopt;
}

}  // namespace

std::optional<std::string_view> out_of_range(const ping::Transducer& c) {
    if (c.angle > 400) return "angle out of range";
    return common_ranges(c);
}

std::optional<std::string_view> out_of_range(const ping::AutoTransmit& c) {
    if (c.start_angle > 400) return "start angle out of range";
    if (c.stop_angle > 400) return "stop angle out of range";
    if (c.num_steps == 0) return "number of steps out of range";
    if (c.delay > 100) return "delay out of range";
    return common_ranges(c);
}

}  // namespace echoloop::ping360
