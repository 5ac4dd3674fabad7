#include "emulator/devices/family/tritech/scan.h"

#include <algorithm>

namespace echoloop::tritech {
namespace {

constexpr int circle = seanet::angle_units;

std::uint16_t wrap(int angle) { return static_cast<std::uint16_t>(((angle % circle) + circle) % circle); }

}  // namespace

std::uint16_t Scan::sector_width() const { return wrap(command_.right_limit - command_.left_limit); }

std::uint16_t Scan::offset_from_left() const { return wrap(position_ - command_.left_limit); }

/// The offset from the left limit at which a clockwise pass ends.
std::uint16_t Scan::last_offset() const {
    const std::uint16_t width = sector_width();
    if (!rules_.whole_steps || command_.step == 0) return width;
    return static_cast<std::uint16_t>(width - width % command_.step);
}

/// Equal limits (some drivers' default) mean the full circle.
bool Scan::full_circle() const { return command_.continuous || sector_width() == 0; }

void Scan::configure(const ScanCommand& command) {
    command_ = command;
    pinged_limit_ = false;
    clockwise_ = command.clockwise || (command.continuous && rules_.force_right);
    if (command.stare) {
        position_ = wrap(command.left_limit);
        return;
    }
    if (full_circle()) return;
    clockwise_ = true;
    const bool outside = offset_from_left() > sector_width();
    if (!rules_.start_at_position || outside) position_ = wrap(command.left_limit);
}

void Scan::reverse() {
    clockwise_ = !clockwise_;
    pinged_limit_ = false;
}

std::uint16_t Scan::step() const {
    return command_.stare || command_.motor_off ? std::uint16_t{0} : command_.step;
}

void Scan::advance() {
    if (step() == 0) return;
    if (full_circle())
        position_ = wrap(position_ + (clockwise_ ? command_.step : -command_.step));
    else
        advance_in_sector();
}

void Scan::advance_in_sector() {
    const bool at_end = clockwise_ ? offset_from_left() >= last_offset() : offset_from_left() == 0;
    if (at_end && rules_.limits_twice && !pinged_limit_) {
        pinged_limit_ = true;
        return;
    }
    pinged_limit_ = false;
    if (at_end) clockwise_ = !clockwise_;
    const int offset = offset_from_left() + (clockwise_ ? command_.step : -command_.step);
    position_ = wrap(command_.left_limit + std::clamp<int>(offset, 0, last_offset()));
}

seanet::SweepCode Scan::sweep_code() const {
    using seanet::SweepCode;
    if (command_.stare) return SweepCode::at_left_limit;
    if (full_circle()) return SweepCode::normal;
    if (offset_from_left() == 0) return SweepCode::at_left_limit;
    if (offset_from_left() == last_offset()) return SweepCode::at_right_limit;
    return SweepCode::normal;
}

}  // namespace echoloop::tritech
