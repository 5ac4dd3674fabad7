#include "tools/echoloop/bench/wire.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <set>
#include <stdexcept>

#include "emulator/contract/options.h"
#include "emulator/scenario/profile_section.h"
#include "tools/echoloop/bench/measure.h"

namespace echoloop::bench {
namespace {

constexpr std::size_t unmeasured = 4;

/// ms that this thread has computed.
double thread_ms() {
    timespec t{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// Noise of 90 dB that fluctuates, and over it a level bottom of 140 dB, three quarters of the way out in the
/// outermost beams. At one range in all beams it would be a ring, which no detection believes at once.
Echogram made_up(const Shot& shot) {
    Echogram echogram;
    echogram.shot = shot;
    echogram.sound_speed = 1500;
    echogram.noise_power = 1e9;
    echogram.values.resize(shot.beams() * shot.bins);
    echogram.truth.resize(shot.beams());
    std::uint32_t state = 1;
    for (float& value : echogram.values) {
        state = state * 1664525U + 1013904223U;
        value = 1e9F * static_cast<float>((state >> 8) + 1) * 0x1p-23F;
    }
    const double outermost = std::min(deg_to_rad(80), std::max(-shot.bearings.front(), shot.bearings.back()));
    for (std::size_t beam = 0; beam < shot.beams(); ++beam) {
        const double angle = std::abs(shot.bearings[beam % shot.bearings.size()]);
        const double part = 0.75 * std::cos(outermost) / std::cos(std::min(angle, outermost));
        const auto bottom = static_cast<std::size_t>(part * static_cast<double>(shot.bins));
        for (std::size_t bin = bottom; bin < std::min(shot.bins, bottom + 8); ++bin)
            echogram.values[beam * shot.bins + bin] += 1e14F;
    }
    return echogram;
}

std::unique_ptr<Device> make_device(const WireCase& the_case) {
    const Model* model = find_model(the_case.model);
    if (model == nullptr) throw std::runtime_error("bench: there is no model " + the_case.model);
    DeviceConfig config;
    config.name = the_case.name;
    config.endpoints = parse_endpoints(model->default_endpoints);
    config.options = default_options(*model);
    config.profile = own_profile(*model);
    for (const auto& [name, value] : the_case.options) config.options.at(name) = value;
    return model->make(config);
}

/// A device and the part of a session that keeps the time.
class Driven {
  public:
    explicit Driven(const WireCase& the_case) : device_(make_device(the_case)), words_(the_case.words) {
        take(device_->started(now_));
        for (std::size_t port = 0; port < device_->ports().size(); ++port) connect(port);
        say_words();
    }

    /// ms of processor time from the next echogram to its bytes.
    double ping(WireFigures& figures) {
        await_ping(figures.name);
        const Ping ping = std::move(*std::exchange(ping_, std::nullopt));
        now_ = std::max(now_, ping.due);
        const Echogram echogram = made_up(ping.shot);
        const double begin = thread_ms();
        Actions actions = device_->heard(echogram, now_);
        const double taken = thread_ms() - begin;
        figures.beams = ping.shot.beams(), figures.bins = ping.shot.bins;
        ports_.clear(), messages_ = bytes_ = 0;
        for (const Send& send : actions.send) ports_.insert(send.port);
        take(std::move(actions));
        await_ping(figures.name);  // what is large may leave piece by piece
        figures.messages = messages_, figures.bytes = bytes_;
        return taken;
    }

  private:
    void await_ping(const std::string& name) {
        constexpr int most = 10'000, until_words = 100;  // some sonars stop when their host is silent
        for (int woken = 1; !ping_; ++woken) {
            if (woken == most || wake_ == Time::max())
                throw std::runtime_error("bench: " + name + " does not ping");
            if (woken % until_words == 0) say_words();
            if (ping_) break;
            now_ = std::max(now_, std::exchange(wake_, Time::max()));
            take(device_->woken(now_));
        }
    }
    void connect(std::size_t port) {
        device_->reconnected(port);
        take(device_->connected(port, {0x7F000001, 50000}, now_));
    }
    void say_words() {
        for (const auto& word : words_)
            take(device_->received({word.port, word.bytes, {0x7F000001, 50000}}, now_));
    }
    void take(Actions actions) {
        if (actions.wake) wake_ = *actions.wake;
        if (actions.ping) ping_ = std::move(actions.ping);
        for (const Send& send : actions.send) {
            if (send.hang_up) connect(send.port);
            if (!ports_.contains(send.port)) continue;
            ++messages_;
            bytes_ += send.bytes.size();
        }
    }

    std::unique_ptr<Device> device_;
    std::vector<WireCase::Word> words_;
    Time now_{}, wake_ = Time::max();
    std::optional<Ping> ping_;
    std::set<std::size_t> ports_;           ///< where the echogram's words leave
    std::size_t messages_ = 0, bytes_ = 0;  ///< there, since the echogram
};

}  // namespace

WireFigures measure_wire(const WireCase& the_case, std::size_t pings) {
    WireFigures figures;
    figures.name = the_case.name;
    Driven driven(the_case);
    std::vector<double> taken;
    for (std::size_t i = 0; i < unmeasured + pings; ++i) {
        const double ms = driven.ping(figures);
        if (i >= unmeasured) taken.push_back(ms);
    }
    const Spread spread = spread_of(taken);
    figures.least = spread.minimum, figures.median = spread.median, figures.p99 = spread.p99;
    return figures;
}

}  // namespace echoloop::bench
