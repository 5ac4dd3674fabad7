#include "emulator/devices/family/imagenex/scan.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace echoloop::imagenex_head {
namespace {

constexpr int all_around = 120;  // of byte 12
constexpr int per_unit = 10;     // positions in the 3 deg of bytes 11 and 12

int wrapped(int position) { return ((position % circle) + circle) % circle; }
/// -600..599
int wrapped_offset(int offset) { return wrapped(offset + circle / 2) - circle / 2; }

}  // namespace

int Scan::move(const imagenex::SwitchCommand& command) {
    const int before = position_;
    if (command.calibrate == 1) {
        position_ = ahead;
        return std::abs(wrapped_offset(position_ - before));
    }
    const bool around = command.sector_width >= all_around;
    set_direction((command.motion & imagenex::motion::reverse) != 0, around);
    if ((command.motion & imagenex::motion::hold) != 0 || command.step_size == 0) return 0;
    if (around) {
        position_ = wrapped(position_ + (clockwise_ ? command.step_size : -command.step_size));
    } else {
        const int centre = command.train_angle * per_unit, half = command.sector_width * per_unit / 2;
        const int offset = wrapped_offset(position_ - centre);
        const bool inside = std::abs(offset) <= half;
        const int next = inside ? next_in_sector(offset, half, command.step_size)
                                : enter_sector(offset, half, command.step_size);
        position_ = wrapped(centre + next);
    }
    return std::abs(wrapped_offset(position_ - before));
}

void Scan::set_direction(bool reversed, bool around) {
    const bool turned = std::exchange(reversed_, reversed) != reversed;
    if (bit_ == ReverseBit::once) {
        if (turned && reversed) clockwise_ = !clockwise_;
    } else if (around) {
        clockwise_ = !reversed;
    } else if (turned) {
        clockwise_ = !clockwise_;
    }
}

int Scan::next_in_sector(int offset, int half, int step) {
    const auto way = [this] { return clockwise_ ? 1 : -1; };
    if (std::abs(offset + way() * step) <= half) return offset + way() * step;
    if (clip_ && offset != way() * half) return way() * half;
    clockwise_ = !clockwise_;
    const int back = offset + way() * step;
    return std::abs(back) <= half ? back : offset;
}

/// The short way, and never across a sector that is narrower than a step.
int Scan::enter_sector(int offset, int half, int step) {
    clockwise_ = offset < 0;
    const int edge = clockwise_ ? -half : half;
    const int next = offset + (clockwise_ ? step : -step);
    const bool across = clockwise_ ? next > half : next < -half;
    return across ? edge : next;
}

}  // namespace echoloop::imagenex_head
