#include "emulator/devices/nmea-echosounder/echosounder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace echoloop::nmea_echosounder {

Echosounder::Echosounder(Settings settings, Wiring wiring)
    : settings_(std::move(settings)), wiring_(std::move(wiring)), shot_(shot_from(settings_)) {}

Actions Echosounder::ping(Time now) {
    waiting_ = false;
    ++shot_.ping;
    next_ping_ = now + from_seconds(settings_.period());
    Actions actions;
    actions.ping = Ping{shot_, now + from_seconds(settings_.window() + settings_.processing)};
    return actions;
}

Actions Echosounder::received(const Received& data, Time) {
    counters_.skipped_bytes += data.bytes.size();
    return {};
}

Actions Echosounder::woken(Time now) {
    if (!waiting_ || now < next_ping_) return {};
    return ping(now);
}

Actions Echosounder::heard(const Echogram& echogram, Time now) {
    if (waiting_ || echogram.shot.ping != shot_.ping) return {};
    ++counters_.pings;
    const auto time = bottom_time(echogram, settings_.bottom);
    const nmea::Depth depth = time ? nmea::Depth(*time * settings_.sound_speed / 2) : std::nullopt;
    Actions actions;
    std::size_t bytes = 0;
    for (const std::string& formatter : settings_.sentences) {
        if (!depth && settings_.silent_without_bottom && formatter != "MTW") continue;
        const std::string text = say(formatter, depth);
        bytes += text.size();
        actions.send.push_back({0, Bytes(text.begin(), text.end()), wiring_.host, {}});
    }
    waiting_ = true;
    // A slow line holds the next ping back, so that sentences never queue up and grow old.
    next_ping_ = std::max({next_ping_, now, now + line_time(bytes) - from_seconds(settings_.window())});
    actions.wake = next_ping_;
    return actions;
}

std::string Echosounder::say(const std::string& formatter, nmea::Depth depth) const {
    const nmea::Style& style = settings_.style;
    if (formatter == "MTW") return nmea::mtw(settings_.temperature, style);
    if (formatter == "DPT")
        return nmea::dpt(depth, settings_.offset,
                         settings_.range_in_dpt ? std::optional(settings_.range) : std::nullopt, style);
    // The offset's sign says whether it leads up to the surface (DBS) or down to the keel (DBK).
    if (formatter != "DBT" && depth) depth = *depth + settings_.offset;
    return nmea::depth_below(formatter, depth, style);
}

Time Echosounder::line_time(std::size_t bytes) const {
    const bool paced = wiring_.port.kind == Port::Kind::stream && settings_.baud > 0;
    return paced ? from_seconds(10.0 * static_cast<double>(bytes) / settings_.baud) : Time{};
}

}  // namespace echoloop::nmea_echosounder
