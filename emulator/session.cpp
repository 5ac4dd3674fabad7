#include "emulator/session.h"

#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>

namespace echoloop {
namespace {

constexpr std::size_t outbox_limit = 64 << 20;  // bytes; a driver that never reads must not eat the memory
constexpr Time late_after = std::chrono::milliseconds(1);

}  // namespace

Session::Session(asio::io_context& io, const Clock& clock, RenderThread& renderer, std::string name,
                 std::unique_ptr<Device> device, std::vector<std::unique_ptr<Transport>> transports,
                 PoseAt pose_at)
    : io_(io),
      clock_(clock),
      renderer_(renderer),
      name_(std::move(name)),
      device_(std::move(device)),
      transports_(std::move(transports)),
      pose_at_(std::move(pose_at)),
      mail_(io),
      alarm_(io),
      alive_(std::make_shared<bool>(true)) {}

Session::~Session() {
    close();
    *alive_ = false;
}

void Session::start() {
    for (std::size_t port = 0; port < transports_.size(); ++port) {
        transports_[port]->start({.received =
                                      [this, port](ByteView bytes, Address from) {
                                          apply(device_->received({port, bytes, from}, clock_.now()));
                                      },
                                  .reconnected = [this, port] { device_->reconnected(port); }});
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
    const Pose pose = pose_at_(clock_.now());
    renderer_.submit(std::move(ping.shot), pose,
                     [this, &io = io_, due = ping.due, alive = alive_](Echogram echogram, std::string error) {
                         auto result = std::make_shared<Echogram>(std::move(echogram));
                         asio::post(io, [this, result, due, alive, error = std::move(error)] {
                             if (!*alive || closed_) return;
                             if (!error.empty()) spdlog::error("{}: ping not rendered: {}", name_, error);
                             asio::co_spawn(io_, deliver(result, due), Serving(name_));
                         });
                     });
}

Task<void> Session::deliver(std::shared_ptr<Echogram> echogram, Time due) {
    const Time lateness = clock_.now() - due;
    if (lateness > late_after) ++summary_.late_pings;
    summary_.worst_lateness = std::max(summary_.worst_lateness, lateness);
    asio::steady_timer timer(io_);
    co_await wait_until(timer, due);
    if (closed_) co_return;
    ++summary_.pings;
    apply(device_->heard(*echogram, std::max(due, clock_.now())));
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
        if (send.port < transports_.size()) co_await transports_[send.port]->write(send.bytes, send.to);
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
