#include "tools/echoloop/time_budget.h"

#include <algorithm>

#include "emulator/contract/endpoint.h"
#include "tools/echoloop/common.h"

namespace echoloop::cli {
namespace {

constexpr Time patience = std::chrono::seconds(5);

/// A device without a session: time passes when it is asked to.
class DryRun {
  public:
    DryRun(const ScenarioDevice& entry, bool turns) : device_(entry.model->make(entry.config)) {
        take(device_->started(now_));
        if (entry.model->requests == nullptr) return;
        for (const Bytes& request : entry.model->requests(entry.config, 2, turns)) {
            if (ping_) hear();
            asked_ = now_;
            if (!request.empty()) take(device_->received({0, request, {}}, now_));
            wait_for_ping();
        }
    }

    bool wait_for_ping() {
        const Time end = now_ + patience;
        while (!ping_ && wake_ <= end) {
            now_ = std::exchange(wake_, Time::max());
            take(device_->woken(now_));
        }
        return ping_.has_value();
    }
    /// From what the driver said last to what is due.
    Time asked_for() const { return ping_->due - asked_; }
    /// From the transmission to what is due.
    Time answer_after() const { return ping_->due - now_; }
    const Shot& shot() const { return ping_->shot; }
    /// What it says to silence.
    std::vector<Send> hear() {
        Echogram silence;
        silence.shot = ping_->shot;
        silence.sound_speed = 1500;
        silence.values.assign(silence.beams() * silence.shot.bins, 0.0F);
        silence.truth.resize(silence.beams());
        now_ = ping_->due;
        ping_.reset();
        Actions actions = device_->heard(silence, now_);
        auto sends = std::move(actions.send);
        take(std::move(actions));
        return sends;
    }
    Time now() const { return now_; }

  private:
    void take(Actions actions) {
        if (actions.wake) wake_ = *actions.wake;
        if (actions.ping) ping_ = std::move(actions.ping);
    }

    std::unique_ptr<Device> device_;
    Time now_{}, asked_{}, wake_ = Time::max();
    std::optional<Ping> ping_;
};

/// s that a step of the motor adds; nothing without one, or where a driver must say more than is known here.
std::optional<double> motor_of(const ScenarioDevice& device, const DryRun& resting) {
    if (device.model->turn_steps == 1) return {};
    DryRun turning(device, true);
    if (!turning.wait_for_ping()) return {};
    return std::max(0.0, to_seconds(turning.asked_for() - resting.asked_for()));
}

double window_of(const Shot& shot) {
    return shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval;
}

/// bit/s; 0: no serial line. One that follows its driver is taken to be at the usual rate.
double rate_of(const ScenarioDevice& device) {
    constexpr double usual = 115200;
    const auto baud = device.config.options.find("baud");
    if (baud == device.config.options.end()) return 0;
    const Endpoint& first = device.config.endpoints.at(0);
    if (first.on_udp()) return 0;
    const double rate = line_rate(device.config.endpoints, std::get<double>(baud->second));
    return rate > 0 || first.scheme != Endpoint::Scheme::pty ? rate : usual;
}

std::string milliseconds(double seconds) { return plain(1e3 * seconds, 3) + " ms"; }

}  // namespace

TimeBudget time_budget(const ScenarioDevice& device) {
    const Shot plain_shot = device.model->default_shot(device.config, 0, 0);
    TimeBudget budget{plain_shot.pulse_length, window_of(plain_shot), {}, {}, {}, {}, rate_of(device)};
    DryRun run(device, false);
    if (!run.wait_for_ping()) return budget;
    budget.motor = motor_of(device, run);
    budget.transmit = run.shot().pulse_length;
    budget.listen = std::min(window_of(run.shot()), to_seconds(run.answer_after()));
    budget.work = to_seconds(run.answer_after()) - budget.listen;
    const auto sends = run.hear();
    std::size_t bytes = 0;
    Time last = run.now();
    for (const Send& send : sends) bytes += send.bytes.size(), last = std::max(last, send.not_before);
    constexpr double bits_per_byte = 10;
    if (bytes == 0) return budget;  // it has more to ask for before it speaks
    budget.bytes = bytes;
    budget.wire = budget.line_rate > 0 ? bits_per_byte * static_cast<double>(bytes) / budget.line_rate
                                       : to_seconds(last - run.now());
    return budget;
}

std::string text_of(const TimeBudget& b) {
    std::string text = "pulse " + milliseconds(b.transmit) + ", listening " + milliseconds(b.listen);
    if (!b.work) return text + ", and what its driver's commands add";
    if (b.motor) text += ", motor " + milliseconds(*b.motor);
    text += ", processing " + milliseconds(*b.work);
    if (!b.bytes) return text;
    text += ", " + counted(*b.bytes, "byte");
    if (*b.wire > 0) text += " in " + milliseconds(*b.wire);
    return b.line_rate > 0 ? text + " at " + plain(b.line_rate, 0) + " bit/s" : text;
}

}  // namespace echoloop::cli
