#include "emulator/devices/oculus/oculus.h"

#include <algorithm>
#include <utility>

#include "protocols/oculus/codec.h"

namespace echoloop::oculus_device {
namespace {

using namespace std::chrono_literals;

enum PortIndex : std::size_t { data_port, status_port };

constexpr Time dummy_period = 1s;
constexpr std::uint32_t over_temperature = 1U << 15, state = 7, main_program = 3;

}  // namespace

Oculus::Oculus(const Settings& settings, const Wiring& wiring) : settings_(settings), wiring_(wiring) {}

std::vector<Port> Oculus::ports() const {
    Port data{"data", Port::Kind::stream, {}, false};
    data.messages_kept = 2;  // pings
    return {data, {"status", Port::Kind::datagram, {wiring_.own.ip, 0}, false}};
}

Actions Oculus::started(Time now) {
    next_status_ = next_tick_ = now;
    return take_actions();
}

/// The settings of a host that has gone are not those of the next one.
void Oculus::forget_client() {
    framer_.clear();
    request_.reset();
    pacer_.pause();
    next_silence_ = Time::max();
    client_ = {};
    network_free_ = {};
}

Actions Oculus::connected(std::size_t port, Address peer, Time now) {
    if (port == data_port) {
        client_ = peer;
        expect_words(now);
    }
    return take_actions();
}

void Oculus::expect_words(Time now) {
    if (settings_.silence_limit > 0) next_silence_ = now + from_seconds(settings_.silence_limit);
}

/// Nobody is left whom it could ping for.
Actions Oculus::disconnected(std::size_t port, Address, Time) {
    if (port == data_port) forget_client();
    return take_actions();
}

Actions Oculus::received(const Received& data, Time now) {
    if (data.port != data_port) return take_actions();
    expect_words(now);
    framer_.feed(data.bytes);
    while (const auto frame = framer_.next()) obey(*frame, now);
    return take_actions();
}

/// Other messages than fires change nothing.
void Oculus::obey(const oculus::Frame& frame, Time now) {
    const auto message = oculus::parse(frame);
    ++(message ? counters_.messages : counters_.rejected);
    if (!message) return;
    if (const auto* v1 = std::get_if<oculus::Fire>(&*message))
        fire(read_request(*v1), now);
    else if (const auto* v2 = std::get_if<oculus::FireV2>(&*message))
        fire(read_request(*v2), now);
}

void Oculus::fire(std::optional<Request> request, Time now) {
    if (!request) {
        ++counters_.rejected;
        return;
    }
    if (hangs_up_on_fire()) return hang_up();
    if (settings_.answer != Answer::as_asked) request->v2 = settings_.answer == Answer::v2;
    request_ = request;
    plan_next_ping(now);
}

bool Oculus::hangs_up_on_fire() {
    const bool again = settings_.hang_up_on_fire == HangUp::always;
    if (settings_.hang_up_on_fire == HangUp::never || (hung_up_ && !again)) return false;
    return hung_up_ = true;
}

void Oculus::hang_up() {
    actions_.send.push_back({data_port, {}, client_, {}, true});
    forget_client();
}

bool Oculus::pinging() const {
    const std::uint32_t bits = settings_.status_bits;
    const bool runs = (bits & state) == main_program && (bits & over_temperature) == 0;
    return runs && request_ && !request_->standby();
}

void Oculus::plan_next_ping(Time now) {
    if (!pinging()) return pacer_.pause();
    const Time period = from_seconds(make_plan(*request_, settings_, now).period);
    pacer_.start(now, period);
    pacer_.hold(network_free_ - period);  // results of a host that was slow before go first
}

void Oculus::transmit(Time now) {
    ping_client_ = client_;
    ping_ = {*request_, make_plan(*request_, settings_, now), ping_.number + 1, now};
    actions_.ping = Ping{make_shot(ping_.request, ping_.plan, settings_, ping_.number),
                         now + from_seconds(ping_.plan.due)};
}

Actions Oculus::heard(const Echogram& echogram, Time now) {
    const bool expected = pacer_.under_way() && echogram.shot.ping == ping_.number &&
                          echogram.shot.bins == ping_.plan.rows && echogram.beams() == ping_.plan.beams;
    if (!expected) return take_actions();
    pacer_.end(now, {});
    if (ping_client_ == client_) send_result(echogram, now);  // else it has left
    plan_next_ping(now);
    return take_actions();
}

/// It goes as a whole, once the network has carried it.
void Oculus::send_result(const Echogram& echogram, Time now) {
    ++counters_.pings;
    depth_ = -echogram.world_from_sonar.position.z;
    network_free_ = std::max(now, network_free_) + from_seconds(ping_.plan.transfer);
    actions_.send.push_back({data_port, make_result(ping_, settings_, echogram), client_, network_free_});
}

/// Once a second: a host that hears nothing for long gives up.
void Oculus::tick(Time now) {
    next_tick_ = now + dummy_period;
    const bool rare = from_seconds(ping_.plan.period) >= dummy_period;
    if (!pinging() || rare) actions_.send.push_back({data_port, make_dummy(settings_), {}, {}});
}

Actions Oculus::woken(Time now) {
    if (now >= next_status_) {
        next_status_ = now + from_seconds(settings_.status_period);
        Bytes status = make_status(settings_, wiring_.own.ip, client_.ip, depth_, now);
        actions_.send.push_back({status_port, std::move(status), wiring_.status, {}});
    }
    if (now >= next_silence_) hang_up();
    if (now >= next_tick_) tick(now);
    if (pacer_.begin(now)) transmit(now);
    return take_actions();
}

DeviceCounters Oculus::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes = framer_.skipped_bytes();
    return counters;
}

Actions Oculus::take_actions() {
    actions_.wake = std::min({pacer_.wake(), next_status_, next_tick_, next_silence_});
    return std::exchange(actions_, {});
}

}  // namespace echoloop::oculus_device
