#include "emulator/devices/ping360/scan.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace echoloop::ping360 {

Scan::Scan(const ping::AutoTransmit& command, bool twice)
    : sense_(static_cast<std::int8_t>(command.num_steps) < 0 ? -1 : 1),
      start_(command.start_angle % circle),
      span_((sense_ * (command.stop_angle % circle - start_) + circle) % circle),
      step_(std::max(1, std::abs(static_cast<std::int8_t>(command.num_steps)))),
      full_(span_ == circle - 1 || std::abs(command.stop_angle - command.start_angle) >= circle - 1),
      twice_(twice) {}

void Scan::advance() {
    if (full_) {
        offset_ = (offset_ + step_) % circle;
        return;
    }
    const bool at_end = offset_ == (way_ > 0 ? span_ : 0);
    if (at_end && span_ > circle / 2) {
        offset_ = 0;
        return;
    }
    if (at_end) {
        way_ = -way_;
        if (twice_) return;
    }
    offset_ = std::clamp(offset_ + way_ * step_, 0, span_);
}

}  // namespace echoloop::ping360
