#include "emulator/devices/reson-7k/commands.h"

#include <array>
#include <bit>
#include <cmath>

#include "protocols/wire/bytes.h"

namespace echoloop::reson7k_device {
namespace {

using reson7k::ErrorCode;
using reson7k::RemoteControl;

/// A number that a command sets, and its bounds.
struct Row {
    std::uint32_t command;
    double Controls::*member;
    double low, high;
};

std::optional<double> number_at(const RemoteControl& control, std::size_t offset) {
    const auto word = word_at(control, offset);
    if (!word) return std::nullopt;
    return std::bit_cast<float>(*word);
}

Refusal set(const RemoteControl& control, const Row& row, Controls& controls) {
    const auto value = number_at(control, 0);
    if (!value) return ErrorCode::invalid;
    // Bounds are f32 on the wire: 30 us must not fail for its last bit.
    const double slack = 1e-6;
    if (!(*value >= row.low * (1 - slack) && *value <= row.high * (1 + slack)))
        return ErrorCode::out_of_range;
    controls.*row.member = *value;
    return std::nullopt;
}

/// 0: no pings until there is another rate, by what the definition says of 1100.
Refusal set_rate(const RemoteControl& control, const Acoustics& limits, Controls& controls) {
    if (number_at(control, 0) != 0.0)
        return set(control, {command::max_rate, &Controls::max_rate, least_rate, limits.most_rate}, controls);
    controls.max_rate = 0;
    return std::nullopt;
}

Refusal set_filter(const RemoteControl& control, Controls& controls) {
    std::array<double, 5> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto value = number_at(control, 4 * i);
        if (!value) return ErrorCode::invalid;
        if (!std::isfinite(*value) || std::abs(*value) > 1e4) return ErrorCode::out_of_range;
        values[i] = *value;
    }
    constexpr double least_width = 2;  // m, by the data format definition
    const auto [min_range, max_range, min_depth, max_depth, tilt] = values;
    if (max_range - min_range < least_width || max_depth - min_depth < least_width || std::abs(tilt) > 1.4)
        return ErrorCode::out_of_range;
    controls.min_range = min_range;
    controls.max_range = max_range;
    controls.min_depth = min_depth;
    controls.max_depth = max_depth;
    controls.gate_tilt = tilt;
    return std::nullopt;
}

Refusal set_mask(const RemoteControl& control, Controls& controls) {
    const auto mask = word_at(control, 0);
    if (!mask) return ErrorCode::invalid;
    controls.range_filter = (*mask & 1U << 8) != 0;
    controls.depth_filter = (*mask & 1U << 9) != 0;
    return std::nullopt;
}

/// w16 flags, f32 m/s, u8 filter, three bytes. The head has no other sensor whose values the flag of a manual
/// one could keep out, and manual values are never filtered.
Refusal set_sound_speed(const RemoteControl& control, Controls& controls) {
    constexpr std::size_t size = 10;
    constexpr std::uint16_t keep_speed = 1U << 1, change_filter = 1U << 2;
    constexpr double slowest = 1250, fastest = 1600;
    if (control.parameters.size() < size) return ErrorCode::invalid;
    const auto flags = static_cast<std::uint16_t>(*word_at(control, 0));
    const std::uint8_t filter = control.parameters[6];
    if ((flags & change_filter) != 0 && (filter < 1 || filter > 4)) return ErrorCode::out_of_range;
    if ((flags & keep_speed) != 0) return std::nullopt;
    const double speed = *number_at(control, 2);
    if (!(speed >= slowest && speed <= fastest)) return ErrorCode::out_of_range;
    controls.sound_speed = speed;
    return std::nullopt;
}

/// Gates of their own for the record are not there; a divisor that is not used may be anything.
Refusal set_water_column(const RemoteControl& control, Controls& controls) {
    namespace bits = reson7k::water_column;
    constexpr std::uint32_t known = 0xFFF, thinnings = 3, least_divisor = 2;
    const auto flags = word_at(control, 0);
    if (!flags) return ErrorCode::invalid;
    const std::uint32_t thinning = *flags >> bits::thinning_shift,
                        divisor = *flags >> bits::divisor_shift & 15;
    if ((*flags & ~known) != 0 || (*flags & bits::absolute_gates) != 0 || thinning > thinnings ||
        (thinning > 0 && divisor < least_divisor))
        return ErrorCode::out_of_range;
    controls.water_column = *flags;
    return std::nullopt;
}

/// CW is all that this sonar has.
Refusal set_pulse_type(const RemoteControl& control) {
    const auto type = word_at(control, 0);
    if (!type) return ErrorCode::invalid;
    return *type == 0 ? Refusal{} : ErrorCode::out_of_range;
}

}  // namespace

std::optional<std::uint32_t> word_at(const RemoteControl& control, std::size_t offset) {
    if (control.parameters.size() < offset + 4) return std::nullopt;
    return wire::load<wire::ByteOrder::little, std::uint32_t>(control.parameters.data() + offset);
}

bool apply_record(const reson7k::Message& message, Controls& controls) {
    constexpr float most_absorption = 500, most_spreading = 60;
    const auto take = [](float value, float most, double& into) {
        if (!(value >= 0 && value <= most)) return false;
        into = value;
        return true;
    };
    if (const auto* record = std::get_if<reson7k::AbsorptionLoss>(&message))
        return take(record->loss, most_absorption, controls.absorption);
    const auto* record = std::get_if<reson7k::SpreadingLoss>(&message);
    return record != nullptr && take(record->loss, most_spreading, controls.spreading);
}

Refusal apply(const RemoteControl& control, const Acoustics& limits, Controls& controls) {
    const Row rows[] = {
        {command::range, &Controls::range, limits.least_range, limits.most_range},
        {command::power, &Controls::power, limits.least_power, limits.most_power},
        {command::pulse, &Controls::pulse, limits.least_pulse, limits.most_pulse},
        {command::gain, &Controls::gain, 0, limits.most_gain},
        {command::frequency, &Controls::frequency, limits.least_frequency, limits.most_frequency},
    };
    for (const Row& row : rows)
        if (row.command == control.command) return set(control, row, controls);
    switch (control.command) {
        case command::max_rate:
            return set_rate(control, limits, controls);
        case command::pulse_type:
            return set_pulse_type(control);
        case command::detection_mask:
            return set_mask(control, controls);
        case command::detection_filter:
            return set_filter(control, controls);
        case command::water_column:
            return set_water_column(control, controls);
        case command::sound_speed:
            return set_sound_speed(control, controls);
        case command::start:
        case command::stop:
            controls.pinging = control.command == command::start;
            return std::nullopt;
        default:
            return ErrorCode::unknown_command;
    }
}

}  // namespace echoloop::reson7k_device
