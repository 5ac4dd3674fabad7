// A Blueprint Subsea Oculus imaging sonar: status by UDP, commands and images by TCP. A pure state machine.
#pragma once

#include <optional>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/oculus/messages.h"
#include "protocols/oculus/framer.h"

namespace echoloop::oculus_device {

struct Wiring {
    Address own;     ///< where the TCP listener is, as the status tells it
    Address status;  ///< where the status goes
};

class Oculus final : public Device {
  public:
    Oculus(const Settings& settings, const Wiring& wiring);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t) override {}
    Actions connected(std::size_t port, Address peer, Time now) override;
    Actions disconnected(std::size_t port, Address peer, Time now) override;
    DeviceCounters counters() const override;

  private:
    /// Starts the host's time to say something.
    void expect_words(Time now);
    void obey(const oculus::Frame& frame, Time now);
    void fire(std::optional<Request> request, Time now);
    bool hangs_up_on_fire();
    void hang_up();
    void forget_client();
    bool pinging() const;
    void plan_next_ping(Time now);
    void transmit(Time now);
    void tick(Time now);
    void send_result(const Echogram& echogram, Time now);
    Actions take_actions();

    Settings settings_;
    Wiring wiring_;
    oculus::Framer framer_{oculus::host_payload};
    std::optional<Request> request_;  ///< of the connected host; none: standby
    PingRecord ping_;                 ///< the ping under way, or the last one
    Address ping_client_;             ///< whom it is for
    /// Steps of 33 ns, as between the three pings of a recording.
    PingPacer pacer_{settings_.sensors, {Time(33), 1}};
    Address client_;                   ///< who is connected; port 0: nobody
    bool hung_up_ = false;             ///< on a fire
    double depth_ = 0;                 ///< m, at the last ping
    Time network_free_{};              ///< when the last result has gone through it
    Time next_silence_ = Time::max();  ///< when the host will have been silent too long
    Time next_status_ = Time::max();
    Time next_tick_ = Time::max();  ///< of the second that dummies keep
    Actions actions_;
    DeviceCounters counters_;
};

/// The rows of the table of models.
std::vector<Model> models();

}  // namespace echoloop::oculus_device
