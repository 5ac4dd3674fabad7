#include "emulator/machine/real_time.h"

#include <algorithm>

#include "emulator/contract/endpoint.h"

namespace echoloop {
namespace {

bool is_line(const Endpoint& endpoint) {
    return endpoint.scheme == Endpoint::Scheme::pty || endpoint.scheme == Endpoint::Scheme::serial;
}

}  // namespace

RealTime::RealTime(const Scenario& scenario) {
    const bool lines = std::ranges::any_of(scenario.devices, [](const ScenarioDevice& device) {
        return std::ranges::any_of(device.config.endpoints, is_line);
    });
    if (lines) workers_.emplace();
}

RealTimeSummary RealTime::summary() const {
    return {workers_.has_value(), workers_ ? workers_->count() : 0, standstills_.summary()};
}

}  // namespace echoloop
