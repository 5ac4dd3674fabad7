#include "emulator/devices/family/sounder/tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace echoloop::echosounder {

std::optional<Tracker::Reading> Tracker::follow(std::optional<double> found, double now) {
    constexpr double gate_share = 0.25, least_gate = 0.5;  // of the reading; m
    constexpr double patience = 2;                         // lags
    const double since = now - std::exchange(last_, now);
    if (lag_ <= 0 || !reading_) {
        reading_ = found;
        agreed_ = now;
        return found ? std::optional(Reading{*found, 1}) : std::nullopt;
    }
    const double gate = std::max(gate_share * *reading_, least_gate);
    if (found && std::abs(*found - *reading_) <= gate) {
        const double error = *found - *reading_;
        *reading_ += error * (1 - std::exp(-since / lag_));
        agreed_ = now;
        return Reading{*reading_, 1 - std::abs(*found - *reading_) / gate};
    }
    const double missed = (now - agreed_) / (patience * lag_);
    if (missed < 1) return Reading{*reading_, 1 - missed};
    reading_ = found;
    agreed_ = now;
    return found ? std::optional(Reading{*found, 1}) : std::nullopt;
}

}  // namespace echoloop::echosounder
