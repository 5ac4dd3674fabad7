#include "emulator/devices/ping360/scan.h"

#include <algorithm>

namespace echoloop::ping360 {

Scan::Scan(const ping::AutoTransmit& command, bool twice)
    : start_(command.start_angle % circle),
      span_((command.stop_angle % circle - start_ + circle) % circle),
      step_(std::max<int>(1, command.num_steps)),
      full_(span_ == circle - 1 || command.stop_angle - command.start_angle == circle),
      twice_(twice) {}

void Scan::advance() {
    if (full_) {
        offset_ = (offset_ + step_) % circle;
        return;
    }
    const bool at_end = offset_ == (way_ > 0 ? span_ : 0);
    if (at_end) {
        way_ = -way_;
        if (twice_) return;
    }
    offset_ = std::clamp(offset_ + way_ * step_, 0, span_);
}

}  // namespace echoloop::ping360
