// A Blue Robotics Ping360 behind its serial line or its UDP bridge. A pure state machine.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string_view>

#include "emulator/devices/family/ping/link.h"
#include "emulator/devices/ping360/discovery.h"
#include "emulator/devices/ping360/scan.h"
#include "emulator/devices/ping360/settings.h"

namespace echoloop::ping360 {

using ping_device::Peer;

inline constexpr std::string_view unknown_command = "command not recognised";

/// A ping as automatic scans tell it.
ping::AutoDeviceData automatic(ping::DeviceData data, const ping::AutoTransmit& scan);

class Ping360 final : public Device {
  public:
    /// `lines`: one per endpoint; ports of discovery come behind them.
    Ping360(const Settings& settings, std::vector<Port> lines);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override;
    void line_rate(std::size_t port, double rate) override;
    DeviceCounters counters() const override;

  private:
    /// One turn of the head, with a ping at its end or without.
    struct Job {
        Peer peer;
        ping::DeviceData settings;  ///< echoed; its angle is the one to turn to
        bool transmit = true;
        std::optional<ping::AutoTransmit> automatic{};
    };

    void obey(const ping::Frame& frame, const Peer& peer, Time now);
    void on(const ping::GeneralRequest& request, const Peer& peer, Time now);
    void on(const ping::Transducer& command, const Peer& peer, Time now);
    void on(const ping::AutoTransmit& command, const Peer& peer, Time now);
    void on(const ping::MotorOff& command, const Peer& peer, Time now);
    void on(const ping::Reset& command, const Peer& peer, Time now);
    void on(const ping::Ping360SetDeviceId& command, const Peer& peer, Time now);
    void on(const ping::SetDeviceId& command, const Peer& peer, Time now);

    bool send_message(ping::Id id, const Peer& peer, Time now);
    ping::DeviceData last_on_request() const;
    void hear_discovery(const Received& data, Time now);
    void reply(const ping::Message& message, const Peer& peer, Time now);
    void refuse(ping::Id id, std::string_view text, const Peer& peer, Time now);
    void stop();
    void end_jobs(const std::function<bool(const Peer&)>& is_on_that_line, Time now);
    void begin(Time earliest);
    void next_job(Time now);
    void transmit(Time now);
    void answer(std::vector<std::uint8_t> samples, Time now);
    Time turn_duration(int to, Time now) const;
    Actions take_actions();

    Settings settings_;
    std::vector<Port> ports_;
    ping_device::Link link_;
    Discovery discovery_;
    std::optional<Job> job_;   ///< at hand
    std::deque<Job> waiting_;  ///< transducer commands that came meanwhile
    std::optional<Scan> scan_;
    ping::DeviceData last_;  ///< what 2300 tells when it is asked for
    ping::AutoTransmit last_scan_;
    int angle_ = 0;  ///< of the head, 0..399
    bool motor_on_ = true;
    bool under_way_ = false;          ///< a ping is in the water
    std::uint64_t ping_ = 0;          ///< number of the last ping; echoes of others are stale
    Time transmit_at_ = Time::max();  ///< end of the turn
    Time last_move_{};
    Time line_free_{};     ///< when the last reply has left the line
    Time silent_until_{};  ///< restart after a reset
    Actions actions_;      ///< of the call at hand
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::ping360
