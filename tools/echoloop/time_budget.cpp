#include "tools/echoloop/time_budget.h"

#include <algorithm>

#include "emulator/endpoint.h"
#include "protocols/imagenex/codec.h"
#include "protocols/oculus/codec.h"
#include "protocols/ping/codec.h"
#include "protocols/seanet/codec.h"
#include "tools/echoloop/common.h"

namespace echoloop::cli {
namespace {

constexpr Time patience = std::chrono::seconds(5);

Bytes ask_imagenex(bool turns) {
    imagenex::SwitchCommand command;
    command.range = 10;
    command.mode = imagenex::mode::all;
    command.sector_width = 120;
    command.step_size = turns ? 1 : 0;
    command.pulse_length = 10;
    command.data_points = 25;
    command.data_bits = 8;
    return imagenex::encode(imagenex::Message(command));
}

/// 200 bins of 25 mm, a step of 0.9 deg at 250 us for each 1/16 gradian.
Bytes configure_seanet(bool turns) {
    seanet::HeadCommand command;
    seanet::HeadParameters& p = command.parameters;
    p.hd_ctrl = seanet::hd_ctrl::adc8on | seanet::hd_ctrl::cont | seanet::hd_ctrl::scanright |
                seanet::hd_ctrl::raw | seanet::hd_ctrl::hasmot | seanet::hd_ctrl::reply_asl;
    p.hd_type = 0x11;
    p.range_scale = 50;
    p.ad_span = 81;
    p.motor_time = 25;
    p.step_size = turns ? 16 : 0;
    p.ad_interval = 52;
    p.bins = 200;
    p.max_ad_buffer = 1000;
    return seanet::encode(seanet::Message(command));
}

/// What a driver says to get pings, one after the other; nothing for devices that ping by themselves, or want
/// a longer talk. `turns`: the last ping is a step of the motor away from the one before.
std::vector<Bytes> requests_of(const std::string& model, bool turns) {
    const auto ping360 = [](std::uint16_t angle) {
        return ping::encode(ping::Message(ping::Transducer{1, 0, angle, 11, 88, 750, 1200, 1, 0}));
    };
    if (model == "ping360") return {ping360(0), ping360(turns ? 1 : 0)};
    if (model == "ping1d") {
        constexpr std::uint16_t profile = 1300;
        return {ping::encode(ping::Message(ping::GeneralRequest{profile}))};
    }
    if (model.starts_with("imagenex-8")) return {ask_imagenex(turns), ask_imagenex(turns)};
    if (model.starts_with("oculus-"))
        return {oculus::encode(oculus::Message(oculus::Fire{.range = 10, .gain = 50}))};
    if (model == "tritech-micron" || model == "tritech-seaking") {
        const Bytes ask = seanet::encode(seanet::Message(seanet::SendData{}));
        return {configure_seanet(turns), ask, ask};
    }
    return {};
}

bool has_motor(const std::string& model) {
    return model == "ping360" || model == "imagenex-881a" || model.starts_with("tritech-");
}

/// A device without a session: time passes when it is asked to.
class DryRun {
  public:
    DryRun(const ScenarioDevice& entry, bool turns) : device_(entry.model->make(entry.config)) {
        take(device_->started(now_));
        for (const Bytes& request : requests_of(entry.model->name, turns)) {
            if (ping_) hear();
            asked_ = now_;
            take(device_->received({0, request, {}}, now_));
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
        return device_->heard(silence, now_).send;
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
    DryRun turning(device, true);
    if (!has_motor(device.model->name) || !turning.wait_for_ping()) return {};
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
    using Scheme = Endpoint::Scheme;
    const Scheme scheme = parse_endpoint(device.config.endpoints.at(0)).scheme;
    if (scheme == Scheme::udp || scheme == Scheme::udp_listen) return 0;
    const double rate = line_rate(device.config.endpoints, std::get<double>(baud->second));
    return rate > 0 || scheme != Scheme::pty ? rate : usual;
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
