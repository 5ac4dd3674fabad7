#include "emulator/devices/family/sounder/talking_sounder.h"

#include <algorithm>
#include <utility>

namespace echoloop::echosounder {

TalkingSounder::TalkingSounder(const Sounding& sounding, std::vector<Wiring> wiring, Words words,
                               bool free_running)
    : sounding_(sounding),
      wiring_(std::move(wiring)),
      words_(std::move(words)),
      shot_(shot_from(sounding_)),
      free_running_(free_running),
      tracker_(sounding_.tracking_lag) {
    const auto is_datagram = [](const Wiring& one) { return one.host.port != 0; };
    if (std::ranges::all_of(wiring_, is_datagram)) sounding_.baud = 0;
}

std::vector<Port> TalkingSounder::ports() const {
    std::vector<Port> all;
    for (const Wiring& one : wiring_) all.push_back(one.port);
    return all;
}

Actions TalkingSounder::started(Time now) {
    if (free_running_) run_freely(now);
    ping_if_due(now);
    return take_actions();
}

void TalkingSounder::ping_if_due(Time now) {
    if (!pacer_.begin(now)) return;
    ++shot_.ping;
    actions_.ping = Ping{shot_, now + from_seconds(sounding_.window() + sounding_.processing_time)};
}

void TalkingSounder::ask(Time now) {
    if (!pacer_.under_way()) {
        pacer_.reset();  // at once, whatever the line still has to say
        pacer_.start(now, {});
        ping_if_due(now);
    }
    pacer_.once();
}

void TalkingSounder::run_freely(Time now) { pacer_.start(now, from_seconds(sounding_.period())); }

Actions TalkingSounder::received(const Received& data, Time) {
    counters_.skipped_bytes += data.bytes.size();
    return {};
}

Actions TalkingSounder::woken(Time now) {
    ping_if_due(now);
    return take_actions();
}

Actions TalkingSounder::heard(const Echogram& echogram, Time now) {
    if (!pacer_.under_way() || echogram.shot.ping != shot_.ping) return {};
    ++counters_.pings;
    std::optional<double> found, depth;
    if (const auto bottom = find_bottom(echogram, sounding_.bottom))
        found = bin_time(echogram.shot, static_cast<double>(bottom->bin)) * sounding_.sound_speed / 2;
    if (const auto reading = tracker_.follow(found, to_seconds(now))) depth = reading->distance;
    std::size_t bytes = 0;
    for (const std::string& line : words_(depth, now)) {
        bytes += line.size();
        say(line);
    }
    // A slow line holds the next ping back, so that lines never queue up and grow old.
    const Time held = from_seconds(sounding_.line_time(bytes) - sounding_.window());
    pacer_.end(now + std::max(held, Time{}), from_seconds(sounding_.period()));
    return take_actions();
}

void TalkingSounder::say(const std::string& line) {
    for (std::size_t port = 0; port < wiring_.size(); ++port)
        actions_.send.push_back({port, Bytes(line.begin(), line.end()), wiring_[port].host, {}});
}

void TalkingSounder::change(const Sounding& sounding) {
    const double baud = sounding_.baud;
    sounding_ = sounding;
    sounding_.baud = baud;
    const auto ping = shot_.ping;
    shot_ = shot_from(sounding_);
    shot_.ping = ping;
}

Actions TalkingSounder::take_actions() {
    actions_.wake = std::min(pacer_.wake(), other_wake_);
    return std::exchange(actions_, {});
}

}  // namespace echoloop::echosounder
