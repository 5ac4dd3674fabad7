#include "emulator/devices/family/sounder/talking_sounder.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "emulator/contract/endpoint.h"

namespace echoloop::echosounder {

Wiring read_wiring(const std::vector<Endpoint>& endpoints, const std::string& model) {
    if (endpoints.size() != 1)
        throw std::invalid_argument("a " + model + " has one port: give exactly one endpoint");
    const Endpoint& e = endpoints[0];
    if (e.scheme == Endpoint::Scheme::udp_listen)
        throw std::invalid_argument(to_string(e) +
                                    ": an echosounder speaks first; name the host that is to hear it, "
                                    "udp://ADDRESS:PORT");
    if (e.scheme != Endpoint::Scheme::udp) return {{"line", Port::Kind::stream, {}, false}, {}};
    constexpr std::uint32_t loopback = 0x7F000001;
    const Address from{is_loopback(e.ip) ? loopback : 0, e.local_port()};
    return {{"datagrams", Port::Kind::datagram, from, false}, {e.ip, e.port}};
}

TalkingSounder::TalkingSounder(const Sounding& sounding, Wiring wiring, Words words, bool free_running)
    : sounding_(sounding),
      wiring_(std::move(wiring)),
      words_(std::move(words)),
      shot_(shot_from(sounding_)),
      free_running_(free_running) {
    if (wiring_.port.kind == Port::Kind::datagram) sounding_.baud = 0;
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
    std::optional<double> depth;
    if (const auto bottom = find_bottom(echogram, sounding_.bottom))
        depth = bin_time(echogram.shot, static_cast<double>(bottom->bin)) * sounding_.sound_speed / 2;
    std::size_t bytes = 0;
    for (const std::string& line : words_(depth, now)) {
        bytes += line.size();
        actions_.send.push_back({0, Bytes(line.begin(), line.end()), wiring_.host, {}});
    }
    // A slow line holds the next ping back, so that lines never queue up and grow old.
    const Time held = from_seconds(sounding_.line_time(bytes) - sounding_.window());
    pacer_.end(now + std::max(held, Time{}), from_seconds(sounding_.period()));
    return take_actions();
}

Actions TalkingSounder::take_actions() {
    actions_.wake = pacer_.wake();
    return std::exchange(actions_, {});
}

}  // namespace echoloop::echosounder
