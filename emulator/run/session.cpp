#include "emulator/run/session.h"

#include <spdlog/spdlog.h>

#include "emulator/capture/watch.h"
#include "emulator/contract/random_key.h"
#include "emulator/dataset/dataset.h"
#include "emulator/truth/device_truth.h"

namespace echoloop {
namespace {

constexpr Time late_after = std::chrono::milliseconds(1);
constexpr std::size_t worth_a_thread = 16'384;  ///< values of an echogram; fewer take a device no time

/// m, from a point to the corner of the scene's bounds that is farthest from it.
double farthest_from(Vec3 point, const Bounds& scene) {
    const auto reach = [&scene](std::size_t axis, double at) {
        return std::max(std::abs(scene.min[axis] - at), std::abs(scene.max[axis] - at));
    };
    return norm({reach(0, point.x), reach(1, point.y), reach(2, point.z)});
}

}  // namespace

Session::Session(asio::io_context& io, Clock& clock, RenderThreads& renderers, SharedWater& water,
                 std::string name, std::unique_ptr<Device> device,
                 std::vector<std::unique_ptr<Transport>> transports, SituationAt situation_at,
                 LocatedAt located_at)
    : io_(io),
      clock_(clock),
      water_(water),
      sonar_(water.sonars++),
      name_(std::move(name)),
      device_(std::move(device)),
      transports_(std::move(transports)),
      situation_at_(std::move(situation_at)),
      located_at_(std::move(located_at)),
      renderers_(renderers),
      outbox_(transports_.size()),
      mail_(clock, sonar_),
      alarm_(clock, sonar_) {}

Session::~Session() = default;

void Session::tell(std::unique_ptr<DeviceTruth> truth) { truth_ = std::move(truth); }

void Session::start() {
    for (std::size_t port = 0; port < transports_.size(); ++port) {
        transports_[port]->start(
            {.received =
                 [this, port](ByteView bytes, Address from) {
                     if (bytes.empty()) {
                         ++summary_.empty_datagrams;
                         return;
                     }
                     if (!hearing_) return apply_now(device_->received({port, bytes, from}, clock_.now()));
                     act([this, port, kept = Bytes(bytes.begin(), bytes.end()), from] {
                         return device_->received({port, kept, from}, clock_.now());
                     });
                 },
             .reconnected =
                 [this, port] {
                     outbox_.forget(port);
                     to_device([this, port] { device_->reconnected(port); });
                 },
             .connected =
                 [this, port](Address peer) {
                     act([this, port, peer] { return device_->connected(port, peer, clock_.now()); });
                 },
             .disconnected =
                 [this, port](Address peer) {
                     act([this, port, peer] { return device_->disconnected(port, peer, clock_.now()); });
                 },
             .line_rate =
                 [this, port](double rate) {
                     to_device([this, port, rate] { device_->line_rate(port, rate); });
                 }});
    }
    asio::co_spawn(io_, keep_writing(), Serving(name_));
    asio::co_spawn(io_, keep_waking(), Serving(name_));
    apply_now(device_->started(clock_.now()));
}

void Session::cut_power(std::function<void()> cut) {
    ++power_cuts_;
    outbox_.clear();
    wake_ = Time::max();
    late_.reset();
    alarm_.cancel();
    to_device(std::move(cut));
}

void Session::close() {
    for (auto& transport : transports_) transport->close();
}

void Session::apply(Actions actions, Time time) {
    acted_ = time;
    for (Send& send : actions.send) post_mail(std::move(send));
    if (actions.wake) {
        wake_ = *actions.wake;
        alarm_.cancel();
    }
    if (actions.ping) transmit(std::move(*actions.ping), time);
    if (!actions.locate.empty()) locate(actions.locate, time);
}

void Session::locate(const std::vector<Time>& times, Time now) {
    std::vector<Located> places;
    for (const Time time : times) places.push_back(located_at_(time));
    apply(device_->located(places, now), now);
}

void Session::post_mail(Send send) {
    const bool first = outbox_.empty() || send.not_before < outbox_.first_due();
    const Mail* const kept = keep(std::move(send));
    if (kept == nullptr) {
        if (summary_.dropped++ == 0)
            spdlog::warn("{}: more is asked for than can be said; messages are dropped", name_);
        return;
    }
    if (dataset_ != nullptr)
        dataset_->said(number_in_it_, kept->send.port,
                       {reinterpret_cast<const char*>(kept->send.bytes.data()), kept->send.bytes.size()});
    if (first) mail_.cancel();
}

const Mail* Session::keep(Send send) {
    const std::size_t port = send.port;
    Mail mail{std::move(send), heard_, std::exchange(remark_, {})};
    if (port >= transports_.size()) return nullptr;
    return outbox_.post(std::move(mail), outbox_.bytes_for(port) > 0 ? transports_[port]->line_rate() : 0);
}

void Session::transmit(Ping ping, Time time) {
    ping.shot.random_key = random_key(water_.seed, name_);
    Situation situation = situation_at_(time);
    const Pose pose = situation.world_from_sonar;
    ++sequence_;
    if (time > silent_from_) late_.reset();  // a gap in the row, and what is late is forgotten
    silent_from_ = ping.shot.interval > 0 ? time + from_seconds(1.5 * ping.shot.interval) : Time::max();
    Transmission transmission{time, sonar_, pose, ping.shot};
    water_.cross_talk.transmitted(transmission);
    double farthest = farthest_from(pose.position, water_.scene);
    for (std::size_t i = 0; i < std::min(water_.reach.size(), situation.movers.size()); ++i)
        farthest = std::max(farthest, norm(situation.movers[i].position - pose.position) + water_.reach[i]);
    const bool spared = !overload_.late_echoes();
    auto late = spared ? std::nullopt : late_shot(ping.shot, water_.water, water_.effects, farthest);
    if (late && !late_echoes_.asks(sequence_, *late, situation)) late.reset();
    situation.density = overload_.density();
    summary_.spared_pings += spared;
    summary_.coarse_pings += situation.density < 1;
    const Time next_due = ping.due + from_seconds(ping.shot.interval);
    const Wanted wanted = watch_ == nullptr ? Wanted::nothing : watch_->wants_ping(name_, ping.shot);
    const bool watched = wanted != Wanted::nothing;
    situation.objects = truth_ != nullptr || wanted == Wanted::objects;  // a data set has truth_, too
    auto echoes = render(ping.due, ping.shot, situation);
    situation.objects = false;
    situation.detail = late_detail;
    auto late_before = std::exchange(late_, late ? render(next_due, *late, situation) : nullptr);
    const double unix_time = clock_.unix_time() - to_seconds(clock_.now() - time);
    asio::co_spawn(io_,
                   deliver({std::move(transmission), sequence_, ping.due, std::move(echoes),
                            std::move(late_before), std::move(situation), unix_time, power_cuts_, watched,
                            watched ? body_at_(time) : std::pair<Pose, Motion>()}),
                   Serving(name_));
}

std::shared_ptr<Rendering> Session::render(Time needed, Shot shot, Situation situation) {
    return Rendering::start(renderers_, clock_, {sonar_, needed, std::move(shot), std::move(situation), {}},
                            name_);
}

Task<void> Session::deliver(UnderWay ping) {
    Alarm due(clock_, sonar_);
    co_await due.until(ping.due);
    ping.woken = clock_.now();
    ping.overslept = clock_.overslept(ping.due);
    co_await ping.echoes->ready();
    if (ping.late_before) co_await ping.late_before->ready();
    ping.waited = clock_.now() - ping.woken;
    to_device([this, heard = std::make_shared<UnderWay>(std::move(ping))] {
        if (heard->powered == power_cuts_) hear(*heard);
    });
}

void Session::count_late(const UnderWay& ping, Time now) {
    const Time lateness = now - ping.due;
    ++summary_.late_pings;
    if (now - ping.woken > lateness / 2) {
        ++summary_.late_renderings;
    } else if (ping.overslept > lateness / 2) {
        ++summary_.late_wakings;
    }
}

void Session::hear(UnderWay& ping) {
    const Time now = std::max(ping.due, clock_.now());
    if (now > ping.due + late_after) count_late(ping, now);
    lateness_.add(now - ping.due);
    overload_.heard(ping.waited);
    ++summary_.pings;
    auto heard =
        std::make_shared<Heard>(Heard{std::move(*ping.echoes->echogram), {}, {}, ping.sequence, now, {}, {}});
    if (ping.late_before) heard->late_before = std::move(*ping.late_before->echogram);
    Echogram& echogram = heard->echogram;
    heard->foreign = water_.cross_talk.pulses_in(echogram, ping.transmission);
    heard_ = ping.sequence;
    if (log_ != nullptr) log_->hears(heard_);
    if (around_)
        remark_ =
            remark_of(ping.transmission, ping.sequence, around_(ping.transmission.world_from_sonar.position));
    if (ping.watched)
        heard->seen = Seen{ping.transmission.time,
                           now - ping.due,
                           ping.echoes->finished - ping.transmission.time,
                           ping.due - ping.transmission.time,
                           echogram.objects,
                           ping.situation.movers,
                           ping.unix_time,
                           ping.body,
                           {ping.situation.velocity, ping.situation.turning},
                           log_ != nullptr ? log_->on(now) : std::vector<std::string>{}};
    auto faults = truth_ && log_ != nullptr ? log_->on(now) : std::vector<std::string>{};
    if (truth_) {
        PingTruth truth = truth_->of(ping.transmission, ping.situation, ping.unix_time, ping.due,
                                     std::move(faults), echogram);
        if (dataset_ != nullptr) {
            heard->kept = std::make_shared<PingTruth>(truth);
            heard->kept->echo.objects = echogram.objects;
        }
        truth_->heard(std::move(truth), std::move(echogram.objects));
    }
    before_hearing_(now);
    const bool large = echogram.values.size() >= worth_a_thread;
    if (large && water_.device_threads) return hear_elsewhere(std::move(heard));
    apply_now(after_hearing_(hear_all(*heard), now));
}

Actions Session::hear_all(Heard& heard) {
    water_.cross_talk.add(heard.foreign, heard.echogram);
    if (heard.late_before) late_echoes_.keep(heard.sequence - 1, std::move(*heard.late_before));
    late_echoes_.add_to(heard.sequence, heard.echogram);
    if (heard.seen) {
        heard.echogram.objects = std::move(heard.seen->objects);
        const Seen& seen = *heard.seen;
        watch_->ping({name_, heard.sequence, seen.transmitted, seen.late, seen.drawn, seen.due,
                      heard.echogram, seen.movers, seen.unix_time, seen.body.first, seen.body.second,
                      seen.sonar, seen.faults});
    }
    Actions actions = device_->heard(heard.echogram, heard.now);
    if (heard.kept) {
        heard.kept->echo.values = std::move(heard.echogram.values);
        heard.kept->echo.rule = heard.echogram.rule;
        dataset_->heard(number_in_it_, std::move(*heard.kept));
    }
    return actions;
}

void Session::hear_elsewhere(std::shared_ptr<Heard> heard) {
    hearing_ = true;
    counters_ = device_->counters();
    auto hold = std::make_shared<const Clock::Hold>(clock_);  // it comes back to the io thread before it ends
    water_.device_threads->post(
        [this, heard = std::move(heard), powered = power_cuts_, hold = std::move(hold)]() mutable {
            auto actions = std::make_shared<Actions>();
            std::exception_ptr fault;
            try {
                *actions = hear_all(*heard);
            } catch (...) {
                fault = std::current_exception();
            }
            asio::post(io_, [this, now = heard->now, powered, actions = std::move(actions),
                             fault = std::move(fault), hold = std::move(hold)] {
                hearing_ = false;
                Serving{name_}(fault);
                if (powered == power_cuts_) apply_now(after_hearing_(std::move(*actions), now));
                alarm_.cancel();
                for (; !waiting_.empty() && !hearing_; waiting_.pop_front()) waiting_.front()();
            });
        });
}

void Session::act(std::function<Actions()> event) {
    to_device([this, event = std::move(event), powered = power_cuts_] {
        if (powered == power_cuts_) apply_now(event());
    });
}

Task<void> Session::keep_waking() {
    while (true) {
        co_await alarm_.until(hearing_ ? Time::max() : wake_);
        const Time now = clock_.now();
        if (hearing_ || now < wake_) continue;
        // What was planned happens when it was, unless this woke far too late: a row of pings keeps its pace.
        const Time planned = std::max(std::exchange(wake_, Time::max()), acted_);
        const Time time = now - planned < late_after ? planned : now;
        apply(device_->woken(time), time);
    }
}

Task<void> Session::keep_writing() {
    while (true) {
        if (outbox_.empty()) {
            outbox_.release_memory();
            co_await mail_.until(Time::max());
            continue;
        }
        if (outbox_.first_due() > clock_.now()) {
            co_await mail_.until(outbox_.first_due());
            continue;
        }
        const auto [send, ping, remark] = outbox_.take_first();
        if (log_ != nullptr) log_->sends(ping);
        if (!remark.empty()) transports_[send.port]->annotate(remark);
        transports_[send.port]->speak_at(send.line_rate);
        const std::uint64_t before = transports_[send.port]->bytes_out();
        co_await transports_[send.port]->write(send.bytes, send.to);
        summary_.messages_out += transports_[send.port]->bytes_out() > before;
        if (send.hang_up) transports_[send.port]->hang_up(send.to);
    }
}

SessionSummary Session::summary() const {
    SessionSummary summary = summary_;
    summary.name = name_;
    summary.worst_lateness = lateness_.worst();
    summary.median_lateness = lateness_.not_exceeded_by(0.5);
    summary.p99_lateness = lateness_.not_exceeded_by(0.99);
    summary.waiting = outbox_.messages();
    summary.waiting_bytes = outbox_.bytes();
    summary.most_waiting = outbox_.most_messages();
    summary.most_waiting_bytes = outbox_.most_bytes();
    summary.device = hearing_ ? counters_ : device_->counters();
    for (const auto& transport : transports_) {
        summary.bytes_in += transport->bytes_in();
        summary.bytes_out += transport->bytes_out();
        summary.bytes_lost += transport->bytes_lost();
        summary.dropped += transport->messages_dropped();
        summary.targets_refused += transport->targets_refused();
        for (std::string& one : transport->connected()) summary.connected.push_back(std::move(one));
    }
    return summary;
}

}  // namespace echoloop
