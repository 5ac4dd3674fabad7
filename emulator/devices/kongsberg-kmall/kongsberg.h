// A Kongsberg multibeam that sends KMALL datagrams over UDP. A pure state machine.
#pragma once

#include <optional>
#include <string_view>

#include "emulator/contract/last_measured.h"
#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/kongsberg-kmall/messages.h"
#include "emulator/devices/kongsberg-kmall/texts.h"

namespace echoloop::kongsberg_kmall {

/// Where commands arrive, and where datagrams and the controller's texts go.
struct Wiring {
    Address own, host;
    std::optional<Address> controller{};  ///< empty: no texts
};

class Kongsberg final : public Device {
  public:
    Kongsberg(const Settings& settings, const Wiring& wiring);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t) override {}
    DeviceCounters counters() const override { return counters_; }

  private:
    void obey(const kmall::Command& command, Time now);
    void obey(const kmall::SoundText& text, Time now);
    /// NAME=VALUE, NAME=VALUE, ...
    void set_values(std::string_view assignments);
    /// What a file begins with.
    void send_records(Time now);
    void send_profile(Time now);
    void tell(const kmall::Command& text);
    void tell_standing(Time now);
    Standing standing() const { return {started_, wiring_.own, wiring_.host, depth_}; }
    double unix_time(Time now) const { return settings_.unix_start + to_seconds(now); }
    void plan_next_ping(Time now);
    void transmit_if_due(Time now);
    /// How far the head is below where it usually is, m, when it is at this height.
    double heave(double height);
    void send(const kmall::Datagram& datagram, Time now);
    Actions take_actions();

    Settings settings_, ping_settings_;  ///< now, and those of the ping under way
    Wiring wiring_;
    PingRecord ping_;  ///< the ping under way, or the last one
    std::uint64_t pings_begun_ = 0;
    bool started_ = false;                  ///< its host has chosen it
    kmall::SoundProfile profile_;           ///< of #SVP
    double water_level_ = 0;                ///< m below the head, at the last ping
    std::optional<double> usual_height_{};  ///< m, of the head, the mean of the last seconds
    std::optional<double> depth_{};  ///< m, of the bottom below the head; empty: the last ping found none
    Time next_texts_ = Time::max();
    /// Real rates are 23.96 to 24.18 Hz, so that intervals differ by 0.4 ms.
    PingPacer pacer_{settings_.sensors, {std::chrono::microseconds(10), 19}};
    LastMeasured probe_;
    Time sent_until_{};  ///< what is under way to the readers of datagrams
    Actions actions_;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::kongsberg_kmall
