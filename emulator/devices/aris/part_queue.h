// Parts of frames on their way out, each at its time. The device keeps them until shortly before, so that a
// controller that stops or goes takes the others along.
#pragma once

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "emulator/contract/device.h"

namespace echoloop::aris_device {

class PartQueue {
  public:
    /// Behind those that are there, `delay` apart.
    void add(std::vector<Send> parts, Time now, Time delay) {
        out_ = std::max(now, out_);
        for (Send& part : parts) {
            part.not_before = out_;
            out_ += delay;
            parts_.push_back(std::move(part));
        }
    }
    /// Moves those that leave in the next moment to `out`: a few, so that the device is not woken for each.
    void hand_over(Time now, std::vector<Send>& out) {
        constexpr Time moment = std::chrono::milliseconds(1);
        for (; !parts_.empty() && parts_.front().not_before < now + moment; parts_.pop_front())
            out.push_back(std::move(parts_.front()));
    }
    void drop() {
        if (parts_.empty()) return;
        out_ = parts_.front().not_before;
        parts_.clear();
    }

    /// When there is something to hand over.
    Time wake() const { return parts_.empty() ? Time::max() : parts_.front().not_before; }
    /// When all have gone, and more may follow.
    Time out() const { return out_; }

  private:
    std::deque<Send> parts_;
    Time out_{};
};

}  // namespace echoloop::aris_device
