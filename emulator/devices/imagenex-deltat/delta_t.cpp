#include "emulator/devices/imagenex-deltat/delta_t.h"

#include <algorithm>

#include "emulator/devices/imagenex-deltat/attitude.h"
#include "protocols/imagenex/delta_t_codec.h"

namespace echoloop::delta_t {

DeltaT::DeltaT(const Settings& settings, const Wiring& wiring)
    : settings_(settings), wiring_(wiring), controls_(settings.start) {}

std::vector<Port> DeltaT::ports() const { return {{"83P", Port::Kind::datagram, wiring_.from, false}}; }

double DeltaT::period() const {
    return std::max(window(controls_) + settings_.processing_time, 1 / settings_.frame_rate);
}

Actions DeltaT::started(Time now) {
    pacer_.start(now, {});
    Actions actions;
    actions.wake = pacer_.wake();
    return actions;
}

/// Hosts answer every 83P with an EC; there is no acknowledge.
Actions DeltaT::received(const Received& data, Time) {
    const auto message = imagenex::parse_delta_t(data.bytes);
    const auto* control = message ? std::get_if<imagenex::ExternalControl>(&*message) : nullptr;
    if (control == nullptr) {
        ++counters_.rejected;
        return {};
    }
    ++counters_.messages;
    controls_ = after(*control, controls_, settings_.start, settings_.speed_order);
    return {};
}

Actions DeltaT::woken(Time now) {
    if (pacer_.begin(now)) return transmit(now);
    Actions actions;
    actions.wake = pacer_.wake();
    return actions;
}

Actions DeltaT::transmit(Time now) {
    if (!alike(record_.controls, controls_)) averaged_ = 0;
    const double latency = window(controls_) + settings_.processing_time;
    const double time = settings_.unix_start + to_seconds(now);
    record_ = {controls_, 0, time, period(), latency};
    const double roll = controls_.roll_compensation ? down_bearing_ : 0;
    Actions actions;
    actions.ping = Ping{make_shot(controls_, settings_.acoustics, ++pings_, roll, period()),
                        now + from_seconds(latency)};
    actions.wake = pacer_.wake();
    return actions;
}

bool DeltaT::add(const Echogram& echogram) {
    const bool fits = averaged_ > 0 && mean_.values.size() == echogram.values.size();
    if (!fits) {
        mean_ = echogram;
        averaged_ = 1;
    } else {
        const float weight = 1.0F / static_cast<float>(++averaged_);
        for (std::size_t i = 0; i < mean_.values.size(); ++i)
            mean_.values[i] += weight * (echogram.values[i] - mean_.values[i]);
        mean_.world_from_sonar = echogram.world_from_sonar;
    }
    return averaged_ >= record_.controls.averaging;
}

Actions DeltaT::heard(const Echogram& echogram, Time now) {
    Actions actions;
    if (!pacer_.under_way() || echogram.shot.ping != pings_) return actions;
    ++counters_.pings;
    down_bearing_ = down_bearing(echogram.world_from_sonar);
    if (add(echogram)) {
        record_.number = static_cast<std::uint32_t>(pings_);
        const auto profile = make_profile(mean_, record_, settings_);
        actions.send.push_back({0, to_bytes(profile, settings_), wiring_.host, {}});
        averaged_ = 0;
    }
    pacer_.end(now, from_seconds(period()));
    actions.wake = pacer_.wake();
    return actions;
}

}  // namespace echoloop::delta_t
