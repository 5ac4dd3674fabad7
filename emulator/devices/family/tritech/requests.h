// What a head still owes for the mtSendData that it got: one or two replies each, surplus requests merged or
// queued. Counts only.
#pragma once

#include <algorithm>

namespace echoloop::tritech {

class Requests {
  public:
    /// `replies` per request; `queue`: surplus requests wait in a row, else they merge into one.
    Requests(int replies, bool queue) : replies_(replies), queue_(queue) {}

    void ask() { waiting_ = queue_ ? std::min(waiting_ + 1, most_queued) : 1; }
    bool any() const { return left_ > 0 || waiting_ > 0; }
    /// Counts one reply as begun; only if there are any.
    void take() {
        if (left_ == 0) {
            --waiting_;
            left_ = replies_;
        }
        --left_;
    }
    void clear() { left_ = waiting_ = 0; }

  private:
    static constexpr int most_queued = 1000;

    int replies_;
    bool queue_;
    int left_ = 0;     ///< of the request at hand, not yet begun
    int waiting_ = 0;  ///< requests behind it
};

}  // namespace echoloop::tritech
