#include "emulator/session.h"

#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>

#include "emulator/random_key.h"

namespace echoloop {
namespace {

constexpr std::size_t outbox_limit = 64 << 20;  // bytes; a driver that never reads must not eat the memory
constexpr Time late_after = std::chrono::milliseconds(1);

/// m, from a point to the corner of the scene's bounds that is farthest from it.
double farthest_from(Vec3 point, const Bounds& scene) {
    const auto reach = [&scene](std::size_t axis, double at) {
        return std::max(std::abs(scene.min[axis] - at), std::abs(scene.max[axis] - at));
    };
    return norm({reach(0, point.x), reach(1, point.y), reach(2, point.z)});
}

}  // namespace

Session::Session(asio::io_context& io, const Clock& clock, RenderThread& renderer, SharedWater& water,
                 std::string name, std::unique_ptr<Device> device,
                 std::vector<std::unique_ptr<Transport>> transports, SituationAt situation_at)
    : io_(io),
      clock_(clock),
      renderer_(renderer),
      water_(water),
      sonar_(water.sonars++),
      name_(std::move(name)),
      device_(std::move(device)),
      transports_(std::move(transports)),
      situation_at_(std::move(situation_at)),
      mail_(io),
      alarm_(io),
      alive_(std::make_shared<bool>(true)) {}

Session::~Session() {
    close();
    *alive_ = false;
}

void Session::start() {
    for (std::size_t port = 0; port < transports_.size(); ++port) {
        transports_[port]->start(
            {.received =
                 [this, port](ByteView bytes, Address from) {
                     apply(device_->received({port, bytes, from}, clock_.now()));
                 },
             .reconnected = [this, port] { device_->reconnected(port); },
             .connected = [this, port](Address peer) { apply(device_->connected(port, peer, clock_.now())); },
             .disconnected = [this, port] { apply(device_->disconnected(port, clock_.now())); },
             .line_rate = [this, port](double rate) { device_->line_rate(port, rate); }});
    }
    asio::co_spawn(io_, keep_writing(), Serving(name_));
    asio::co_spawn(io_, keep_waking(), Serving(name_));
    apply(device_->started(clock_.now()));
}

void Session::close() {
    if (closed_) return;
    closed_ = true;
    mail_.cancel();
    alarm_.cancel();
    for (auto& transport : transports_) transport->close();
}

void Session::apply(Actions actions) {
    for (Send& send : actions.send) post_mail(std::move(send));
    if (actions.wake) {
        wake_ = *actions.wake;
        alarm_.cancel();
    }
    if (actions.ping) transmit(std::move(*actions.ping));
}

void Session::post_mail(Send send) {
    if (outbox_bytes_ + send.bytes.size() > outbox_limit) {
        if (summary_.dropped++ == 0) spdlog::warn("{}: the outbox is full; messages are dropped", name_);
        return;
    }
    outbox_bytes_ += send.bytes.size();
    const Time when = send.not_before;
    const bool first = outbox_.empty() || when < outbox_.begin()->first;
    outbox_.emplace(when, std::move(send));
    if (first) mail_.cancel();
}

void Session::transmit(Ping ping) {
    ping.shot.random_key = random_key(water_.seed, name_);
    const Time now = clock_.now();
    const Situation situation = situation_at_(now);
    const Pose& pose = situation.world_from_sonar;
    sequence_ += now > silent_from_ ? 2 : 1;  // a gap in the row, and what is late is forgotten
    silent_from_ = ping.shot.interval > 0 ? now + from_seconds(1.5 * ping.shot.interval) : Time::max();
    const UnderWay under_way{{now, sonar_, pose, ping.shot}, sequence_, ping.due};
    water_.cross_talk.transmitted(under_way.transmission);
    const double farthest = farthest_from(pose.position, water_.scene);
    const auto late = late_shot(ping.shot, water_.water, water_.effects, farthest);
    const Time next_due = ping.due + from_seconds(ping.shot.interval);
    render(ping.due, std::move(ping.shot), situation, [this, under_way](std::shared_ptr<Echogram> echogram) {
        asio::co_spawn(io_, deliver(std::move(echogram), under_way), Serving(name_));
    });
    if (!late) return;
    render(next_due, *late, situation, [this, sequence = sequence_](std::shared_ptr<Echogram> echogram) {
        late_echoes_.keep(sequence, std::move(*echogram));
    });
}

void Session::render(Time needed, Shot shot, const Situation& situation,
                     std::function<void(std::shared_ptr<Echogram>)> then) {
    renderer_.submit(
        {sonar_, needed}, std::move(shot), situation,
        [this, &io = io_, then = std::move(then), alive = alive_](Echogram echogram, std::string error) {
            auto result = std::make_shared<Echogram>(std::move(echogram));
            asio::post(io, [this, result, then, alive, error = std::move(error)] {
                if (!*alive || closed_) return;
                if (!error.empty()) spdlog::error("{}: ping not rendered: {}", name_, error);
                then(result);
            });
        });
}

Task<void> Session::deliver(std::shared_ptr<Echogram> echogram, UnderWay ping) {
    const Time lateness = clock_.now() - ping.due;
    if (lateness > late_after) ++summary_.late_pings;
    summary_.worst_lateness = std::max(summary_.worst_lateness, lateness);
    asio::steady_timer timer(io_);
    co_await wait_until(timer, ping.due);
    if (closed_) co_return;
    ++summary_.pings;
    late_echoes_.add_to(ping.sequence, *echogram);
    water_.cross_talk.add_to(*echogram, ping.transmission);
    apply(device_->heard(*echogram, std::max(ping.due, clock_.now())));
}

Task<void> Session::wait_until(asio::steady_timer& timer, Time when) {
    error_code ec;
    timer.expires_at(clock_.when(when));
    co_await timer.async_wait(into(ec));
}

Task<void> Session::keep_waking() {
    while (!closed_) {
        if (wake_ == Time::max()) {
            error_code ec;
            alarm_.expires_at(Clock::Steady::time_point::max());
            co_await alarm_.async_wait(into(ec));
        } else {
            co_await wait_until(alarm_, wake_);
        }
        const Time now = clock_.now();
        if (closed_ || now < wake_) continue;
        wake_ = Time::max();
        apply(device_->woken(now));
    }
}

Task<void> Session::keep_writing() {
    while (!closed_) {
        if (outbox_.empty()) {
            error_code ec;
            mail_.expires_at(Clock::Steady::time_point::max());
            co_await mail_.async_wait(into(ec));
            continue;
        }
        const auto first = outbox_.begin();
        if (first->first > clock_.now()) {
            co_await wait_until(mail_, first->first);
            continue;
        }
        const Send send = std::move(outbox_.extract(first).mapped());
        outbox_bytes_ -= send.bytes.size();
        if (send.port >= transports_.size()) continue;
        co_await transports_[send.port]->write(send.bytes, send.to);
        if (send.hang_up) transports_[send.port]->hang_up();
    }
}

SessionSummary Session::summary() const {
    SessionSummary summary = summary_;
    summary.name = name_;
    summary.device = device_->counters();
    for (const auto& transport : transports_) {
        summary.bytes_in += transport->bytes_in();
        summary.bytes_out += transport->bytes_out();
    }
    return summary;
}

}  // namespace echoloop
